// Files that say the same in different ways load to the same triangles, as far as what they are
// written in can say it. Each way stands beside the plain one.
#include "mesh_variants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "load_gltf.hpp"

namespace ppm::test {
namespace {

using scene::Corner;
using scene::Scene;
using scene::Triangle;

/// How far two triangles lie from each other, the second one's corners counted from `turn`.
struct Distance {
  double position = 0.0, normal = 0.0, texcoord = 0.0, color = 0.0;
};

template <typename Vector>
void widen(double& most, const Vector& a, const Vector& b) {
  for (glm::length_t i = 0; i < Vector::length(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
}

Distance distance(const Scene& a, const Triangle& first, const Scene& b, const Triangle& second,
                  std::size_t turn) {
  Distance result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& p = first.corners[i];
    const Corner& q = second.corners[(i + turn) % 3];
    widen(result.position, a.frame.to_world(glm::dvec3(p.position)),
          b.frame.to_world(glm::dvec3(q.position)));
    widen(result.normal, p.normal, q.normal);
    widen(result.texcoord, p.texcoord, q.texcoord);
    widen(result.color, p.color, q.color);
  }
  return result;
}

/// The closest triangle of `b`, whichever corner comes first.
std::pair<std::size_t, Distance> closest(const Scene& a, const Triangle& triangle, const Scene& b) {
  std::pair<std::size_t, Distance> best{0, {1e300}};
  for (std::size_t i = 0; i < b.triangles.size(); ++i) {
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const Distance d = distance(a, triangle, b, b.triangles[i], turn);
      if (d.position < best.second.position) best = {i, d};
    }
  }
  return best;
}

TEST(MeshVariants, LoadToTheSameTriangles) {
  const std::vector<MeshVariant> variants = mesh_variants();
  const auto load_variant = [](const MeshVariant& variant) {
    const TemporaryFolder folder;
    Log log(Verbosity::quiet);
    Scene scene = scene::load_gltf(variant.write(folder, {}), log);
    // What joins strips has no area.
    const std::size_t joints = warnings_with(log, "without area");
    EXPECT_EQ(joints, variant.name == "one strip" ? 1u : 0u) << variant.name;
    EXPECT_EQ(log.warnings().size(), joints) << variant.name << ": " << log.warnings().back();
    return scene;
  };
  const Scene expected = load_variant(variants.front());
  ASSERT_EQ(expected.triangles.size(), 96u);
  for (const MeshVariant& variant : variants) {
    const Scene scene = load_variant(variant);
    EXPECT_EQ(scene.triangles.size(), expected.triangles.size()) << variant.name;
    const Precision& precision = variant.precision;
    std::vector<bool> is_met(scene.triangles.size(), false);
    Distance most;
    for (const Triangle& triangle : expected.triangles) {
      const auto [index, d] = closest(expected, triangle, scene);
      EXPECT_FALSE(is_met.at(index)) << variant.name;
      is_met[index] = true;
      most = {std::max(most.position, d.position), std::max(most.normal, d.normal),
              std::max(most.texcoord, d.texcoord), std::max(most.color, d.color)};
    }
    // Copies are scaled by 1.5 at most.
    EXPECT_LE(most.position, 1.5 * precision.position) << variant.name;
    EXPECT_LE(most.normal, precision.normal) << variant.name;
    EXPECT_LE(most.texcoord, precision.texcoord) << variant.name;
    EXPECT_LE(most.color, precision.color) << variant.name;
  }
}

}  // namespace
}  // namespace ppm::test
