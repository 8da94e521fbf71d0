// Hit points come out in canonical order: the same bits on every run and for any division into
// tiles.
#include <gtest/gtest.h>

#include <algorithm>

#include "device_fixture.hpp"
#include "eye_pass.hpp"
#include "room.hpp"
#include "scene_buffers.hpp"
#include "scene_pieces.hpp"

namespace ppm::tests {
namespace {

class EyeOrder : public DeviceTest {
 protected:
  using Words = std::vector<glm::uvec4>;
  struct Hits {
    std::array<Words, 4> planes;
    Words statistics;
    std::vector<std::uint32_t> starts;
    bool operator==(const Hits&) const = default;
  };

  // The pixels of the picture in `parts` tiles, put together again.
  Hits trace(std::uint32_t parts) {
    render::Settings settings = small_settings(40, 30);
    settings.samples_per_pixel = 3;
    settings.camera = room_.cameras.front();
    const render::SceneBuffers buffers(room_, settings, device(), 1);
    gpu::BindingTable table;
    buffers.bind(table);
    const render::EyeKernels kernels(device(), {});
    render::EyePass pass(device(), kernels, table, settings);
    const std::uint32_t pixels = settings.width * settings.height;
    Hits hits;
    for (std::uint32_t part = 0; part < parts; ++part) {
      const std::uint32_t first = pixels * part / parts;
      const std::uint32_t last = pixels * (part + 1) / parts;
      render::HitTile tile;
      EXPECT_EQ(pass.trace(
                    first, last - first, [] { return false; }, tile),
                render::EyePass::Result::done);
      append(hits, tile, 3 * (last - first));
    }
    return hits;
  }

  // In canonical order.
  static void append(Hits& hits, const render::HitTile& tile, std::size_t groups) {
    const auto before = static_cast<std::uint32_t>(hits.planes[0].size());
    const auto order = tile.order.download<std::uint32_t>(tile.hits);
    for (std::size_t i = 0; i < 4; ++i) {
      const Words plane = tile.planes[i].download<glm::uvec4>(tile.hits);
      for (const std::uint32_t hit : order) {
        glm::uvec4 word = plane[hit];
        if (i == 1) {
          EXPECT_EQ(word.z, hit);  // each feeds its own statistics
          word.z = 0;
        }
        hits.planes[i].push_back(word);
      }
    }
    const Words statistics = tile.statistics.download<glm::uvec4>(tile.hits);
    for (const std::uint32_t hit : order) hits.statistics.push_back(statistics[hit]);
    for (const std::uint32_t start : tile.sample_start.download<std::uint32_t>(groups))
      hits.starts.push_back(start + before);
  }

  scene::Scene room_ = bench::make_room(20000);
};

TEST_F(EyeOrder, RunsAndTilesGiveTheSameBits) {
  const Hits once = trace(1);
  ASSERT_GT(once.planes[0].size(), 3600u);  // glass makes several of a path
  for (int run = 0; run < 3; ++run) EXPECT_TRUE(trace(1) == once) << "run " << run;
  for (const std::uint32_t parts : {2u, 7u}) EXPECT_TRUE(trace(parts) == once) << parts;
}

TEST_F(EyeOrder, EveryHitPointHasOnePlace) {
  render::HitTile tile;
  render::Settings settings = small_settings(40, 30);
  settings.camera = room_.cameras.front();
  const render::SceneBuffers buffers(room_, settings, device(), 1);
  gpu::BindingTable table;
  buffers.bind(table);
  const render::EyeKernels kernels(device(), {});
  render::EyePass pass(device(), kernels, table, settings);
  ASSERT_EQ(pass.trace(
                0, 1200, [] { return false; }, tile),
            render::EyePass::Result::done);
  auto order = tile.order.download<std::uint32_t>(tile.hits);
  std::ranges::sort(order);
  for (std::uint32_t i = 0; i < tile.hits; ++i) ASSERT_EQ(order[i], i);
}

TEST_F(EyeOrder, SamplesFollowEachOtherAndDepthsRise) {
  const Hits hits = trace(1);
  for (std::size_t group = 0; group + 1 < hits.starts.size(); ++group) {
    ASSERT_LE(hits.starts[group], hits.starts[group + 1]);
    for (std::uint32_t i = hits.starts[group] + 1; i < hits.starts[group + 1]; ++i) {
      const bool light = (hits.planes[1][i].w & PPM_HIT_EMISSION) != 0u;
      const bool light_before = (hits.planes[1][i - 1].w & PPM_HIT_EMISSION) != 0u;
      if (light || light_before) continue;  // light seen does not keep its depth
      EXPECT_LE(hits.planes[1][i - 1].w >> 8 & 0xffu, hits.planes[1][i].w >> 8 & 0xffu);
    }
  }
}

}  // namespace
}  // namespace ppm::tests
