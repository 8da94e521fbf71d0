// Exclusive prefix sums on the device against std::exclusive_scan.
#include <gtest/gtest.h>

#include <numeric>

#include "device_fixture.hpp"
#include "exclusive_scan.hpp"
#include "implementation.hpp"
#include "randoms.hpp"
#include "shared/layout.h"

namespace ppm::tests {
namespace {

constexpr std::uint32_t kSlice = PPM_SCAN_SLICE * PPM_SCAN_CHUNK;  // entries of one middle dispatch

class Scan : public DeviceTest {
 protected:
  void check(std::span<const std::uint32_t> counts) {
    const gpu::Buffer in = gpu::make_buffer(device(), "counts", counts, gpu::Usage::storage);
    // A word behind the total must stay as it was.
    const gpu::Buffer out(device(), "starts", (counts.size() + 2) * 4, gpu::Usage::storage);
    const render::ExclusiveScan scan(device(), counts.size());
    device().run([&](gpu::Recorder& recorder) {
      recorder.fill(out, 0xdeadbeefu, out.bytes());
      scan.record(recorder, in, out, static_cast<std::uint32_t>(counts.size()));
    });
    std::vector<std::uint32_t> expected(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), expected.begin(), 0u);
    expected.push_back(expected.back() + counts.back());
    expected.push_back(0xdeadbeefu);
    EXPECT_TRUE(out.download<std::uint32_t>(expected.size()) == expected)
        << counts.size() << " entries";
  }
};

TEST_F(Scan, AwkwardSizes) {
  Randoms random(1);
  for (const std::uint32_t size :
       {1u, 2u, PPM_SCAN_CHUNK - 1u, PPM_SCAN_CHUNK + 0u, PPM_SCAN_CHUNK + 1u,
        64u * PPM_SCAN_CHUNK - 1u, 64u * PPM_SCAN_CHUNK, 64u * PPM_SCAN_CHUNK + 1u, 1234567u,
        kSlice - 1u, kSlice, kSlice + 1u, kSlice + PPM_SCAN_CHUNK + 1u}) {
    std::vector<std::uint32_t> counts(size);
    for (std::uint32_t& count : counts) count = random.below(400);  // sums below 2^32
    check(counts);
  }
}

// As on devices whose profile lets no invocation add up many chunks.
TEST_F(Scan, InLevels) {
  gpu::DeviceProfile& profile = device().implementation().profile;
  const gpu::DeviceProfile usual = profile;
  profile.serial_scan_chunks = 2;
  Randoms random(2);
  for (const std::uint32_t size :
       {1u, 2u * PPM_SCAN_CHUNK, 2u * PPM_SCAN_CHUNK + 1u, 1234567u,
        1u * PPM_SCAN_CHUNK * PPM_SCAN_CHUNK, 3u * PPM_SCAN_CHUNK * PPM_SCAN_CHUNK + 1u}) {
    std::vector<std::uint32_t> counts(size);
    for (std::uint32_t& count : counts) count = random.below(400);
    check(counts);
  }
  profile = usual;
}

TEST_F(Scan, ZerosAndOneLargeCount) {
  std::vector<std::uint32_t> counts(3 * PPM_SCAN_CHUNK + 5, 0);
  check(counts);
  counts[PPM_SCAN_CHUNK] = 0xffffffffu;
  check(counts);
}

TEST_F(Scan, ServesSmallerArraysThanItWasMadeFor) {
  const std::vector<std::uint32_t> counts(1000, 3);
  const gpu::Buffer in =
      gpu::make_buffer(device(), "counts", std::span(counts), gpu::Usage::storage);
  const gpu::Buffer out(device(), "starts", 4004, gpu::Usage::storage);
  const render::ExclusiveScan scan(device(), 100000);
  for (const std::uint32_t size : {1000u, 10u}) {
    device().run([&](gpu::Recorder& recorder) { scan.record(recorder, in, out, size); });
    const auto starts = out.download<std::uint32_t>(size + 1);
    for (std::uint32_t i = 0; i <= size; ++i) ASSERT_EQ(starts[i], 3 * i);
  }
}

}  // namespace
}  // namespace ppm::tests
