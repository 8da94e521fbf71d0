// Light stays on its side of a surface, however thin: exactly, since no photon beyond it may count.
#include "plate.hpp"
#include "saved_state.hpp"

namespace ppm::test {
namespace {

class Leaks : public RenderTest {
 protected:
  struct Result {
    glm::dvec3 mean{0.0};
    std::uint64_t counted = 0;  // photons in discs, summed over hit points and passes
  };

  static Result render(const GltfWriter& writer) {
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, 16, 16, 20000);
    settings.radius_mode = render::RadiusMode::fixed;
    settings.radius = 0.1;
    Log log(Verbosity::quiet);
    const auto integrator = render::make_integrator(settings, scene, device(), log, 2);
    const auto never = [] { return false; };
    EXPECT_TRUE(integrator->prepare(never));
    for (int pass = 0; pass < 2; ++pass) EXPECT_TRUE(integrator->advance(never));
    EXPECT_GT(integrator->statistics().photons_stored, 1000u);
    Result result{window_mean(integrator->resolve(), whole(settings)), 0};
    const auto statistics = hit_statistics(integrator->save_state());
    EXPECT_EQ(statistics.size(), 256u);
    for (const HitStatistics& hit : statistics) result.counted += hit.photon_count;
    return result;
  }

  // Neither seen nor counted: a photon that brings no light would still shrink the radius.
  static void expect_dark(const GltfWriter& writer) {
    const Result result = render(writer);
    EXPECT_EQ(result.mean, glm::dvec3(0.0));
    EXPECT_EQ(result.counted, 0u);
  }
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
      if (from_above) {
        EXPECT_GT(render(writer).mean.x, 1.0);
      } else {
        expect_dark(writer);
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
    expect_dark(writer);
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
  expect_dark(writer);
}

}  // namespace
}  // namespace ppm::test
