// The rendering's side of the viewer, with an integrator that only counts.
#include "painter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "counter.hpp"
#include "temporary_folder.hpp"

namespace ppm::view {
namespace {

constexpr std::uint64_t kPasses = 5;

class ViewPainter : public ::testing::Test {
 protected:
  ViewPainter() {
    subject_.settings.width = 4;
    subject_.settings.height = 3;
    subject_.files = {folder_ / "a.pfm"};
  }

  /// Waits for a frame of this camera with so many passes.
  Frame frame(std::uint64_t camera_number, std::uint64_t passes) {
    return wait_for(frames_, [&](const Frame& frame) {
      return frame.camera_number == camera_number && frame.passes == passes;
    });
  }
  std::string line() {
    return wait_for(lines_, [](const Line&) { return true; }).text;
  }

  /// All that is delivered, as it is.
  void collect() {
    Deliveries deliveries = mailbox_.collect();
    const std::lock_guard lock(mutex_);
    if (deliveries.frame) frames_.push_back(*deliveries.frame);
    lines_.insert(lines_.end(), deliveries.lines.begin(), deliveries.lines.end());
    came_.notify_all();
  }

  /// Takes the first that `is_it`; nothing comes within a minute: an empty one.
  template <class Thing, class Condition>
  Thing wait_for(std::vector<Thing>& things, Condition is_it) {
    std::unique_lock lock(mutex_);
    auto found = things.end();
    const auto is_there = [&] {
      found = std::ranges::find_if(things, is_it);
      return found != things.end();
    };
    if (!came_.wait_for(lock, std::chrono::minutes(1), is_there)) {
      ADD_FAILURE() << "nothing came";
      return {};
    }
    Thing thing = *found;
    things.erase(things.begin(), found + 1);
    return thing;
  }

  test::TemporaryFolder folder_;
  render::Circumstances circumstances_;
  Subject subject_{{}, circumstances_, kPasses, {}, {}};
  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<Frame> frames_;
  std::vector<Line> lines_;
  Mailbox mailbox_{[this] { collect(); }};
};

/// Its thread; ends with it.
class AtWork {
 public:
  AtWork(Painter& painter, Mailbox& mailbox) : mailbox_(mailbox), thread_([&] { painter.run(); }) {}
  ~AtWork() {
    mailbox_.quit();
    thread_.join();
  }

 private:
  Mailbox& mailbox_;
  std::thread thread_;
};

TEST_F(ViewPainter, RefinesUntilThePassesAreMadeFromEachCamera) {
  test::Counter counter(subject_.settings);
  Painter painter(counter, subject_, mailbox_);
  const AtWork at_work(painter, mailbox_);
  frame(0, 1);
  const Frame last = frame(0, kPasses);
  EXPECT_EQ(last.picture->rgb[0], static_cast<float>(kPasses));
  EXPECT_EQ(last.photons, kPasses * subject_.settings.photons_per_pass);
  EXPECT_FALSE(last.reading);
  EXPECT_EQ(mailbox_.go_to({}), 1u);
  frame(1, 1);
  frame(1, kPasses);
  EXPECT_EQ(counter.looked, 1);
  EXPECT_EQ(counter.prepared, 2);
}

TEST_F(ViewPainter, APauseLastsAndACameraStillShows) {
  test::Counter counter(subject_.settings);
  Painter painter(counter, subject_, mailbox_);
  mailbox_.pause(true);
  const AtWork at_work(painter, mailbox_);
  frame(0, 1);
  mailbox_.go_to({});
  frame(1, 1);
  mailbox_.inspect({3, 2});  // answered while it rests
  EXPECT_EQ(line(), "pixel 3,2: L 1 0.5 0.25, after 1 pass");
  EXPECT_TRUE(frame(1, 1).reading);
  mailbox_.pause(false);
  frame(1, kPasses);
}

TEST_F(ViewPainter, WritesWhatItShows) {
  test::Counter counter(subject_.settings);
  Painter painter(counter, subject_, mailbox_);
  const AtWork at_work(painter, mailbox_);
  frame(0, kPasses);
  mailbox_.save({});
  EXPECT_EQ(line(), "wrote " + (folder_ / "a.pfm").string() + " after 5 passes");
  const std::string file = test::file_text(folder_ / "a.pfm");
  const Frame shown = frame(0, kPasses);
  const float first[3] = {5.0f, 0.5f, 0.25f};  // of every row
  EXPECT_NE(file.find(std::string(reinterpret_cast<const char*>(first), sizeof first)),
            std::string::npos);
  EXPECT_EQ(shown.picture->rgb[0], first[0]);
}

/// Somebody drags: whenever one camera is prepared the next one waits.
class Dragged : public test::Counter {
 public:
  Dragged(const render::Settings& settings, Mailbox& mailbox)
      : Counter(settings), mailbox_(mailbox) {}
  bool prepare(const std::function<bool()>& interrupted) override {
    if (looked < 3) mailbox_.go_to({});
    return Counter::prepare(interrupted);
  }

 private:
  Mailbox& mailbox_;
};

TEST_F(ViewPainter, EachCameraOfADragShowsAPictureAndNoMore) {
  Dragged dragged(subject_.settings, mailbox_);
  Painter painter(dragged, subject_, mailbox_);
  const AtWork at_work(painter, mailbox_);
  for (const std::uint64_t camera : {0u, 1u, 2u}) {
    frame(camera, 1);
    const std::lock_guard lock(mutex_);
    for (const Frame& other : frames_) EXPECT_GT(other.camera_number, camera);
  }
  frame(3, kPasses);
  EXPECT_EQ(dragged.prepared, 4);
}

}  // namespace
}  // namespace ppm::view
