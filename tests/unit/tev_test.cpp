// The tev viewer's protocol, held to a small receiver that takes packets apart.
#include "tev.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>

#include "tev_packets.hpp"

namespace ppm::display {
namespace {

/// Reads the fields of one packet as tev's IpcPacket does; throws where they end too early.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T value() {
    T result;
    if (bytes_.size() < sizeof result) throw std::runtime_error("packet ends early");
    std::memcpy(&result, bytes_.data(), sizeof result);
    bytes_.remove_prefix(sizeof result);
    return result;
  }
  std::string text() {
    const std::size_t end = bytes_.find('\0');
    if (end == std::string_view::npos) throw std::runtime_error("text without end");
    const std::string result(bytes_.substr(0, end));
    bytes_.remove_prefix(end + 1);
    return result;
  }
  bool empty() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// What a viewer knows after a stream of packets.
struct Images {
  struct Image {
    std::int32_t width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;
  };
  std::map<std::string, Image> images;
  int created = 0, closed = 0;

  void take(std::string_view packet) {
    Fields fields(packet);
    if (fields.value<std::uint32_t>() != packet.size()) throw std::runtime_error("wrong length");
    const auto kind = fields.value<std::uint8_t>();
    if (kind == 2) {
      images.erase(fields.text());
      ++closed;
    } else if (kind == 4) {
      ++created;
      fields.value<std::uint8_t>();  // grab focus
      Image& image = images[fields.text()];
      image.width = fields.value<std::int32_t>();
      image.height = fields.value<std::int32_t>();
      const auto count = fields.value<std::int32_t>();
      const auto pixels =
          static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
      for (std::int32_t i = 0; i < count; ++i) image.channels[fields.text()].resize(pixels);
    } else if (kind == 3) {
      fields.value<std::uint8_t>();
      Image& image = images.at(fields.text());
      std::vector<float>& channel = image.channels.at(fields.text());
      const auto x = fields.value<std::int32_t>(), y = fields.value<std::int32_t>();
      const auto width = fields.value<std::int32_t>(), height = fields.value<std::int32_t>();
      for (std::int32_t row = 0; row < height; ++row) {
        for (std::int32_t column = 0; column < width; ++column) {
          channel.at(static_cast<std::size_t>((y + row) * image.width + x + column)) =
              fields.value<float>();
        }
      }
    } else {
      throw std::runtime_error("unknown packet");
    }
    if (!fields.empty()) throw std::runtime_error("packet too long");
  }

  /// Takes the whole packets of `stream` and leaves the rest.
  void take_all(std::string& stream) {
    for (;;) {
      std::uint32_t size = 0;
      if (stream.size() < sizeof size) return;
      std::memcpy(&size, stream.data(), sizeof size);
      if (stream.size() < size) return;
      take(std::string_view(stream).substr(0, size));
      stream.erase(0, size);
    }
  }
};

/// Listens on the loopback, on a port of the system's choice.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        listen(socket_, 4) != 0 ||
        getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
      throw std::runtime_error("cannot listen");
    }
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(); }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  int accept() const { return ::accept(socket_, nullptr, nullptr); }
  TevAddress address() const { return {"127.0.0.1", port_}; }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

/// All that comes until the other side closes.
std::string read_all(int connection) {
  std::string bytes;
  char part[65536];
  for (ssize_t count; (count = read(connection, part, sizeof part)) > 0;) {
    bytes.append(part, static_cast<std::size_t>(count));
  }
  close(connection);
  return bytes;
}

/// 700 x 500: more than one packet a channel.
std::vector<float> ramp(float offset) {
  std::vector<float> rgb(3 * 700 * 500);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = offset + static_cast<float>(i);
  return rgb;
}

void expect_picture(const Images& images, const std::string& title, const std::vector<float>& rgb) {
  const auto found = images.images.find(title);
  ASSERT_NE(found, images.images.end());
  const Images::Image& image = found->second;
  EXPECT_EQ(image.width, 700);
  EXPECT_EQ(image.height, 500);
  ASSERT_EQ(image.channels.size(), 3u);
  const char* const names[] = {"R", "G", "B"};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const std::vector<float>& values = image.channels.at(names[channel]);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      wrong += values[i] != rgb[3 * i + channel] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u) << names[channel];
  }
}

