#include "film.hpp"

#include <cmath>

#include "failure.hpp"
#include "memory_shortage.hpp"

namespace ppm::render {
namespace {

constexpr std::uint32_t kBindings[] = {PPM_BIND_FILM_RED, PPM_BIND_FILM_GREEN, PPM_BIND_FILM_BLUE};
constexpr std::size_t kWords = sizeof(shared::FilmSum) / sizeof(std::uint32_t);

shared::FilmConstants film_constants(const shared::SceneConstants& scene) {
  return {shared::film_scale(scene.total_power, scene.bounding_radius), scene.width, scene.height,
          0};
}

gpu::Buffer plane(gpu::Device& device, const char* name, std::uint64_t pixels) {
  const std::uint64_t most = device.max_storage_bytes() / sizeof(shared::FilmSum);
  if (pixels > most) {
    throw Failure("", "--width, --height", "a film of " + std::to_string(pixels) + " pixels",
                  "this device holds at most " + std::to_string(most) +
                      " for this method: make the picture smaller or render it by ppm");
  }
  return {device, name, pixels * sizeof(shared::FilmSum), gpu::Usage::storage};
}

double value_of(const shared::FilmSum& sum) {
  return std::ldexp(sum.top, 64) + std::ldexp(sum.high, 32) + sum.low;
}

}  // namespace

Film::Film(gpu::Device& device, const shared::SceneConstants& scene, bool keeps)
    : device_(device),
      constants_(film_constants(scene)),
      constants_buffer_(gpu::make_buffer(device, "film constants",
                                         std::span<const shared::FilmConstants>(&constants_, 1),
                                         gpu::Usage::uniform)),
      keeps_(keeps),
      planes_{plane(device, "film, red", pixels()), plane(device, "film, green", pixels()),
              plane(device, "film, blue", pixels())} {
  clear();
}

void Film::bind(gpu::BindingTable& table) const {
  table.set(PPM_BIND_FILM_CONSTANTS, constants_buffer_);
  for (std::size_t i = 0; i < planes_.size(); ++i) table.set(kBindings[i], planes_[i]);
}

void Film::bind_sums(gpu::BindingTable& table, std::uint32_t first_binding) const {
  for (const gpu::Buffer& plane : planes_) table.set(first_binding++, plane);
}

void Film::clear() {
  device_.run([&](gpu::Recorder& recorder) {
    for (const gpu::Buffer& plane : planes_) recorder.fill(plane, 0, plane.bytes());
  });
}

bool Film::keep() {
  if (!keeps_) return false;
  if (!kept_[0]) {
    try {
      kept_ = {plane(device_, "kept film, red", pixels()),
               plane(device_, "kept film, green", pixels()),
               plane(device_, "kept film, blue", pixels())};
    } catch (const gpu::MemoryShortage&) {
      return keeps_ = false;
    }
  }
  device_.run([&](gpu::Recorder& recorder) {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      recorder.copy(planes_[i], kept_[i], planes_[i].bytes());
    }
  });
  return true;
}

void Film::revert() {
  PPM_ASSERT(kept_[0], "nothing was kept");
  device_.run([&](gpu::Recorder& recorder) {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      recorder.copy(kept_[i], planes_[i], planes_[i].bytes());
    }
  });
}

Picture Film::resolve(double samples) const {
  PPM_ASSERT(samples > 0.0, "a picture of no samples");
  Picture picture{constants_.width, constants_.height, std::vector<float>(3 * pixels())};
  const double scale = 1.0 / (static_cast<double>(constants_.scale) * samples);
  for (std::size_t channel = 0; channel < planes_.size(); ++channel) {
    const auto sums = planes_[channel].download<shared::FilmSum>(pixels());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      picture.rgb[3 * i + channel] = static_cast<float>(value_of(sums[i]) * scale);
    }
  }
  return picture;
}

std::vector<std::uint32_t> Film::save() const {
  std::vector<std::uint32_t> words;
  for (const gpu::Buffer& plane : planes_) {
    const auto sums = plane.download<std::uint32_t>(kWords * pixels());
    words.insert(words.end(), sums.begin(), sums.end());
  }
  return words;
}

bool Film::restore(std::span<const std::uint32_t> words) {
  const std::size_t each = kWords * pixels();
  if (words.size() != planes_.size() * each) return false;
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    planes_[i].upload(words.subspan(i * each, each));
  }
  return true;
}

}  // namespace ppm::render
