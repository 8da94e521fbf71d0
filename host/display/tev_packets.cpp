#include "tev_packets.hpp"

#include <bit>
#include <cstring>
#include <utility>

namespace ppm::display {
namespace {

static_assert(std::endian::native == std::endian::little);

class Packet {
 public:
  explicit Packet(TevPacket kind) : bytes_(sizeof(std::uint32_t), '\0') {
    bytes_ += static_cast<char>(kind);
  }

  Packet& flag(bool value) {
    bytes_ += value ? '\1' : '\0';
    return *this;
  }
  Packet& text(std::string_view value) {
    bytes_ += value;
    bytes_ += '\0';
    return *this;
  }
  Packet& number(std::int32_t value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Packet& floats(std::span<const float> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return *this;
  }

  std::string finish() {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof length);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string tev_create_image(std::string_view name, std::int32_t width, std::int32_t height,
                             std::span<const std::string_view> channels, bool grab_focus) {
  Packet packet(TevPacket::create_image);
  packet.flag(grab_focus).text(name).number(width).number(height);
  packet.number(static_cast<std::int32_t>(channels.size()));
  for (const std::string_view channel : channels) packet.text(channel);
  return packet.finish();
}

std::string tev_update_image(std::string_view name, std::string_view channel, std::int32_t x,
                             std::int32_t y, std::int32_t width, std::int32_t height,
                             std::span<const float> values) {
  Packet packet(TevPacket::update_image);
  packet.flag(false).text(name).text(channel).number(x).number(y).number(width).number(height);
  return packet.floats(values).finish();
}

std::string tev_close_image(std::string_view name) {
  return Packet(TevPacket::close_image).text(name).finish();
}

}  // namespace ppm::display
