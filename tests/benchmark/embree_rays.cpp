#include "embree_rays.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>

namespace ppm::benchmark {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kStart = 1e-5f;  // leaves the surface a ray starts on; rooms measure about 2

// A direction about `normal` with density cos/pi.
glm::vec3 diffuse_direction(glm::vec3 normal, std::mt19937& random) {
  const auto uniform = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  const float height = 2.0f * uniform() - 1.0f,
              azimuth = 2.0f * std::numbers::pi_v<float> * uniform();
  const float ring = std::sqrt(1.0f - height * height);
  // A point of the unit sphere that touches the surface here.
  const glm::vec3 sum =
      normal + glm::vec3(ring * std::cos(azimuth), ring * std::sin(azimuth), height);
  return glm::length(sum) > 1e-3f ? glm::normalize(sum) : normal;
}

}  // namespace

EmbreeScene::EmbreeScene(RTCDevice device, std::span<const scene::Triangle> triangles)
    : scene_(rtcNewScene(device)) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const corners = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), 3 * triangles.size()));
  auto* const indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.size()));
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
    corners[i] = triangles[i / 3].corners[i % 3].position;
    indices[i] = static_cast<std::uint32_t>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
}

std::uint32_t EmbreeScene::intersect(const Ray& ray, float& distance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = {ray.origin.x,
               ray.origin.y,
               ray.origin.z,
               kStart,
               ray.direction.x,
               ray.direction.y,
               ray.direction.z,
               0.0f,
               distance,
               ~0u,
               0u,
               0u};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &query);
  distance = query.ray.tfar;
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? RTC_INVALID_GEOMETRY_ID : query.hit.primID;
}

std::vector<Ray> camera_rays(const scene::Camera& camera, std::uint32_t width,
                             std::uint32_t height) {
  std::vector<Ray> rays;
  const double tan_y = std::tan(0.5 * camera.yfov), tan_x = tan_y * width / height;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const double x = (2.0 * (column + 0.5) / width - 1.0) * tan_x;
      const double y = (1.0 - 2.0 * (row + 0.5) / height) * tan_y;
      const glm::dvec3 direction =
          glm::normalize(camera.forward + x * camera.right + y * camera.up);
      rays.push_back({glm::vec3(camera.position), glm::vec3(direction)});
    }
  }
  return rays;
}

std::vector<Ray> bounce_rays(const EmbreeScene& embree, std::span<const scene::Triangle> triangles,
                             std::span<const Ray> rays) {
  std::mt19937 random(1);
  std::vector<Ray> bounces;
  for (const Ray& ray : rays) {
    float distance = kInfinity;
    const std::uint32_t hit = embree.intersect(ray, distance);
    if (hit == RTC_INVALID_GEOMETRY_ID) continue;
    const auto& corners = triangles[hit].corners;
    glm::vec3 normal = glm::normalize(glm::cross(corners[1].position - corners[0].position,
                                                 corners[2].position - corners[0].position));
    if (glm::dot(normal, ray.direction) > 0.0f) normal = -normal;
    bounces.push_back({ray.origin + distance * ray.direction, diffuse_direction(normal, random)});
  }
  return bounces;
}

double rays_per_second(const EmbreeScene& embree, std::span<const Ray> rays, unsigned threads) {
  constexpr std::size_t kBlock = 2048;
  std::atomic<std::size_t> next{0};
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> pool;
    for (unsigned i = 0; i < threads; ++i) {
      pool.emplace_back([&] {
        for (std::size_t begin = next.fetch_add(kBlock); begin < rays.size();
             begin = next.fetch_add(kBlock)) {
          for (const Ray& ray : rays.subspan(begin, std::min(kBlock, rays.size() - begin))) {
            float distance = kInfinity;
            embree.intersect(ray, distance);
          }
        }
      });
    }
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return static_cast<double>(rays.size()) / seconds.count();
}

}  // namespace ppm::benchmark
