#include "pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "ahead.hpp"

namespace ppm::view {
namespace {

constexpr glm::dvec3 kVertical{0.0, 1.0, 0.0};
constexpr double kSteepest = 0.49 * std::numbers::pi;  // angle with the plane across the axis
constexpr double kNarrowest = 0.5, kWidest = 170.0;    // degrees
constexpr int kUpDigits = 9, kAngleDigits = 4;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// The nearest number of so many decimals, so that it prints as such.
double decimal(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  double result = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result + 0.0;  // no -0
}

glm::dvec3 decimal(const glm::dvec3& v, int digits) {
  return {decimal(v.x, digits), decimal(v.y, digits), decimal(v.z, digits)};
}

double height_at_target(const Pose& pose) {
  if (pose.half_height) return 2.0 * *pose.half_height;
  return 2.0 * pose.distance() * std::tan(0.5 * radians(pose.fov));
}

Pose moved(Pose pose, const glm::dvec3& by) {
  pose.position += by;
  pose.target += by;
  return pose;
}

std::string text(const glm::dvec3& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

bool is_upright(const scene::Camera& camera) {
  return camera.up.y > 0.0 && std::abs(camera.right.y) < 1e-6 &&
         std::abs(camera.forward.y) < std::sin(kSteepest);
}

}  // namespace

double Pose::distance() const {
  return glm::length(target - position);
}

glm::dvec3 Pose::forward() const {
  return (target - position) / distance();
}

glm::dvec3 Pose::right() const {
  return glm::normalize(glm::cross(forward(), up));
}

Pose pose_of(const scene::Camera& camera, const scene::Scene& scene,
             const std::optional<glm::dvec3>& target) {
  Pose pose;
  pose.position = scene.frame.to_world(camera.position);
  pose.up = is_upright(camera) ? kVertical : camera.up;
  pose.fov = camera.yfov * 180.0 / std::numbers::pi;
  if (camera.ymag) pose.half_height = *camera.ymag / scene.frame.scale;
  const glm::dvec3 low(scene.bounds_min), high(scene.bounds_max);
  const double radius = std::max(0.5 * glm::length(high - low), 1e-6);
  const double along = glm::dot(0.5 * (low + high) - camera.position, camera.forward);
  const double distance = distance_ahead(scene, camera).value_or(std::max(along, 0.1 * radius));
  const glm::dvec3 ahead = camera.position + distance * camera.forward;
  pose.target = target.value_or(scene.frame.to_world(ahead));
  return pose;
}

Pose orbited(const Pose& pose, double right, double down) {
  const glm::dvec3 offset = pose.position - pose.target;
  const double distance = pose.distance();
  const double height = glm::dot(offset, pose.up);
  const glm::dvec3 level = glm::normalize(offset - height * pose.up);
  const glm::dvec3 turned = std::cos(right) * level - std::sin(right) * glm::cross(pose.up, level);
  const double before = std::asin(std::clamp(height / distance, -1.0, 1.0));
  const double steepest = std::max(kSteepest, std::abs(before));
  const double angle = std::clamp(before + down, -steepest, steepest);
  Pose result = pose;
  result.position = pose.target + distance * (std::cos(angle) * turned + std::sin(angle) * pose.up);
  return result;
}

Pose panned(const Pose& pose, glm::dvec2 by) {
  const glm::dvec3 right = pose.right();
  const glm::dvec3 upward = glm::cross(right, pose.forward());
  return moved(pose, height_at_target(pose) * (by.y * upward - by.x * right));
}

Pose dollied(const Pose& pose, double factor, double least) {
  Pose result = pose;
  const double distance = std::max(pose.distance() * factor, least);
  result.position = pose.target - distance * pose.forward();
  return result;
}

Pose flown(const Pose& pose, const glm::dvec3& by) {
  const glm::dvec3 way = by.x * pose.right() + by.y * pose.up + by.z * pose.forward();
  return moved(pose, pose.distance() * way);
}

Pose widened(const Pose& pose, double factor) {
  if (pose.half_height) return pose;
  Pose result = pose;
  const double half = std::atan(factor * std::tan(0.5 * radians(pose.fov)));
  result.fov = std::clamp(2.0 * half * 180.0 / std::numbers::pi, kNarrowest, kWidest);
  return result;
}

Pose rounded(const Pose& pose, int digits) {
  Pose result = pose;
  result.position = decimal(pose.position, digits);
  result.target = decimal(pose.target, digits);
  result.up = decimal(pose.up, kUpDigits);
  result.fov = decimal(pose.fov, kAngleDigits);
  return result;
}

int digits_for(double length) {
  return std::clamp(5 - static_cast<int>(std::floor(std::log10(length))), 0, 30);
}

std::string camera_options(const Pose& pose) {
  std::string options = fmt::format("--camera-position {} --camera-target {}", text(pose.position),
                                    text(pose.target));
  if (pose.up != kVertical) options += fmt::format(" --camera-up {}", text(pose.up));
  if (!pose.half_height) options += fmt::format(" --camera-fov {}", pose.fov);
  return options;
}

}  // namespace ppm::view
