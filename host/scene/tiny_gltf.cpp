// tinygltf's own code: a library that comes as a header.
#define TINYGLTF_IMPLEMENTATION
#include "tiny_gltf.hpp"
