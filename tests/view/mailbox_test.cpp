// What goes from one thread to the other.
#include "mailbox.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace ppm::view {
namespace {

TEST(ViewMailbox, OnlyTheNewestCameraCounts) {
  Mailbox mailbox([] {});
  scene::Camera camera;
  EXPECT_FALSE(mailbox.take(false).camera);
  EXPECT_EQ(mailbox.go_to(camera), 1u);
  camera.yfov = 1.0;
  EXPECT_EQ(mailbox.go_to(camera), 2u);
  mailbox.inspect({3, 4});
  mailbox.save({.exposure = 2.0});
  EXPECT_TRUE(mailbox.camera_waits());
  const Orders orders = mailbox.take(true);
  EXPECT_FALSE(mailbox.camera_waits());
  ASSERT_TRUE(orders.camera);
  EXPECT_EQ(orders.camera->yfov, 1.0);
  EXPECT_EQ(orders.camera_number, 2u);
  EXPECT_EQ(orders.inspect, glm::uvec2(3, 4));
  ASSERT_TRUE(orders.save_as);
  EXPECT_EQ(orders.save_as->exposure, 2.0);
  const Orders none = mailbox.take(false);
  EXPECT_FALSE(none.camera || none.inspect || none.save_as);
}

TEST(ViewMailbox, OnlyTheNewestFrameIsShownAndEveryLineSaid) {
  int woken = 0;
  Mailbox mailbox([&] { ++woken; });
  for (const std::uint64_t passes : {1u, 2u, 3u}) {
    Frame frame;
    frame.passes = passes;
    mailbox.deliver(std::move(frame));
    mailbox.deliver(Line{std::to_string(passes)});
  }
  mailbox.fail(std::make_exception_ptr(std::runtime_error("broken")));
  EXPECT_EQ(woken, 7);
  const Deliveries deliveries = mailbox.collect();
  ASSERT_TRUE(deliveries.frame);
  EXPECT_EQ(deliveries.frame->passes, 3u);
  ASSERT_EQ(deliveries.lines.size(), 3u);
  EXPECT_EQ(deliveries.lines[1].text, "2");
  EXPECT_THROW(std::rethrow_exception(deliveries.failure), std::runtime_error);
  const Deliveries none = mailbox.collect();
  EXPECT_FALSE(none.frame || !none.lines.empty() || none.failure);
}

// Whoever waits is woken by each kind of order; would hang otherwise.
TEST(ViewMailbox, OrdersWakeWhoWaits) {
  const std::function<void(Mailbox&)> orders[] = {
      [](Mailbox& m) { m.go_to({}); }, [](Mailbox& m) { m.inspect({0, 0}); },
      [](Mailbox& m) { m.save({}); },  [](Mailbox& m) { m.pause(true); },
      [](Mailbox& m) { m.quit(); },
  };
  for (const auto& order : orders) {
    Mailbox mailbox([] {});
    std::thread waiting([&] { mailbox.take(true); });
    order(mailbox);
    waiting.join();
  }
  Mailbox mailbox([] {});
  mailbox.pause(true);
  mailbox.quit();
  EXPECT_TRUE(mailbox.paused() && mailbox.quits());
}

}  // namespace
}  // namespace ppm::view
