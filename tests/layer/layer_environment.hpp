// The environment in which Vulkan's loader puts the test layer into every new instance.
#pragma once

#include <cstdlib>

namespace ppm::test {

/// Of this process.
inline void load_layer() {
  setenv("VK_ADD_LAYER_PATH", PPM_TEST_LAYER_FOLDER, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_PPM_VK_test", 1);
}

/// The same, and the layer puts in a fault: "vkQueueSubmit 7 -4", as layer.cpp says.
inline void load_layer(const char* fault) {
  load_layer();
  setenv("PPM_TEST_LAYER_FAULT", fault, 1);
}

}  // namespace ppm::test
