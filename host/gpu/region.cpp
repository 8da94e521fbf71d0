#include "region.hpp"

#include "implementation.hpp"

namespace ppm::gpu {

Region::Region(Device& device, const char* name) : device_(device.implementation()) {
  device_.regions.push_back(name);
  if (device_.recording) device_.begin_label(name);
}

Region::~Region() {
  if (device_.recording) device_.end_label();
  device_.regions.pop_back();
}

}  // namespace ppm::gpu
