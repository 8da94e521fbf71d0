#include "camera_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "failure.hpp"
#include "load_gltf.hpp"

namespace ppm::cli {
namespace {

constexpr double kDefaultAspect = 4.0 / 3.0;
constexpr double kFarthest = 1e18;  // in the working frame: single precision can square it

std::string list_cameras(const scene::Scene& scene) {
  std::string list;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.cameras[i].name);
  }
  return list;
}

const scene::Camera& select_camera(const std::string& selector, const scene::Scene& scene) {
  if (selector.empty()) return scene.cameras.front();
  const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                  [&](const auto& camera) { return camera.name == selector; });
  if (named != scene.cameras.end()) return *named;
  std::size_t index = 0;
  const char* const last = selector.data() + selector.size();
  const auto [end, error] = std::from_chars(selector.data(), last, index);
  if (error == std::errc{} && end == last && index < scene.cameras.size()) {
    return scene.cameras[index];
  }
  throw Failure(scene.file, "--camera", fmt::format("there is no camera '{}'", selector),
                fmt::format("the file has {}", list_cameras(scene)));
}

bool is_negligible(const glm::dvec3& part, const glm::dvec3& whole) {
  return !(glm::length(part) > 1e-9 * glm::length(whole));
}

/// What is left of `up` across `forward`, or nothing where they are parallel.
std::optional<glm::dvec3> across(const glm::dvec3& up, const glm::dvec3& forward) {
  const glm::dvec3 rest = up - glm::dot(up, forward) * forward;
  if (is_negligible(rest, up)) return std::nullopt;
  return glm::normalize(rest);
}

/// Turns the camera, keeping `up` as far as `forward` lets it. `up_is_asked_for`: else another way
/// will do.
void orient(scene::Camera& camera, const glm::dvec3& forward, const glm::dvec3& up,
            bool up_is_asked_for, const std::string& file) {
  camera.forward = forward;
  std::optional<glm::dvec3> upright = across(up, forward);
  if (!upright && !up_is_asked_for) upright = across({0.0, 0.0, -1.0}, forward);
  if (!upright) {
    throw Failure(file, "--camera-up", "it points where the camera looks",
                  "choose another --camera-up");
  }
  camera.up = *upright;
  camera.right = glm::cross(camera.forward, camera.up);
}

glm::dvec3 working_point(const glm::dvec3& world, const char* option, const scene::Scene& scene) {
  const glm::dvec3 point = scene.frame.to_working(world);
  if (!(glm::length(point) <= kFarthest)) {
    throw Failure(scene.file, option, "it is out of all proportion to the scene",
                  "choose a point closer to it");
  }
  return point;
}

/// Of any length but zero, even where its square overflows or vanishes.
glm::dvec3 unit(const glm::dvec3& v) {
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

void replace_view(scene::Camera& camera, const RenderOptions& options, const scene::Scene& scene) {
  if (options.camera_position) {
    camera.position = working_point(*options.camera_position, "--camera-position", scene);
  }
  if (options.camera_fov) {
    camera.yfov = *options.camera_fov * std::numbers::pi / 180.0;
    camera.ymag.reset();  // an angle asks for a pinhole
  }
  if (!options.camera_target && !options.camera_up) return;

  glm::dvec3 forward = camera.forward;
  glm::dvec3 up = camera.up;
  if (options.camera_target) {
    const glm::dvec3 target = working_point(*options.camera_target, "--camera-target", scene);
    const glm::dvec3 way = target - camera.position;
    if (is_negligible(way, camera.position) && is_negligible(way, glm::dvec3(1.0))) {
      throw Failure(scene.file, "--camera-target", "it is where the camera stands",
                    "choose another --camera-target or --camera-position");
    }
    forward = unit(way);
    up = {0.0, 1.0, 0.0};
  }
  if (options.camera_up) up = unit(*options.camera_up);
  orient(camera, forward, up, options.camera_up.has_value(), scene.file);
}

std::uint32_t checked_side(double pixels, const char* option, const scene::Camera& camera) {
  const double rounded = std::max(1.0, std::round(pixels));
  if (!(rounded <= kLargestSide)) {
    throw Failure(option, "",
                  fmt::format("camera '{}' asks for {} pixels, more than {}", camera.name, rounded,
                              kLargestSide),
                  "give both --width and --height");
  }
  return static_cast<std::uint32_t>(rounded);
}

}  // namespace

scene::Camera choose_camera(const RenderOptions& options, const scene::Scene& scene, Log& log) {
  scene::Camera camera;
  if (scene.cameras.empty()) {
    if (!options.camera.empty()) {
      throw Failure(scene.file, "--camera", "the file has no camera",
                    "leave --camera out, or give --camera-position and --camera-target");
    }
    camera = scene::frame_camera(scene);
    if (!options.camera_position || !options.camera_target) {
      log.warn(scene.file + ": there is no camera; one is placed that sees the whole scene");
    }
  } else {
    camera = select_camera(options.camera, scene);
  }
  replace_view(camera, options, scene);
  return camera;
}

std::pair<std::uint32_t, std::uint32_t> choose_resolution(const RenderOptions& options,
                                                          const scene::Camera& camera,
                                                          std::uint32_t default_width) {
  const double aspect = camera.aspect.value_or(kDefaultAspect);
  if (options.height) {
    const std::uint32_t height = *options.height;
    return {options.width ? *options.width : checked_side(height * aspect, "--width", camera),
            height};
  }
  const std::uint32_t width = options.width.value_or(default_width);
  return {width, checked_side(width / aspect, "--height", camera)};
}

}  // namespace ppm::cli
