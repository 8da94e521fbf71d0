#include "status.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace ppm::view {
namespace {

template <class Vector>
std::string rgb_text(const Vector& v) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", v[0], v[1], v[2]);
}

std::string count_text(std::uint64_t count) {
  if (count < 10000) return fmt::format("{}", count);
  const double number = static_cast<double>(count);
  return count < 1000000 ? fmt::format("{:.3g} k", 1e-3 * number)
                         : fmt::format("{:.4g} M", 1e-6 * number);
}

std::string hit_text(const render::ProbeReading& hit, std::uint64_t emitted) {
  const double scale = std::numbers::pi * hit.radius * hit.radius * static_cast<double>(emitted);
  const std::array<double, 3> tau = {scale * hit.radiance[0], scale * hit.radiance[1],
                                     scale * hit.radiance[2]};
  return fmt::format("hit point L {}, R {:.4g}, N {:.4g}, tau {}", rgb_text(hit.radiance),
                     hit.radius, hit.photons, rgb_text(tau));
}

std::string reading_text(const Reading& reading, std::uint64_t emitted) {
  std::string text = fmt::format("pixel {},{}: L {}", reading.pixel.x, reading.pixel.y,
                                 rgb_text(reading.radiance));
  if (reading.hit) text += "; " + hit_text(*reading.hit, emitted);
  return text;
}

}  // namespace

std::string passes_text(std::uint64_t passes) {
  return fmt::format("{} {}", passes, passes == 1 ? "pass" : "passes");
}

std::string title_text(const Status& status, const Frame* frame) {
  const std::uint64_t passes = frame ? frame->passes : 0;
  std::string text = fmt::format("{}: {}, ", status.scene, status.method);
  if (status.passes) text += fmt::format("{} of ", passes);
  text += passes_text(status.passes.value_or(passes));
  if (frame && frame->photons > 0) text += fmt::format(", {} photons", count_text(frame->photons));
  if (status.encoding.exposure != 0.0) {
    text += fmt::format(", exposure {:+.3g}", status.encoding.exposure);
  }
  if (status.encoding.tone != image::Tone::linear) {
    text +=
        fmt::format(", {}", image::tone_names()[static_cast<std::size_t>(status.encoding.tone)]);
  }
  if (status.paused) text += ", paused";
  if (frame && frame->reading) text += " | " + reading_text(*frame->reading, frame->photons);
  return text;
}

std::string reading_line(const Reading& reading, std::uint64_t passes, std::uint64_t emitted) {
  return fmt::format("{}, after {}", reading_text(reading, emitted), passes_text(passes));
}

}  // namespace ppm::view
