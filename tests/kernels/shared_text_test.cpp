// The shared text means the same on the device as on the host: integers and precise arithmetic to
// the bit, other floats within a few roundings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "device_fixture.hpp"
#include "kernel.hpp"
#include "ppm_pass_test_shaders.hpp"
#include "randoms.hpp"
#include "shared_probe.h"

namespace ppm::tests {
namespace {

using shared::ProbeWords;

struct ProbePush {
  std::uint32_t first = 0, count = 0, which = 0;
};

class SharedText : public DeviceTest {
 protected:
  static constexpr std::size_t kItems = 20000;

  static std::vector<ProbeWords> inputs(std::uint32_t seed) {
    Randoms random(seed);
    std::vector<ProbeWords> words(kItems);
    for (std::size_t i = 0; i < kItems; ++i) {
      for (int j = 0; j < 4; ++j) {
        words[i].a[j] = random.word();
        words[i].b[j] = random.word();
      }
      if (i % 50 == 1) words[i].a = words[i].b = glm::uvec4(0u);
      if (i % 50 == 2) words[i].a = words[i].b = glm::uvec4(0xffffffffu);
    }
    return words;
  }

  std::vector<ProbeWords> on_device(std::uint32_t which, std::span<const ProbeWords> words) {
    const gpu::Kernel kernel(device(), shaders::shared_probe);
    const gpu::Buffer in = gpu::make_buffer(device(), "inputs", words, gpu::Usage::storage);
    const gpu::Buffer out(device(), "outputs", words.size_bytes(), gpu::Usage::storage);
    gpu::BindingTable table;
    table.set(PPM_BIND_TEST_0, in);
    table.set(PPM_BIND_TEST_1, out);
    device().run([&](gpu::Recorder& recorder) {
      recorder.dispatch(kernel, table, ProbePush{0, 0, which}, words.size());
    });
    return out.download<ProbeWords>(words.size());
  }

  /// Calls check(device word, host word, item) for all words.
  template <class Check>
  void compare(std::uint32_t which, const Check& check) {
    const std::vector<ProbeWords> words = inputs(1 + which);
    const std::vector<ProbeWords> device_words = on_device(which, words);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const ProbeWords host = shared::probe(which, words[i]);
      for (int j = 0; j < 4; ++j) {
        check(device_words[i].a[j], host.a[j], i);
        check(device_words[i].b[j], host.b[j], i);
        if (HasFailure()) return;
      }
    }
  }

  /// Floats: relative or, below 1, absolute error.
  void compare_floats(std::uint32_t which, double tolerance) {
    compare(which, [&](std::uint32_t device_word, std::uint32_t host_word, std::size_t item) {
      const double x = glm::uintBitsToFloat(device_word);
      const double y = glm::uintBitsToFloat(host_word);
      EXPECT_LE(std::abs(x - y), tolerance * std::max(1.0, std::abs(y))) << "item " << item;
    });
  }
};

TEST_F(SharedText, IntegersAreExact) {
  for (const std::uint32_t which :
       {PPM_PROBE_WORDS, PPM_PROBE_FIXED, PPM_PROBE_GRID, PPM_PROBE_PIXELS}) {
    compare(which, [&](std::uint32_t x, std::uint32_t y, std::size_t item) {
      EXPECT_EQ(x, y) << "function " << which << ", item " << item;
    });
  }
}

TEST_F(SharedText, UpdateDiffersByNoMoreThanItsDivisions) {
  // Precise, but for the quotients: Vulkan grants them 2.5 units in the last place; four in all.
  compare(PPM_PROBE_UPDATE, [](std::uint32_t x, std::uint32_t y, std::size_t item) {
    const std::int64_t off = std::int64_t{x} - std::int64_t{y};
    EXPECT_LE(std::abs(off), 4) << "item " << item;
  });
}

TEST_F(SharedText, FloatsAgree) {
  // Polynomials, dot products and roots of numbers below 1, possibly contracted: some 8 roundings.
  for (const std::uint32_t which :
       {PPM_PROBE_CIRCLE, PPM_PROBE_FRAME, PPM_PROBE_CAMERA, PPM_PROBE_UNPACK})
    compare_floats(which, 8 * 0x1p-24);
  // Fresnel's terms subtract products of the size of eta, 2.1, before they divide.
  compare_floats(PPM_PROBE_FRESNEL, 16 * 0x1p-24);
  // Either side may put each component of the half vector off by three roundings, which the
  // squared denominator of the distribution multiplies by 2 / alpha = 40.
  compare_floats(PPM_PROBE_GGX, 256 * 0x1p-24);
}

TEST_F(SharedText, PackedDirectionsDifferByAStepAtMost) {
  compare(PPM_PROBE_PACK, [](std::uint32_t x, std::uint32_t y, std::size_t item) {
    const auto apart = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
    EXPECT_LE(apart(x & 0xffffu, y & 0xffffu), 1u) << "item " << item;
    EXPECT_LE(apart(x >> 16, y >> 16), 1u) << "item " << item;
  });
}

}  // namespace
}  // namespace ppm::tests
