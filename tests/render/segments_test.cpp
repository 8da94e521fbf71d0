// How the scene's buffers are cut never changes the picture.
#include "shared/bindings.h"
#include "small_room.hpp"

namespace ppm::test {
namespace {

class SegmentedScene : public RenderTest {};

TEST_F(SegmentedScene, GivesTheSamePictureToTheByte) {
  const scene::Scene scene = load(small_room(1.0, {}));
  render::Settings settings = room_settings(scene);
  const render::Picture expected = render_scene(device(), scene, settings, 2).picture;
  // Down to where its largest buffer, 64 bytes a triangle, has nearly as many as there may be.
  settings.segment_bytes = 1024;
  while (settings.segment_bytes * PPM_SEGMENTS < 64 * scene.triangles.size()) {
    settings.segment_bytes *= 2;
  }
  ASSERT_GT(64 * scene.triangles.size(), 4 * settings.segment_bytes) << "nothing is cut";
  for (int times = 0; times < 2; ++times) {
    EXPECT_TRUE(same_bits(render_scene(device(), scene, settings, 2).picture, expected))
        << "segments of " << settings.segment_bytes << " bytes";
    settings.segment_bytes *= 4;
  }
}

}  // namespace
}  // namespace ppm::test
