// tinygltf without what the loader does itself: images and files.
#pragma once

#include <fstream>  // which it forgets under TINYGLTF_NO_FS

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
// Draco's library exports a tinygltf of another version. Of two with one name the order of
// libraries on the linker's command line would choose.
#define tinygltf ppm_tinygltf
#include <tiny_gltf.h>
