// Packets of the tev image viewer (github.com/Tom94/tev, include/tev/Ipc.h): a length of 32 bits,
// itself included, one byte that says what it is, then its fields; numbers little-endian, texts end
// with a zero byte. The kinds used here are those that every version knows.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ppm::display {

enum class TevPacket : std::uint8_t { close_image = 2, update_image = 3, create_image = 4 };

/// An image of this name and size in the viewer, black; `grab_focus`: it is shown at once.
std::string tev_create_image(std::string_view name, std::int32_t width, std::int32_t height,
                             std::span<const std::string_view> channels, bool grab_focus);

/// One channel of a part of it: `values` row by row from the top, width * height of them.
std::string tev_update_image(std::string_view name, std::string_view channel, std::int32_t x,
                             std::int32_t y, std::int32_t width, std::int32_t height,
                             std::span<const float> values);

std::string tev_close_image(std::string_view name);

}  // namespace ppm::display
