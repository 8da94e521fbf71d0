#include "dark_room.hpp"

#include <array>

#include "modeller.hpp"

namespace ppm::bench {
namespace {

// In the camera's own axes: distances along its view, and offsets as tangents of angles. The mouth
// fills (2 kMouth)^2 of the 2 tan(yfov / 2) by 4/3 of that which the picture spans: 4.9 %.
constexpr float kNear = 0.12f, kFar = 1.72f;
constexpr float kMouth = 0.14f, kMouthHeight = 0.3f;
// The shaft widens a little faster than the view through its mouth, so that the camera sees
// nothing but its far end, neither the walls nor the lamp on one of them.
constexpr float kWidening = 1.1f;
// From its mouth to here the shaft is black, lest its walls send light out of the mouth sideways.
constexpr float kCollar = 0.6f;
constexpr std::uint32_t kCuts = 8;

class Shaft {
 public:
  explicit Shaft(const scene::Camera& camera)
      : eye_(camera.position), right_(camera.right), up_(camera.up), forward_(camera.forward) {}

  /// Across the shaft (x, y in [-1,1]) at a distance from the camera.
  glm::vec3 at(float x, float y, float distance) const {
    const float half = kMouth * (kNear + kWidening * (distance - kNear));
    return eye_ + distance * (forward_ + kMouthHeight * up_) + half * (x * right_ + y * up_);
  }
  glm::vec3 behind_eye(float x, float y, float distance) const {
    return eye_ + x * right_ + y * up_ - distance * forward_;
  }

 private:
  glm::vec3 eye_, right_, up_, forward_;
};

/// A flat quadrilateral, its corners counter-clockwise from the side that it faces.
void add_quad(Modeller& modeller, const std::array<glm::vec3, 4>& corners, std::uint32_t cuts,
              std::uint32_t material) {
  const glm::vec3 normal =
      glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  modeller.sheet(cuts, cuts, material, [&](double u, double v) {
    const auto s = static_cast<float>(u), t = static_cast<float>(v);
    return Surface{
        glm::mix(glm::mix(corners[0], corners[1], s), glm::mix(corners[3], corners[2], s), t),
        normal};
  });
}

/// The four walls between two distances, facing inwards.
void add_walls(Modeller& modeller, const Shaft& shaft, float near, float far,
               std::uint32_t material) {
  constexpr std::array<std::array<float, 2>, 4> kRing = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < kRing.size(); ++i) {
    const auto [x0, y0] = kRing[i];
    const auto [x1, y1] = kRing[(i + 1) % kRing.size()];
    add_quad(modeller,
             {shaft.at(x0, y0, near), shaft.at(x1, y1, near), shaft.at(x1, y1, far),
              shaft.at(x0, y0, far)},
             kCuts, material);
  }
}

}  // namespace

scene::Scene make_dark_room(std::size_t triangles) {
  scene::Scene scene = make_unlit_room(triangles);
  scene.file = "dark";
  const Shaft shaft(scene.cameras.front());
  Modeller modeller(scene);
  const std::uint32_t paper = modeller.diffuse("paper", glm::vec3(0.75f));
  add_walls(modeller, shaft, kNear, kCollar, modeller.diffuse("soot", glm::vec3(0.0f)));
  add_walls(modeller, shaft, kCollar, kFar, paper);
  add_quad(
      modeller,
      {shaft.at(-1, -1, kFar), shaft.at(1, -1, kFar), shaft.at(1, 1, kFar), shaft.at(-1, 1, kFar)},
      kCuts, paper);
  // Just inside the upper wall, facing down.
  constexpr float kBelow = 0.99f;
  add_quad(modeller,
           {shaft.at(-0.4f, kBelow, 1.6f), shaft.at(0.4f, kBelow, 1.6f),
            shaft.at(0.4f, kBelow, 1.3f), shaft.at(-0.4f, kBelow, 1.3f)},
           1, modeller.emitter("lamp", {20.0f, 18.0f, 15.0f}));
  // Where the light falls that comes out of the mouth.
  const float half = 0.1f;
  add_quad(modeller,
           {shaft.behind_eye(-half, -half, 0.01f), shaft.behind_eye(half, -half, 0.01f),
            shaft.behind_eye(half, half, 0.01f), shaft.behind_eye(-half, half, 0.01f)},
           1, modeller.diffuse("black", glm::vec3(0.0f)));
  modeller.find_bounds();
  return scene;
}

}  // namespace ppm::bench
