#include "tev.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <utility>

#include "tev_packets.hpp"

namespace ppm::display {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<std::string_view, 3> kChannels = {"R", "G", "B"};
constexpr std::uint32_t kMostValues = 1u << 18;       // of a packet
constexpr int kStepMilliseconds = 50;                 // between two looks at whether it is given up
constexpr auto kPatience = std::chrono::seconds(10);  // with a viewer that takes nothing

/// Whether the socket can be written before the time is up.
bool writable(int socket, Clock::time_point until, const std::atomic<bool>& abandoned) {
  while (!abandoned && Clock::now() < until) {
    pollfd wanted{socket, POLLOUT, 0};
    if (poll(&wanted, 1, kStepMilliseconds) > 0) return true;
  }
  return false;
}

}  // namespace

TevViewer::TevViewer(TevAddress address, std::string title)
    : address_(std::move(address)), title_(std::move(title)), thread_([this] { run(); }) {}

TevViewer::~TevViewer() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    abandoned_ = true;
    waiting_.reset();
  }
  changed_.notify_all();
  thread_.join();
}

bool TevViewer::idle() const {
  const std::lock_guard lock(mutex_);
  return !sending_ && !waiting_;
}

void TevViewer::show(std::uint32_t width, std::uint32_t height, std::vector<float> rgb) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = Picture{width, height, std::move(rgb)};
  }
  changed_.notify_all();
}

void TevViewer::finish(double seconds) {
  std::unique_lock lock(mutex_);
  const bool sent = changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                                      [this] { return !sending_ && !waiting_; });
  if (sent) return;
  abandoned_ = true;
  waiting_.reset();
  if (problem_.empty()) problem_ = "takes no pictures";
}

std::optional<std::string> TevViewer::problem() {
  const std::lock_guard lock(mutex_);
  if (problem_.empty() || told_) return std::nullopt;
  told_ = true;
  return problem_;
}

void TevViewer::run() {
  for (;;) {
    Picture picture;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return waiting_ || closing_; });
      if (closing_) break;
      picture = std::move(*waiting_);
      waiting_.reset();
      sending_ = true;
    }
    const std::string wrong = send(picture);
    if (!wrong.empty()) disconnect();
    {
      const std::lock_guard lock(mutex_);
      sending_ = false;
      if (problem_.empty()) problem_ = wrong;
    }
    changed_.notify_all();
  }
  disconnect();
}

std::string TevViewer::send(const Picture& picture) {
  const auto width = static_cast<std::int32_t>(picture.width);
  const auto height = static_cast<std::int32_t>(picture.height);
  if (socket_ < 0) {
    if (std::string wrong = connect(); !wrong.empty()) return wrong;
    // What is left of an earlier connection would be there twice.
    const std::string packets = (created_before_ ? tev_close_image(title_) : std::string()) +
                                tev_create_image(title_, width, height, kChannels, true);
    created_before_ = true;
    if (std::string wrong = send_bytes(packets); !wrong.empty()) return wrong;
  }
  const std::uint32_t rows = std::max(1u, kMostValues / picture.width);
  std::vector<float> values;
  for (std::uint32_t y = 0; y < picture.height; y += rows) {
    const std::uint32_t count = std::min(rows, picture.height - y);
    for (std::size_t channel = 0; channel < kChannels.size(); ++channel) {
      values.clear();
      const std::size_t first = std::size_t{3} * y * picture.width;
      for (std::size_t i = 0; i < std::size_t{count} * picture.width; ++i) {
        values.push_back(picture.rgb[first + 3 * i + channel]);
      }
      std::string wrong =
          send_bytes(tev_update_image(title_, kChannels[channel], 0, static_cast<std::int32_t>(y),
                                      width, static_cast<std::int32_t>(count), values));
      if (!wrong.empty()) return wrong;
    }
  }
  return {};
}

std::string TevViewer::connect() {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(address_.host.c_str(), std::to_string(address_.port).c_str(),
                                    &wanted, &found)) {
    return gai_strerror(error);
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
  std::string wrong = "no such address";
  for (const addrinfo* a = found; a; a = a->ai_next) {
    socket_ = socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
    if (socket_ < 0) {
      wrong = std::strerror(errno);
      continue;
    }
    int error = ::connect(socket_, a->ai_addr, a->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      error = ETIMEDOUT;
      socklen_t size = sizeof error;
      if (writable(socket_, Clock::now() + kPatience, abandoned_)) {
        getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
      }
    }
    if (error == 0) return {};
    wrong = std::strerror(error);
    disconnect();
  }
  return wrong;
}

std::string TevViewer::send_bytes(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!writable(socket_, Clock::now() + kPatience, abandoned_)) return "takes no pictures";
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
      return std::strerror(errno);
    }
  }
  return {};
}

void TevViewer::disconnect() {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
}

}  // namespace ppm::display
