// Light stays on its side of a surface, however thin: exactly, since no photon beyond it may count.
#include "plate.hpp"

namespace ppm::test {
namespace {

class Leaks : public RenderTest {
 protected:
  glm::dvec3 mean_of(const GltfWriter& writer, double radius) {
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, 16, 16, 20000);
    settings.radius_mode = render::RadiusMode::fixed;
    settings.radius = radius;
    const Rendering rendering = render_scene(device(), scene, settings, 2);
    photons_ = rendering.statistics.photons_stored;
    return window_mean(rendering.picture, whole(settings));
  }

  std::uint64_t photons_ = 0;
};

// A sheet without thickness, lit from above: bright from above, black from below.
TEST_F(Leaks, SheetIsDarkBehind) {
  for (const bool from_above : {true, false}) {
    for (const bool front_up : {true, false}) {
      GltfWriter writer;
      writer.mesh(plate(0.0f, 1.0f, front_up), writer.material(lambert(glm::dvec3(0.9))));
      writer.point_light({0.1, 0.6, 0.0}, glm::dvec3(1.0), 5.0);
      PlateView view;
      view.eye = {0.0, from_above ? 0.5 : -0.5, 0.0};
      view.add_camera(writer);
      const glm::dvec3 mean = mean_of(writer, 0.1);
      EXPECT_GT(photons_, 1000u);
      if (from_above) {
        EXPECT_GT(mean.x, 1.0);
      } else {
        EXPECT_EQ(mean, glm::dvec3(0.0));
      }
    }
  }
}

// Two sheets a hundredth of a disc apart: all photons on the upper one lie within reach of the
// discs on the underside of the lower one.
TEST_F(Leaks, ThinWallIsDarkBehind) {
  for (const bool fronts_outwards : {true, false}) {
    GltfWriter writer;
    const auto white = writer.material(lambert(glm::dvec3(0.9)));
    writer.mesh(plate(0.0f, 1.0f, !fronts_outwards), white);
    writer.mesh(plate(0.001f, 1.0f, fronts_outwards), white);
    writer.directional_light({0.2, -1.0, 0.1}, glm::dvec3(1.0), 5.0);
    PlateView view;
    view.eye = {0.0, -0.5, 0.0};
    view.add_camera(writer);
    EXPECT_EQ(mean_of(writer, 0.1), glm::dvec3(0.0));
    EXPECT_GT(photons_, 1000u);
  }
}

// A closed box without thickness in bright daylight: no photon passes its edges and corners, and
// those that land outside count nowhere within. Turned, so that edges are no axis-aligned lucky
// case.
TEST_F(Leaks, ClosedBoxIsDarkInside) {
  GltfWriter writer;
  const glm::dmat4 turned(glm::dvec4(0.48, 0.64, -0.6, 0.0), glm::dvec4(-0.8, 0.6, 0.0, 0.0),
                          glm::dvec4(0.36, 0.48, 0.8, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
  writer.mesh(box(glm::vec3(-0.5f), glm::vec3(0.5f)), writer.material(lambert(glm::dvec3(0.9))),
              turned);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 position(0.1, 0.2, -0.1);
      position[axis] = 1.5 * side;
      writer.point_light(position, glm::dvec3(1.0), 5.0);
    }
  }
  writer.directional_light({0.3, -1.0, 0.2}, glm::dvec3(1.0), 10.0);
  writer.camera("inside", {0.1, 0.0, 0.2}, {-0.3, -0.2, -1.0}, 2.0);
  EXPECT_EQ(mean_of(writer, 0.1), glm::dvec3(0.0));
  EXPECT_GT(photons_, 1000u);
}

}  // namespace
}  // namespace ppm::test
