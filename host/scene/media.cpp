#include "media.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace ppm::scene {
namespace {

bool same_medium(const Material& a, const Material& b) {
  return a.priority == b.priority && a.ior == b.ior && a.dispersion == b.dispersion &&
         a.attenuation_color == b.attenuation_color &&
         a.attenuation_distance == b.attenuation_distance;
}

bool outranks(const Material& a, const Material& b) {
  return a.priority != b.priority ? a.priority > b.priority : index_of(a) > index_of(b);
}

struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{-std::numeric_limits<float>::max()};

  void add(glm::vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  bool meets(const Bounds& other) const {
    const glm::vec3 gap = glm::max(low - other.high, other.low - high);
    return std::max({gap.x, gap.y, gap.z}) <= 2.0f * kMediaOverlap;
  }
};

struct PositionHash {
  std::size_t operator()(const glm::vec3& p) const {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const float value : {p.x, p.y, p.z}) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// The faces that meet at a corner.
struct Meeting {
  glm::vec3 normals{0.0f};    // sum over the faces, by the angle that each takes
  float least_cosine = 1.0f;  // between the sum and a face's normal
};

glm::vec3 face_normal(const Triangle& triangle) {
  const auto& c = triangle.corners;
  return glm::vec3(
      glm::normalize(glm::cross(glm::dvec3(c[1].position) - glm::dvec3(c[0].position),
                                glm::dvec3(c[2].position) - glm::dvec3(c[0].position))));
}

float angle_at(const Triangle& triangle, std::size_t corner) {
  const glm::vec3 a = triangle.corners[(corner + 1) % 3].position;
  const glm::vec3 b = triangle.corners[(corner + 2) % 3].position;
  const glm::vec3 p = triangle.corners[corner].position;
  return std::acos(glm::clamp(glm::dot(glm::normalize(a - p), glm::normalize(b - p)), -1.0f, 1.0f));
}

/// Moves every face of the triangles for which `grows` outwards by kMediaOverlap or somewhat more.
/// Corners at one place move alike, so that what was closed stays so.
template <class Predicate>
void grow(std::vector<Triangle>& triangles, const Predicate& grows) {
  constexpr float kSharpest = 0.25f;  // corners sharper than this stay behind
  std::unordered_map<glm::vec3, Meeting, PositionHash> meetings;
  const auto for_each_corner = [&](auto&& act) {
    for (Triangle& triangle : triangles) {
      if (!grows(triangle)) continue;
      const glm::vec3 normal = face_normal(triangle);
      for (std::size_t corner = 0; corner < 3; ++corner) act(triangle, corner, normal);
    }
  };
  for_each_corner([&](const Triangle& triangle, std::size_t corner, glm::vec3 normal) {
    const float angle = angle_at(triangle, corner);
    if (angle > 0.0f) meetings[triangle.corners[corner].position].normals += angle * normal;
  });
  for_each_corner([&](const Triangle& triangle, std::size_t corner, glm::vec3 normal) {
    Meeting& meeting = meetings[triangle.corners[corner].position];
    const float length = glm::length(meeting.normals);
    const float cosine = length > 0.0f ? glm::dot(meeting.normals, normal) / length : 0.0f;
    meeting.least_cosine = std::min(meeting.least_cosine, cosine);
  });
  std::unordered_map<glm::vec3, glm::vec3, PositionHash> moved;
  for (const auto& [position, meeting] : meetings) {
    const float length = glm::length(meeting.normals);
    if (!(length > 0.0f)) continue;
    const float distance = kMediaOverlap / std::max(meeting.least_cosine, kSharpest);
    moved[position] = position + meeting.normals * (distance / length);
  }
  for (Triangle& triangle : triangles) {
    if (!grows(triangle)) continue;
    for (Corner& corner : triangle.corners) {
      const auto place = moved.find(corner.position);
      if (place != moved.end()) corner.position = place->second;
    }
  }
}

}  // namespace

float index_of(const Material& material) {
  constexpr float kDensest = 1e6f;
  return material.ior == 0.0f ? kDensest : material.ior;
}

bool has_inside(const Material& material) {
  return material.solid && material.transmission > 0.0f &&
         (material.metallic < 1.0f || material.metallic_roughness_texture);
}

MediaRanking rank_media(const std::vector<Material>& materials) {
  std::vector<std::uint32_t> distinct;  // the first material of each medium
  std::vector<std::size_t> medium_of(materials.size(), 0);
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    if (!has_inside(materials[i])) continue;
    const auto known = std::ranges::find_if(
        distinct, [&](std::uint32_t other) { return same_medium(materials[i], materials[other]); });
    medium_of[i] = static_cast<std::size_t>(known - distinct.begin());
    if (known == distinct.end()) distinct.push_back(i);
  }
  std::vector<std::size_t> order(distinct.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return outranks(materials[distinct[a]], materials[distinct[b]]);
  });
  MediaRanking ranking;
  std::vector<std::uint32_t> number(distinct.size());
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    number[order[rank]] = rank + 1;
    ranking.example.push_back(distinct[order[rank]]);
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    ranking.of_material.push_back(has_inside(materials[i]) ? number[medium_of[i]] : 0);
  }
  return ranking;
}

void let_touching_media_overlap(Scene& scene) {
  const MediaRanking ranking = rank_media(scene.materials);
  if (ranking.example.size() < 2) return;
  std::vector<Bounds> bounds(ranking.example.size() + 1);
  const auto medium_of = [&](const Triangle& triangle) {
    return ranking.of_material[triangle.material];
  };
  for (const Triangle& triangle : scene.triangles) {
    for (const Corner& corner : triangle.corners) bounds[medium_of(triangle)].add(corner.position);
  }
  for (std::uint32_t medium = 2; medium < bounds.size(); ++medium) {
    bool touches = false;
    for (std::uint32_t other = 1; other < bounds.size(); ++other) {
      touches = touches || (other != medium && bounds[medium].meets(bounds[other]));
    }
    if (!touches) continue;
    grow(scene.triangles, [&](const Triangle& triangle) { return medium_of(triangle) == medium; });
  }
}

}  // namespace ppm::scene
