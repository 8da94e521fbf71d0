// tinygltf's own code: a library that comes as a header.
#include <fstream>  // which it forgets under TINYGLTF_NO_FS

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
