// The test layer in this process: loaded with every instance that is made from here on.
#pragma once

#include <dlfcn.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "layer.hpp"
#include "layer_environment.hpp"

namespace ppm::test {

class LayerGuard {
 public:
  LayerGuard() {
    load_layer();
    library_ = dlopen(PPM_TEST_LAYER_FILE, RTLD_NOW | RTLD_LOCAL);
    if (!library_) throw std::runtime_error(dlerror());
    calls_ = reinterpret_cast<decltype(&ppm_layer_calls)>(dlsym(library_, "ppm_layer_calls"));
    live_ = reinterpret_cast<decltype(&ppm_layer_live)>(dlsym(library_, "ppm_layer_live"));
    const auto function =
        reinterpret_cast<decltype(&ppm_layer_function)>(dlsym(library_, "ppm_layer_function"));
    if (!calls_ || !live_ || !function) throw std::runtime_error(dlerror());
    for (unsigned i = 0; function(i); ++i) functions_.emplace_back(function(i));
  }

  /// As layer.hpp says.
  std::uint64_t calls(const char* call) const { return calls_(call); }
  const std::vector<std::string>& functions() const { return functions_; }
  std::int64_t live(const char* kind = "") const { return live_(kind); }

 private:
  void* library_;  // stays, so that what it counted does
  decltype(&ppm_layer_calls) calls_;
  decltype(&ppm_layer_live) live_;
  std::vector<std::string> functions_;
};

inline LayerGuard& layer() {
  static LayerGuard guard;
  return guard;
}

}  // namespace ppm::test
