// Keys and mouse, without a window.
#include "controls.hpp"

#include <gtest/gtest.h>

#include <set>

#include "temporary_folder.hpp"

namespace ppm::view {
namespace {

TEST(ViewControls, EachKeyHasOneMeaning) {
  std::set<std::string_view> names;
  std::set<Action> actions;
  for (const Key& key : keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_TRUE(actions.insert(key.action).second) << key.name;
    EXPECT_EQ(action_of(key.name), key.action);
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(Action::close) + 1);
  EXPECT_EQ(action_of("="), Action::brighter);
  for (const char* none : {"", "x", "W", "ö", "spac"}) EXPECT_FALSE(action_of(none)) << none;
}

TEST(ViewControls, ReadmeTellsOfThem) {
  const std::string readme = test::file_text(PPM_README);
  for (const Key& key : keys()) {
    EXPECT_NE(readme.find("| `" + std::string(key.name) + "` | " + std::string(key.meaning)),
              std::string::npos)
        << key.name;
  }
}

TEST(ViewControls, ActionsThatMoveAreUndoneByTheirOpposites) {
  const Pose pose{{1.0, 2.0, 5.0}, {0.5, 1.0, -1.0}, {0.0, 1.0, 0.0}, 40.0, {}};
  constexpr std::pair<Action, Action> kOpposites[] = {{Action::forward, Action::backward},
                                                      {Action::left, Action::right},
                                                      {Action::up, Action::down},
                                                      {Action::narrower, Action::wider}};
  for (const auto& [there, back] : kOpposites) {
    const std::optional<Pose> moved = moved_by(there, pose);
    ASSERT_TRUE(moved);
    EXPECT_TRUE(moved->position != pose.position || moved->fov != pose.fov);
    const std::optional<Pose> returned = moved_by(back, *moved);
    ASSERT_TRUE(returned);
    EXPECT_LT(glm::length(returned->position - pose.position), 1e-12);
    EXPECT_NEAR(returned->fov, pose.fov, 1e-12);
  }
  for (const Action action : {Action::save, Action::pause, Action::close, Action::first_camera}) {
    EXPECT_FALSE(moved_by(action, pose));
  }
}

TEST(ViewMouse, WhatHardlyMovesIsAClick) {
  Mouse mouse;
  EXPECT_FALSE(mouse.move({5.0, 5.0}));
  EXPECT_FALSE(mouse.release({5.0, 5.0}));
  mouse.press(Button::left, {10.0, 10.0}, false);
  EXPECT_FALSE(mouse.move({12.0, 11.0}));
  EXPECT_EQ(mouse.release({12.0, 11.0}), glm::dvec2(12.0, 11.0));
  for (const bool shift : {false, true}) {  // nothing is asked by what would shift
    mouse.press(shift ? Button::left : Button::right, {10.0, 10.0}, shift);
    EXPECT_FALSE(mouse.release({10.0, 10.0}));
  }
}

TEST(ViewMouse, DragsAddUpToTheWholeWay) {
  for (const bool shift : {false, true}) {
    Mouse mouse;
    mouse.press(Button::left, {10.0, 10.0}, shift);
    mouse.press(Button::right, {0.0, 0.0}, false);  // while the other is held
    glm::dvec2 sum(0.0);
    for (const glm::dvec2 to : {glm::dvec2(11.0, 10.0), {20.0, 12.0}, {12.0, 40.0}, {10.0, 11.0}}) {
      const auto drag = mouse.move(to);
      if (!drag) continue;
      EXPECT_EQ(drag->motion, shift ? Mouse::Motion::pan : Mouse::Motion::orbit);
      sum += drag->by;
    }
    EXPECT_EQ(sum, glm::dvec2(0.0, 1.0));
    EXPECT_FALSE(mouse.release({10.0, 11.0}));  // it did move
    EXPECT_FALSE(mouse.move({50.0, 50.0}));
  }
}

// A drag to the right is a turn to the right, whatever the window's size.
TEST(ViewMouse, DragsScaleWithThePicture) {
  const Pose pose{{1.0, 2.0, 5.0}, {0.5, 1.0, -1.0}, {0.0, 1.0, 0.0}, 40.0, {}};
  const Pose small = dragged(pose, {Mouse::Motion::orbit, {10.0, 5.0}}, 100.0);
  const Pose large = dragged(pose, {Mouse::Motion::orbit, {40.0, 20.0}}, 400.0);
  EXPECT_LT(glm::length(small.position - large.position), 1e-12);
  EXPECT_LT(glm::dot(small.position - pose.position, pose.right()), 0.0);
  const Pose shifted = dragged(pose, {Mouse::Motion::pan, {100.0, 0.0}}, 100.0);
  EXPECT_LT(glm::length(shifted.position - panned(pose, {1.0, 0.0}).position), 1e-12);
}

}  // namespace
}  // namespace ppm::view
