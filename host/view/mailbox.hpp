// What the window asks of the rendering, and what comes back: the only way from one thread to the
// other.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glm/glm.hpp"
#include "image.hpp"
#include "integrator.hpp"
#include "scene.hpp"

namespace ppm::view {

/// What the window has asked for since it was looked at last.
struct Orders {
  std::optional<scene::Camera> camera;     ///< to go on from, passes forgotten
  std::uint64_t camera_number = 0;         ///< of that one, counted from 1
  std::optional<glm::uvec2> inspect;       ///< a pixel to be told of now, and read from now on
  std::optional<image::Encoding> save_as;  ///< the picture so far is to be written
};

/// What a pixel holds.
struct Reading {
  glm::uvec2 pixel{0};
  glm::dvec3 radiance{0.0};                 ///< of the picture
  std::optional<render::ProbeReading> hit;  ///< of the hit point that weighs most there
};

/// The picture so far, and what it is made of.
struct Frame {
  std::shared_ptr<const render::Picture> picture;
  std::uint64_t passes = 0, photons = 0;
  std::uint64_t camera_number = 0;  ///< of whose it is; 0: the first one
  std::optional<Reading> reading;
};

/// A line for people.
struct Line {
  std::string text;
  bool is_warning = false;
};

/// What the rendering has brought since it was asked last.
struct Deliveries {
  std::optional<Frame> frame;  ///< the newest one
  std::vector<Line> lines;
  std::exception_ptr failure;  ///< the rendering ended with it
};

class Mailbox {
 public:
  /// `wake` is called on the rendering's thread after each delivery.
  explicit Mailbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  // The window's side.
  /// Returns the camera's number.
  std::uint64_t go_to(const scene::Camera& camera);
  void inspect(glm::uvec2 pixel);
  void save(const image::Encoding& encoding);
  void pause(bool paused);
  void quit();
  Deliveries collect();

  // The rendering's side.
  /// Takes the orders. `idle`: waits until there are any, it is to go on, or it is to end.
  Orders take(bool idle);
  bool paused() const { return paused_; }
  bool quits() const { return quits_; }
  bool camera_waits() const { return camera_waits_; }
  void deliver(Frame frame);
  void deliver(Line line);
  void fail(std::exception_ptr failure);

 private:
  template <class Change>
  void order(Change change);
  template <class Change>
  void bring(Change change);

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable ordered_;
  bool changed_ = false;       // since the last `take`
  std::uint64_t cameras_ = 0;  // that were ordered
  Orders orders_;
  Deliveries deliveries_;
  std::atomic<bool> paused_{false}, quits_{false}, camera_waits_{false};
};

}  // namespace ppm::view
