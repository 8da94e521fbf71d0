// Named stretches of the commands: what tools show them as, and what their time is added up under.
#pragma once

#include "device.hpp"

namespace ppm::gpu {

/// While it lives, what `device` runs belongs to the region `name`: RenderDoc and vendors'
/// profilers show it so (VK_EXT_debug_utils), around any number of submissions or within one, and
/// the time of its commands is added to Device::region_times. Regions nest; time counts for the
/// innermost.
class Region {
 public:
  /// `name` must outlive the region: a literal.
  Region(Device& device, const char* name);
  ~Region();
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

 private:
  Device::Implementation& device_;
};

}  // namespace ppm::gpu
