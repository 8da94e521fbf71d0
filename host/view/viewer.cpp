#include "viewer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "controls.hpp"
#include "failure.hpp"
#include "letterbox.hpp"
#include "status.hpp"

namespace ppm::view {
namespace {

constexpr double kPatience = 0.1;        // seconds between two looks at signals
constexpr double kHalfStop = 0.5;        // EV
constexpr double kMostExposure = 100.0;  // as --exposure
constexpr double kCloser = 0.9;          // of the distance, a notch of the wheel
constexpr double kNearest = 1e-4;        // of the first distance to the target

void print(const Line& line) {
  std::FILE* const stream = line.is_warning ? stderr : stdout;
  std::fprintf(stream, "ppm-vk: %s%s\n", line.is_warning ? "warning: " : "", line.text.c_str());
  std::fflush(stream);
}

/// It ends with this object.
class PainterThread {
 public:
  PainterThread(Painter& painter, Mailbox& mailbox)
      : mailbox_(mailbox), thread_([&] {
          try {
            painter.run();
          } catch (...) {
            mailbox.fail(std::current_exception());
          }
        }) {}
  ~PainterThread() {
    mailbox_.quit();
    thread_.join();
  }
  PainterThread(const PainterThread&) = delete;
  PainterThread& operator=(const PainterThread&) = delete;

 private:
  Mailbox& mailbox_;
  std::thread thread_;
};

class Viewer {
 public:
  Viewer(const Desktop& desktop, const Subject& subject, const Stance& stance, Mailbox& mailbox)
      : subject_(subject),
        stance_(stance),
        mailbox_(mailbox),
        picture_{subject.settings.width, subject.settings.height},
        pose_(stance.pose),
        status_{subject.circumstances.scene.filename().string(), subject.settings.integrator,
                subject.passes, false, stance.encoding},
        window_(desktop, title_text(status_, nullptr), picture_) {}

  /// Until the window is closed or `interrupted` says so.
  void run(const std::function<bool()>& interrupted) {
    while (!window_.closing() && !closed_ && !interrupted()) {
      for (const Event& event : window_.wait(kPatience)) {
        std::visit([&](const auto& what) { handle(what); }, event);
      }
      if (moved_) order_camera();
      receive(mailbox_.collect());
      if (changed_ || window_.stale()) redraw();
    }
  }

 private:
  void handle(const KeyPress& press) {
    if (const std::optional<Action> action = action_of(press.key)) act(*action);
  }
  void handle(const ButtonPress& press) { mouse_.press(press.button, press.at, press.shift); }
  void handle(const ButtonRelease& release) {
    const std::optional<glm::dvec2> click = mouse_.release(release.at);
    if (!click) return;
    if (const auto pixel = pixel_at(*click, box(), picture_)) mailbox_.inspect(*pixel);
  }
  void handle(const MouseMove& move) {
    const std::optional<Mouse::Drag> drag = mouse_.move(move.to);
    if (drag) go(dragged(pose_, *drag, box().size.y));
  }
  void handle(const Scroll& scroll) {
    const double least = kNearest * stance_.pose.distance();
    go(dollied(pose_, std::pow(kCloser, scroll.up), least));
  }

  void act(Action action) {
    if (const std::optional<Pose> pose = moved_by(action, pose_)) return go(*pose);
    image::Encoding& encoding = status_.encoding;
    switch (action) {
      case Action::first_camera:
        return go_back();
      case Action::print_camera:
        if (moved_) order_camera();  // whose options these are
        return print({camera_options(rounded_pose())});
      case Action::brighter:
        encoding.exposure = std::min(encoding.exposure + kHalfStop, kMostExposure);
        break;
      case Action::darker:
        encoding.exposure = std::max(encoding.exposure - kHalfStop, -kMostExposure);
        break;
      case Action::usual_exposure:
        encoding.exposure = stance_.encoding.exposure;
        break;
      case Action::next_tone: {
        const auto next = static_cast<std::size_t>(encoding.tone) + 1;
        encoding.tone = static_cast<image::Tone>(next % image::tone_names().size());
        break;
      }
      case Action::pause:
        status_.paused = !status_.paused;
        mailbox_.pause(status_.paused);
        break;
      case Action::save:
        if (moved_) order_camera();
        return mailbox_.save(encoding);
      case Action::print_keys:
        std::fputs(keys_text().c_str(), stdout);
        std::fflush(stdout);
        break;
      case Action::close:
        closed_ = true;
        break;
      default:
        break;
    }
    changed_ = true;
  }

  /// What leaves the camera where it is (a wheel that is tilted, a field of view that cannot become
  /// wider) costs no pass.
  void go(const Pose& pose) {
    moved_ = moved_ || pose != pose_;
    pose_ = pose;
  }

  void go_back() {
    if (!ordered_pose_ && !moved_) return;
    pose_ = stance_.pose;
    ordered_pose_.reset();
    moved_ = false;
    camera_number_ = mailbox_.go_to(subject_.settings.camera);
    changed_ = true;
  }

  Pose rounded_pose() const {
    return rounded(pose_, digits_for(std::min(stance_.pose.distance(), pose_.distance())));
  }

  /// Where the pose is one that `render` would refuse, it stays as it was.
  void order_camera() {
    moved_ = false;
    const Pose pose = rounded_pose();
    if (pose == ordered_pose_) return;
    try {
      camera_number_ = mailbox_.go_to(stance_.camera_of(pose));
      ordered_pose_ = pose;
    } catch (const Failure&) {
      pose_ = ordered_pose_.value_or(stance_.pose);
    }
    changed_ = true;
  }

  void receive(Deliveries deliveries) {
    for (const Line& line : deliveries.lines) print(line);
    if (deliveries.failure) std::rethrow_exception(deliveries.failure);
    if (!deliveries.frame) return;
    frame_ = std::move(*deliveries.frame);
    changed_ = true;
  }

  Box box() const { return letterbox(picture_, glm::max(window_.frame(), glm::uvec2(1))); }

  void redraw() {
    const bool is_present = frame_ && frame_->camera_number == camera_number_;
    window_.set_title(title_text(status_, is_present ? &*frame_ : nullptr));
    const glm::uvec2 size = window_.frame();
    changed_ = false;
    if (size.x == 0 || size.y == 0) return;
    const std::vector<std::uint8_t> blank(frame_ ? 0 : std::size_t{3} * size.x * size.y);
    window_.show(frame_ ? framed(*frame_->picture, size, status_.encoding) : blank, size);
  }

  const Subject& subject_;
  const Stance& stance_;
  Mailbox& mailbox_;
  glm::uvec2 picture_;  // its size
  Pose pose_;
  std::optional<Pose> ordered_pose_;  // of the last order; nothing: the settings' own camera
  bool moved_ = false;                // since then
  std::uint64_t camera_number_ = 0;   // of the last order
  Status status_;
  Mouse mouse_;
  Window window_;
  std::optional<Frame> frame_;
  bool changed_ = true, closed_ = false;
};

}  // namespace

render::Outcome view(const Desktop& desktop, render::Integrator& integrator, const Subject& subject,
                     const Stance& stance, const render::Interruption& interruption) {
  Mailbox mailbox(&Desktop::wake);
  Viewer viewer(desktop, subject, stance, mailbox);
  Painter painter(integrator, subject, mailbox);
  const PainterThread thread(painter, mailbox);
  viewer.run([&] { return interruption.requested(); });
  return interruption.requested() ? render::Outcome::interrupted : render::Outcome::complete;
}

}  // namespace ppm::view
