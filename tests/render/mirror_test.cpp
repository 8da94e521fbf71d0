// The mirror image equals the thing.
#include <array>
#include <cmath>

#include "render_harness.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 3, kSeeds = 8;

class MirrorImage : public RenderTest {};

// Half a room, x in [-1, 0] but for its wall at x = 0, with what is in it; mirrored in that plane
// with `side` -1.
void add_half_room(GltfWriter& writer, double side) {
  glm::dmat4 mirror(1.0);
  mirror[0][0] = side;
  const auto white = writer.material(lambert(glm::dvec3(0.7)));
  const auto red = writer.material(lambert({0.7, 0.2, 0.1}));
  const std::array walls = {
      quad({-1, -1, -1}, {0, 0, 2}, {1, 0, 0}), quad({-1, 1, -1}, {1, 0, 0}, {0, 0, 2}),
      quad({-1, -1, -1}, {1, 0, 0}, {0, 2, 0}), quad({-1, -1, 1}, {0, 2, 0}, {1, 0, 0})};
  for (const Mesh& wall : walls) writer.mesh(wall, white, mirror);
  writer.mesh(quad({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red, mirror);

  const auto ball = writer.material(lambert({0.2, 0.4, 0.8}));
  writer.mesh(icosphere(3), ball, mirror * placed({-0.55, -0.3, -0.35}, 0.3));
  const auto box_material = writer.material(metal({0.9, 0.7, 0.3}, 0.6));
  writer.mesh(box({-0.75f, -0.5f, 0.2f}, {-0.4f, 0.3f, 0.6f}), box_material, mirror);
  writer.point_light({side * -0.4, 0.75, 0.1}, {1.0, 0.9, 0.8}, 2.0);
}

// The method of images: a room with a perfect mirror for a wall shows in it what the room twice as
// large shows that has, instead of the mirror, everything again on the other side: by symmetry the
// light that crosses the plane is the light that the mirror would have sent back. The other half is
// made by a mirroring transform, so that it takes both a correct mirror and correctly mirrored
// geometry, normals included, to pass.
//
// Both pictures estimate the same radiance with the same radii, and twice the photons keep their
// density, so that biases agree too, but within a radius of the mirror, where discs on the walls
// are cut in one scene only: the camera, 0.2 from the mirror with tan(0.5) to each side, sees of
// the walls none but the one opposite the mirror. Allowed is noise alone: 6 standard errors of the
// difference for 16 blocks of 3 channels, of 8 + 8 seeds (Student's t with 14 degrees: 3e-5 each).
TEST_F(MirrorImage, EqualsTheThing) {
  const auto blocks = [](bool with_mirror) {
    GltfWriter writer;
    add_half_room(writer, 1.0);
    if (with_mirror) {
      writer.mesh(quad({0, -1, -1}, {0, 0, 2}, {0, 2, 0}), writer.material(metal(glm::dvec3(1.0))));
    } else {
      add_half_room(writer, -1.0);
    }
    writer.camera("towards the mirror", {-0.2, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0);
    const scene::Scene scene = load(writer);
    render::Settings settings = small_settings(scene, 16, 16, with_mirror ? 15000 : 30000);
    settings.radius_mode = render::RadiusMode::fixed;
    settings.radius = 0.08;
    return replicate(device(), scene, settings, kPasses, kSeeds,
                     [](const render::Picture& picture) { return block_means(picture, 4); });
  };
  const std::vector<Estimate> image = blocks(true), thing = blocks(false);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const glm::dvec3 a = image[i].standard_error, b = thing[i].standard_error;
    const Estimate difference{image[i].mean - thing[i].mean, glm::sqrt(a * a + b * b)};
    EXPECT_TRUE(agrees(difference, glm::dvec3(0.0), 6.0, 0.0)) << "block " << i;
    EXPECT_GT(image[i].mean.x, 0.0);
  }
}

}  // namespace
}  // namespace ppm::test
