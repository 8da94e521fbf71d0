#include "mailbox.hpp"

#include <utility>

namespace ppm::view {

template <class Change>
void Mailbox::order(Change change) {
  {
    const std::lock_guard lock(mutex_);
    change();
    changed_ = true;
  }
  ordered_.notify_one();
}

template <class Change>
void Mailbox::bring(Change change) {
  {
    const std::lock_guard lock(mutex_);
    change();
  }
  wake_();
}

std::uint64_t Mailbox::go_to(const scene::Camera& camera) {
  order([&] {
    orders_.camera = camera;
    orders_.camera_number = ++cameras_;
    camera_waits_ = true;
  });
  return cameras_;
}

void Mailbox::inspect(glm::uvec2 pixel) {
  order([&] { orders_.inspect = pixel; });
}

void Mailbox::save(const image::Encoding& encoding) {
  order([&] { orders_.save_as = encoding; });
}

void Mailbox::pause(bool paused) {
  order([&] { paused_ = paused; });
}

void Mailbox::quit() {
  order([&] { quits_ = true; });
}

Deliveries Mailbox::collect() {
  const std::lock_guard lock(mutex_);
  return std::exchange(deliveries_, {});
}

Orders Mailbox::take(bool idle) {
  std::unique_lock lock(mutex_);
  if (idle) ordered_.wait(lock, [&] { return changed_; });
  changed_ = false;
  camera_waits_ = false;
  return std::exchange(orders_, {});
}

void Mailbox::deliver(Frame frame) {
  bring([&] { deliveries_.frame = std::move(frame); });
}

void Mailbox::deliver(Line line) {
  bring([&] { deliveries_.lines.push_back(std::move(line)); });
}

void Mailbox::fail(std::exception_ptr failure) {
  bring([&] { deliveries_.failure = std::move(failure); });
}

}  // namespace ppm::view
