#include "painter.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "failure.hpp"
#include "report.hpp"
#include "saved_files.hpp"
#include "status.hpp"
#include "stopwatch.hpp"

namespace ppm::view {
namespace {

using render::clock_seconds;

constexpr double kFrameSeconds = 1.0 / 30.0;  // between two pictures at least
constexpr double kMostShare = 0.2;            // of the time that making them may take

}  // namespace

Painter::Painter(render::Integrator& integrator, const Subject& subject, Mailbox& mailbox)
    : integrator_(integrator), settings_(subject.settings), subject_(subject), mailbox_(mailbox) {}

void Painter::run() {
  while (!mailbox_.quits()) {
    follow(mailbox_.take(rests()));
    if (mailbox_.quits() || !render_on()) return;
  }
}

bool Painter::spent() {
  return integrator_.complete() || (subject_.passes && passes() >= *subject_.passes);
}

bool Painter::rests() {
  return picture_ && shown_passes_ == passes() && (mailbox_.paused() || spent());
}

void Painter::follow(const Orders& orders) {
  if (orders.camera) {
    settings_.camera = *orders.camera;
    integrator_.look_from(*orders.camera);
    prepared_ = false;
    picture_.reset();
    camera_number_ = orders.camera_number;
  }
  if (orders.inspect) {
    watched_ = orders.inspect;
    asked_ = true;
  }
  if (orders.save_as) save_as_ = orders.save_as;
}

bool Painter::render_on() {
  if (!prepared_ && !integrator_.prepare([&] { return mailbox_.quits(); })) return false;
  prepared_ = true;
  if (!picture_ || !(mailbox_.paused() || spent())) {
    const auto interrupted = [&] {
      return mailbox_.quits() || (picture_ && mailbox_.camera_waits());
    };
    const double start = clock_seconds();
    const std::uint64_t made = integrator_.advance_up_to(passes_at_a_time(), interrupted);
    if (made == 0) return true;
    pass_seconds_ = (clock_seconds() - start) / static_cast<double>(made);
  }
  look_at_picture();
  return true;
}

std::uint64_t Painter::passes_at_a_time() const {
  if (!picture_) return 1;
  const double fitting = std::clamp(kFrameSeconds / std::max(pass_seconds_, 1e-6), 1.0, 1e3);
  const auto many = static_cast<std::uint64_t>(fitting);
  return subject_.passes ? std::min(many, *subject_.passes - integrator_.statistics().passes)
                         : many;
}

void Painter::look_at_picture() {
  const bool wanted = asked_ || save_as_ || mailbox_.paused() || spent();
  if (picture_ && !wanted && clock_seconds() < next_) return;
  if (!picture_ || shown_passes_ != passes()) {
    const double start = clock_seconds();
    picture_ = std::make_shared<const render::Picture>(integrator_.resolve());
    shown_passes_ = passes();
    const double cost = clock_seconds() - start;
    next_ = clock_seconds() + std::max(kFrameSeconds, cost * (1.0 / kMostShare - 1.0));
  }
  show();
  answer();
}

void Painter::show() {
  Frame frame{picture_, passes(), integrator_.statistics().photons_emitted, camera_number_, {}};
  if (watched_) frame.reading = reading_of(*watched_);
  mailbox_.deliver(std::move(frame));
}

void Painter::answer() {
  if (asked_) {
    const render::Statistics& statistics = integrator_.statistics();
    mailbox_.deliver(
        Line{reading_line(reading_of(*watched_), statistics.passes, statistics.photons_emitted)});
    asked_ = false;
  }
  if (save_as_) {
    const image::Encoding encoding = *save_as_;
    save_as_.reset();
    try {
      save(encoding);
    } catch (const Failure& failure) {
      mailbox_.deliver(Line{failure.what(), true});
    }
  }
}

void Painter::save(const image::Encoding& encoding) {
  const std::vector<std::filesystem::path> files =
      saved_files(subject_.files, subject_.circumstances.scene);
  const std::vector<image::Layer> layers = render::layers_of(integrator_, subject_.layers);
  const auto attributes =
      render::picture_attributes(settings_, subject_.circumstances, integrator_.statistics());
  for (const std::filesystem::path& file : files) {
    const bool takes = image::takes_layers(file);
    image::write(file, {picture_->width, picture_->height, picture_->rgb}, encoding, attributes,
                 takes ? std::span(layers) : std::span<const image::Layer>());
    mailbox_.deliver(Line{fmt::format("wrote {} after {}", file.string(), passes_text(passes()))});
  }
}

Reading Painter::reading_of(glm::uvec2 pixel) {
  const std::size_t first = 3 * (std::size_t{pixel.y} * picture_->width + pixel.x);
  const float* const rgb = &picture_->rgb[first];
  return {pixel, {rgb[0], rgb[1], rgb[2]}, integrator_.probe(pixel.x, pixel.y)};
}

}  // namespace ppm::view
