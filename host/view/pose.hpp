// Where the viewer's camera stands, as --camera-position and its kin say it, and how it is moved.
#pragma once

#include <optional>
#include <string>

#include "glm/glm.hpp"
#include "scene.hpp"

namespace ppm::view {

/// World units and degrees.
struct Pose {
  glm::dvec3 position{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};               ///< what it looks at and turns about; never where it stands
  glm::dvec3 up{0.0, 1.0, 0.0};         ///< axis that it turns about; unit, never where it looks
  double fov = 45.0;                    ///< full vertical angle
  std::optional<double> half_height{};  ///< orthographic: of what it sees; `fov` says nothing then

  double distance() const;     ///< of the target
  glm::dvec3 forward() const;  ///< unit
  glm::dvec3 right() const;    ///< idem

  bool operator==(const Pose&) const = default;
};

/// Of a camera as it is rendered. It turns about the vertical unless it is tilted against it. Where
/// there is no `target`, that is what the camera looks at, or, where it looks past everything, the
/// point before it that is closest to the scene's centre. Asks the scene's triangles.
Pose pose_of(const scene::Camera& camera, const scene::Scene& scene,
             const std::optional<glm::dvec3>& target);

/// Around the target at the same distance, by angles in radians: as if what is seen were turned
/// right and down. It stops short of the axis.
Pose orbited(const Pose& pose, double right, double down);

/// What is seen at the target's distance moves by parts of the picture's height, right and down.
Pose panned(const Pose& pose, glm::dvec2 by);

/// The distance to the target times `factor`, at least `least`.
Pose dollied(const Pose& pose, double factor, double least);

/// Camera and target move to the right, along the axis and forward, in units of their distance.
Pose flown(const Pose& pose, const glm::dvec3& by);

/// What is seen at the target's distance becomes larger by `factor`; an orthographic camera stays.
Pose widened(const Pose& pose, double factor);

/// To what a few decimals say: position and target to `digits` behind the point.
Pose rounded(const Pose& pose, int digits);

/// The digits that tell a hundred-thousandth of `length` apart, at least 0.
int digits_for(double length);

/// What makes `render` see the same, to the bit: "--camera-position X,Y,Z ...". An orthographic
/// camera's height is its file's.
std::string camera_options(const Pose& pose);

}  // namespace ppm::view
