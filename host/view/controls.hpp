// What keys and the mouse mean. Knows of no window.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "glm/glm.hpp"
#include "pose.hpp"

namespace ppm::view {

enum class Action {
  forward,
  backward,
  left,
  right,
  up,
  down,
  narrower,
  wider,
  first_camera,
  print_camera,
  brighter,
  darker,
  usual_exposure,
  next_tone,
  pause,
  save,
  print_keys,
  close
};

struct Key {
  std::string_view name;  ///< the character that it types, in lower case, or "space", "escape"
  Action action;
  std::string_view meaning;
};

/// All, in the order in which help tells of them.
std::span<const Key> keys();
std::optional<Action> action_of(std::string_view key);
/// Keys and mouse, a line each.
std::string keys_text();

/// The pose after an action that moves the camera; nothing for the others.
std::optional<Pose> moved_by(Action action, const Pose& pose);

enum class Button { left, right };  ///< any other than the left one counts as the right one

/// From buttons and points of the window to turns, shifts and clicks. A button that is pressed and
/// hardly moves is a click.
class Mouse {
 public:
  /// `shift`: the left button then moves like the right one.
  void press(Button button, glm::dvec2 at, bool shift);
  /// Where a button was let go that has moved nothing, if that was the left one.
  std::optional<glm::dvec2> release(glm::dvec2 at);

  enum class Motion { orbit, pan };
  struct Drag {
    Motion motion;
    glm::dvec2 by;  ///< since the last one
  };
  std::optional<Drag> move(glm::dvec2 to);

 private:
  struct Held {
    Motion motion;
    bool may_click;
    glm::dvec2 from;
    bool moves = false;
  };
  std::optional<Held> held_;
};

/// `height`: of the picture in the window, in the unit of the drag.
Pose dragged(const Pose& pose, const Mouse::Drag& drag, double height);

}  // namespace ppm::view