// Bytes written out by hand from tev's include/tev/Ipc.h.
TEST(TevPackets, AreLaidOutAsTheViewerReadsThem) {
  const std::string_view channels[] = {"R", "G"};
  EXPECT_EQ(tev_create_image("ab", 2, 1, channels, true),
            std::string("\x19\0\0\0\4\1ab\0\2\0\0\0\1\0\0\0\2\0\0\0R\0G\0", 0x19));
  const float value = 1.0f;  // 0x3f800000
  EXPECT_EQ(tev_update_image("ab", "R", 1, 2, 1, 1, {&value, 1}),
            std::string("\x1f\0\0\0\3\0ab\0R\0\1\0\0\0\2\0\0\0\1\0\0\0\1\0\0\0\0\0\x80\x3f", 0x1f));
  EXPECT_EQ(tev_close_image("ab"), std::string("\x08\0\0\0\2ab\0", 8));
}

TEST(TevViewer, ShowsPicturesOneAfterTheOther) {
  const Listener listener;
  std::string bytes;
  std::thread receiver([&] { bytes = read_all(listener.accept()); });
  {
    TevViewer viewer(listener.address(), "a picture");
    viewer.show(700, 500, ramp(0.0f));
    viewer.finish(60.0);
    EXPECT_TRUE(viewer.idle());
    viewer.show(700, 500, ramp(0.5f));
    viewer.finish(60.0);
    EXPECT_EQ(viewer.problem(), std::nullopt);
  }
  receiver.join();
  Images images;
  images.take_all(bytes);
  EXPECT_TRUE(bytes.empty());
  EXPECT_EQ(images.created, 1);
  EXPECT_EQ(images.closed, 0);
  expect_picture(images, "a picture", ramp(0.5f));
}

TEST(TevViewer, MayLeaveAndComeBack) {
  const Listener listener;
  Images images;
  std::string bytes;
  std::thread receiver([&] {
    const int first = listener.accept();
    char part[64];
    EXPECT_GT(read(first, part, sizeof part), 0);
    close(first);  // in the middle of a picture
    bytes = read_all(listener.accept());
  });
  {
    TevViewer viewer(listener.address(), "p");
    std::optional<std::string> problem;
    for (int i = 0; i < 10 && !problem; ++i) {  // what is on its way may still be taken
      viewer.show(700, 500, ramp(0.0f));
      viewer.finish(60.0);
      problem = viewer.problem();
    }
    EXPECT_TRUE(problem);
    viewer.show(700, 500, ramp(0.25f));
    viewer.finish(60.0);
    EXPECT_FALSE(viewer.problem());  // told once
  }
  receiver.join();
  images.take_all(bytes);
  EXPECT_TRUE(bytes.empty());
  EXPECT_EQ(images.created, 1);
  EXPECT_EQ(images.closed, 1);  // what the first connection has left
  expect_picture(images, "p", ramp(0.25f));
}

TEST(TevViewer, MayBeAbsent) {
  Listener listener;
  const TevAddress nobody = listener.address();
  listener.close();
  TevViewer viewer(nobody, "p");
  viewer.show(700, 500, ramp(0.0f));
  viewer.finish(60.0);
  EXPECT_TRUE(viewer.idle());
  const auto problem = viewer.problem();
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->find("refused"), std::string::npos) << *problem;
  viewer.show(700, 500, ramp(0.0f));
  viewer.finish(60.0);
  EXPECT_FALSE(viewer.problem());
}

// It accepts, by the system's backlog, and never reads: whoever shows is not held up, and at the
// end no longer than told.
TEST(TevViewer, MayTakeNothing) {
  const Listener listener;
  TevViewer viewer(listener.address(), "p");
  viewer.show(2000, 2000, std::vector<float>(3 * 2000 * 2000, 1.0f));
  viewer.show(2000, 2000, std::vector<float>(3 * 2000 * 2000, 2.0f));
  EXPECT_FALSE(viewer.idle());
  viewer.finish(0.2);
  EXPECT_TRUE(viewer.problem());
}

}  // namespace
}  // namespace ppm::display
