#include "session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "device_lost.hpp"
#include "failure.hpp"
#include "image.hpp"
#include "report.hpp"
#include "stopwatch.hpp"

namespace ppm::render {
namespace {

Checkpoint facts_of(const Settings& settings, const Circumstances& circumstances) {
  Checkpoint facts;
  facts.program = circumstances.program;
  facts.device = circumstances.device;
  facts.driver = circumstances.driver;
  facts.scene = circumstances.scene.string();
  facts.integrator = settings.integrator;
  facts.width = settings.width;
  facts.height = settings.height;
  return facts;
}

/// Of this picture among those that a viewer has.
std::string title_of(const Settings& settings, const Circumstances& circumstances) {
  return fmt::format("{}: {} ({})", circumstances.scene.filename().string(), settings.integrator,
                     getpid());
}

}  // namespace

Session::Session(Integrator& integrator, const Settings& settings, const Budget& budget,
                 const Outputs& outputs, const Circumstances& circumstances,
                 std::function<bool()> interrupted, Log& log, Checkpoint* resumed)
    : integrator_(integrator),
      settings_(settings),
      budget_(budget),
      outputs_(outputs),
      circumstances_(circumstances),
      interrupted_(std::move(interrupted)),
      log_(log),
      resumed_(resumed),
      start_(clock_seconds() - (resumed ? resumed->seconds : 0.0)),
      keeper_(outputs.keeping, facts_of(settings, circumstances), log),
      preview_(outputs.preview, outputs.preview_seconds),
      display_(outputs.display, title_of(settings, circumstances), log),
      progress_(log, outputs.progress, budget.passes,
                std::uint64_t{settings.width} * settings.height),
      // A method that ends itself makes its picture at the end, at the cost of many passes.
      measures_change_(!progress_.silent() && !method_named(settings.integrator).ends_itself) {}

Statistics Session::statistics() {
  return before_ ? before_->joined(integrator_.statistics()) : integrator_.statistics();
}

double Session::seconds() const {
  return clock_seconds() - start_;
}

std::optional<double> Session::seconds_left() const {
  return budget_.seconds ? std::optional(*budget_.seconds - seconds()) : std::nullopt;
}

void Session::restore() {
  integrator_.restore_state(resumed_->state);
  resumed_->state = {};
  before_.emplace(resumed_->statistics, integrator_.statistics());
  if (budget_.passes && passes() > *budget_.passes) {
    log_.warn(fmt::format("{} {} were made already, more than the {} asked for", passes(),
                          pass_names(integrator_.statistics()), *budget_.passes));
  }
}

bool Session::begin() {
  if (resumed_) {
    restore();
    return prepared_ = true;
  }
  if (!integrator_.prepare(interrupted_)) return false;
  keeper_.begin(integrator_, statistics(), seconds());
  return prepared_ = true;
}

bool Session::spent() {
  if (integrator_.complete()) return true;
  if (budget_.passes && passes() >= *budget_.passes) return true;
  return passes() > 0 && seconds_left().value_or(1.0) <= 0.0;
}

/// As many as are likely to end in time, where `made` took the time `since` some reading of the
/// clock; a pass that was begun is finished.
std::uint64_t Session::passes_at_a_time(std::uint64_t made, double since) const {
  const std::optional<double> left = seconds_left();
  if (!left) return UINT64_MAX;
  if (made == 0) return 1;
  const double pass_seconds = (clock_seconds() - since) / static_cast<double>(made);
  return static_cast<std::uint64_t>(std::clamp(*left / pass_seconds, 1.0, 1e9));
}

bool Session::advance_all() {
  progress_.preparing();
  const bool complete = begin() && make_passes();
  progress_.end();
  return complete;
}

bool Session::make_passes() {
  progress_.passing(integrator_.statistics());
  const double prepared = clock_seconds();
  std::uint64_t made = 0;
  for (bool last = spent(); !last;) {
    const std::uint64_t wanted = budget_.passes ? *budget_.passes - passes() : UINT64_MAX;
    const std::uint64_t at_a_time = std::min(wanted, passes_at_a_time(made, prepared));
    const std::uint64_t now =
        interrupted_() ? 0 : integrator_.advance_up_to(at_a_time, interrupted_);
    if (now == 0) return false;
    made += now;
    last = spent();
    if (!last) {
      look_at_picture();
      keep();
      last = spent();
    }
    progress_.passed(integrator_.statistics(), {seconds(), seconds_left(), change_.change(), last});
  }
  return true;
}

void Session::attempt(const std::function<void()>& deed, const char* consequence) {
  try {
    deed();
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const Failure& failure) {
    progress_.end();
    log_.warn(fmt::format("{}{}", failure.what(), consequence));
  }
}

void Session::look_at_picture() {
  const bool measures = measures_change_ && change_.due(passes());
  const bool shows = preview_.due(), displays = display_.due();
  if (!measures && !shows && !displays) return;
  const double start = clock_seconds();
  Picture picture;
  const auto show = [&](const std::filesystem::path& file) {
    picture = integrator_.resolve();
    write_picture(file, picture);
  };
  if (shows) {
    attempt([&] { preview_.show(show); }, "; the rendering goes on");
  } else {
    picture = integrator_.resolve();
  }
  if (displays && !picture.rgb.empty()) display_.show(picture, clock_seconds() - start);
  if (measures) change_.take(std::move(picture), passes());
}

void Session::keep() {
  if (!keeper_.due()) return;
  attempt([&] { keeper_.keep(integrator_, statistics(), seconds()); }, "; the rendering goes on");
}

void Session::keep_last(Elsewhere& elsewhere) {
  if (prepared_) keeper_.finish(integrator_, statistics(), seconds(), elsewhere);
}

void Session::show_last(const Picture& picture) {
  display_.last(picture);
  if (!preview_.wanted()) return;
  const auto show = [&](const std::filesystem::path& file) { write_picture(file, picture); };
  attempt([&] { preview_.show(show); }, "");
}

void Session::write_picture(const std::filesystem::path& file, const Picture& picture,
                            std::span<const image::Layer> layers) {
  if (!image::takes_layers(file)) layers = {};
  image::write(file, {picture.width, picture.height, picture.rgb}, outputs_.encoding,
               picture_attributes(settings_, circumstances_, statistics()), layers);
}

}  // namespace ppm::render
