// Pictures shown live in the tev image viewer.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace ppm::display {

struct TevAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 14158;  ///< where tev listens unless told otherwise
};

/// Sends one image over and over, in a thread of its own: whoever calls never waits for the viewer,
/// and a viewer that is slow, absent or gone only misses pictures. Where there is none, each
/// picture tries anew.
class TevViewer {
 public:
  /// `title`: of the image in the viewer.
  TevViewer(TevAddress address, std::string title);
  /// Gives up what is not sent yet. The image stays in the viewer.
  ~TevViewer();
  TevViewer(const TevViewer&) = delete;
  TevViewer& operator=(const TevViewer&) = delete;

  /// Whether nothing is being sent: a picture would be.
  bool idle() const;
  /// Row-major from the top, 3 * width * height; replaces one that waits.
  void show(std::uint32_t width, std::uint32_t height, std::vector<float> rgb);
  /// Waits until all is sent, at most so many seconds, after which the rest is given up.
  void finish(double seconds);
  /// What went wrong first, for people; once.
  std::optional<std::string> problem();

 private:
  struct Picture {
    std::uint32_t width, height;
    std::vector<float> rgb;
  };
  void run();
  /// Each returns the empty text, or what is wrong.
  std::string send(const Picture& picture);
  std::string connect();
  std::string send_bytes(std::string_view bytes);
  void disconnect();

  const TevAddress address_;
  const std::string title_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Picture> waiting_;
  std::string problem_;  // first one; told_: by problem()
  bool sending_ = false, closing_ = false, told_ = false;
  std::atomic<bool> abandoned_{false};
  // Of the thread alone.
  int socket_ = -1;
  bool created_before_ = false;
  std::thread thread_;
};

}  // namespace ppm::display
