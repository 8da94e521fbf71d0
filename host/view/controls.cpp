#include "controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

namespace ppm::view {
namespace {

constexpr double kClick = 3.0;      // pixels that a hand may tremble
constexpr double kStep = 0.05;      // of the distance to the target
constexpr double kNarrower = 0.95;  // of what is seen

constexpr Key kKeys[] = {
    {"w", Action::forward, "fly forward"},
    {"s", Action::backward, "fly backward"},
    {"a", Action::left, "fly left"},
    {"d", Action::right, "fly right"},
    {"e", Action::up, "fly up"},
    {"q", Action::down, "fly down"},
    {"[", Action::narrower, "narrow the field of view"},
    {"]", Action::wider, "widen the field of view"},
    {"r", Action::first_camera, "return to the first camera"},
    {"c", Action::print_camera, "print the camera as options of render"},
    {"+", Action::brighter, "exposure up by half a stop"},
    {"-", Action::darker, "exposure down by half a stop"},
    {"0", Action::usual_exposure, "exposure as it was at first"},
    {"t", Action::next_tone, "next tone curve"},
    {"space", Action::pause, "pause, and go on"},
    {"o", Action::save, "write the picture so far"},
    {"h", Action::print_keys, "print these lines"},
    {"escape", Action::close, "close the window"},
};

constexpr std::pair<std::string_view, std::string_view> kMouse[] = {
    {"left", "drag: turn about what is looked at; click: print what the pixel holds"},
    {"right", "drag: shift (so does the left button with shift)"},
    {"wheel", "move closer, or away"},
};

}  // namespace

std::span<const Key> keys() {
  return kKeys;
}

std::optional<Action> action_of(std::string_view key) {
  if (key == "=") key = "+";  // one key on many keyboards
  const auto* const found = std::ranges::find(kKeys, key, &Key::name);
  return found == std::end(kKeys) ? std::nullopt : std::optional(found->action);
}

std::string keys_text() {
  std::string text;
  for (const Key& key : kKeys) text += fmt::format("  {:7} {}\n", key.name, key.meaning);
  for (const auto& [button, meaning] : kMouse) text += fmt::format("  {:7} {}\n", button, meaning);
  return text;
}

std::optional<Pose> moved_by(Action action, const Pose& pose) {
  switch (action) {
    case Action::forward:
      return flown(pose, {0.0, 0.0, kStep});
    case Action::backward:
      return flown(pose, {0.0, 0.0, -kStep});
    case Action::left:
      return flown(pose, {-kStep, 0.0, 0.0});
    case Action::right:
      return flown(pose, {kStep, 0.0, 0.0});
    case Action::up:
      return flown(pose, {0.0, kStep, 0.0});
    case Action::down:
      return flown(pose, {0.0, -kStep, 0.0});
    case Action::narrower:
      return widened(pose, kNarrower);
    case Action::wider:
      return widened(pose, 1.0 / kNarrower);
    default:
      return std::nullopt;
  }
}

void Mouse::press(Button button, glm::dvec2 at, bool shift) {
  const bool orbits = button == Button::left && !shift;
  if (!held_) held_ = {orbits ? Motion::orbit : Motion::pan, orbits, at};
}

std::optional<glm::dvec2> Mouse::release(glm::dvec2 at) {
  const std::optional<Held> held = held_;
  held_.reset();
  return held && held->may_click && !held->moves ? std::optional(at) : std::nullopt;
}

std::optional<Mouse::Drag> Mouse::move(glm::dvec2 to) {
  if (!held_) return std::nullopt;
  const glm::dvec2 by = to - held_->from;
  if (!held_->moves && glm::length(by) <= kClick) return std::nullopt;
  held_->moves = true;
  held_->from = to;
  return Drag{held_->motion, by};
}

Pose dragged(const Pose& pose, const Mouse::Drag& drag, double height) {
  const glm::dvec2 share = drag.by / height;
  if (drag.motion == Mouse::Motion::pan) return panned(pose, share);
  return orbited(pose, std::numbers::pi * share.x, std::numbers::pi * share.y);
}

}  // namespace ppm::view
