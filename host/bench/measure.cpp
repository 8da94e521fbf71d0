#include "measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "failure.hpp"
#include "machine.hpp"
#include "room.hpp"
#include "row_set.hpp"
#include "stopwatch.hpp"
#include "traffic.hpp"

namespace ppm::bench {
namespace {

using render::clock_seconds;
using KernelTimes = std::map<std::string, gpu::KernelTime>;
using Poll = std::function<bool()>;

/// Device time by kernel between two readings, of those that ran.
KernelTimes times_between(const KernelTimes& before, const KernelTimes& after) {
  KernelTimes times;
  for (const auto& [kernel, time] : after) {
    const auto earlier = before.find(kernel);
    const gpu::KernelTime was = earlier == before.end() ? gpu::KernelTime{} : earlier->second;
    if (time.dispatches == was.dispatches) continue;
    gpu::KernelTime& between = times[kernel];
    between.seconds = time.seconds - was.seconds;
    between.dispatches = time.dispatches - was.dispatches;
    between.items = time.items - was.items;
  }
  return times;
}

double seconds_of(const KernelTimes& times) {
  double sum = 0.0;
  for (const auto& [kernel, time] : times) sum += time.seconds;
  return sum;
}

/// 0 where a clock was too coarse to see anything.
double per(double amount, double seconds) {
  return seconds > 0.0 ? amount / seconds : 0.0;
}

double sum_of(const std::map<std::string, double>& seconds) {
  double sum = 0.0;
  for (const auto& [name, value] : seconds) sum += value;
  return sum;
}

/// One case from nothing to its figures.
class Run {
 public:
  Run(const Case& subject, const Plan& plan, const Poll& interrupted, Log& log, RowSet& rows)
      : subject_(subject), plan_(plan), interrupted_(interrupted), log_(log), rows_(rows) {}

  /// From here on false: interrupted.
  bool start();
  bool warm_up();
  bool measure_passes(const std::string& stage);
  bool age();
  void check_validation() const;
  double start_seconds() const { return start_seconds_; }

 private:
  bool advance(std::uint64_t passes);
  void add_start(double cpu, const std::map<std::string, double>& parts);
  void add_pass_counters(Row& row, const render::Statistics& before, double seconds);
  /// A row for each kernel, by its name.
  std::map<std::string, Row*> add_kernels(const std::string& stage, const KernelTimes& times,
                                          double passes);
  void add_kernel_rates(const std::map<std::string, Row*>& kernels,
                        const render::Statistics& before);

  const Case& subject_;
  const Plan& plan_;
  const Poll& interrupted_;
  Log& log_;
  RowSet& rows_;
  render::Settings settings_;
  double start_seconds_ = 0.0;
  // In the order in which they are made; each needs those before it.
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<render::Integrator> integrator_;
};

bool Run::start() {
  forget_peak_memory();
  std::map<std::string, double> parts;
  const double cpu = processor_seconds();
  double last = clock_seconds();
  const auto lap = [&](const char* part) {
    const double now = clock_seconds();
    parts[part] = now - last;
    last = now;
  };
  scene_ = std::make_unique<scene::Scene>(subject_.load(log_));
  settings_ = subject_.settings(*scene_, log_);
  lap("load");
  if (interrupted_()) return false;
  device_ = std::make_unique<gpu::Device>(plan_.device);
  lap("device");
  integrator_ = render::make_integrator(settings_, *scene_, *device_, log_, plan_.threads);
  lap("upload");
  if (!integrator_->prepare(interrupted_)) return false;
  lap("prepare");
  const KernelTimes prepared = device_->times();
  if (!advance(1)) return false;
  lap("first pass");
  integrator_->resolve();
  lap("resolve");

  // What the integrator knows in more detail.
  const render::Statistics& statistics = integrator_->statistics();
  for (const auto& [whole, part] : {std::pair("upload", "bvh"),
                                    {"upload", "pipelines"},
                                    {"prepare", "eye"},
                                    {"prepare", "pilot"}}) {
    const auto seconds = statistics.seconds.find(part);
    if (seconds == statistics.seconds.end()) continue;  // the method has no such part
    parts[part] = seconds->second;
    parts[whole] -= seconds->second;
  }
  if (parts.contains("eye")) parts.erase("prepare");  // nothing is left of it
  add_start(processor_seconds() - cpu, parts);
  const auto kernels = add_kernels("/start", prepared, 1.0);
  if (const auto eye = kernels.find("eye"); eye != kernels.end()) {
    Row& row = *eye->second;
    rows_.count(row, "rays_per_second",
                per(static_cast<double>(statistics.eye_rays), row.seconds.back()));
  }
  return true;
}

void Run::add_start(double cpu, const std::map<std::string, double>& parts) {
  const double total = start_seconds_ = sum_of(parts);
  Row& row = rows_.add(subject_.name + "/start", total, cpu);
  const render::Statistics& statistics = integrator_->statistics();
  const auto count = [&](const char* name, auto value) {
    rows_.count(row, name, static_cast<double>(value));
  };
  count("triangles", statistics.triangles);
  count("hit_points", statistics.hit_points);
  count("eye_rays", statistics.eye_rays);
  count("initial_radius_least", statistics.initial_radius_min);
  count("initial_radius_median", statistics.initial_radius_median);
  count("initial_radius_most", statistics.initial_radius_max);
  for (const char* part : {"load", "device", "bvh", "pipelines", "upload", "prepare", "eye",
                           "pilot", "first pass", "resolve"}) {
    const auto entry = parts.find(part);
    if (entry == parts.end()) continue;
    Row& part_row = rows_.add(fmt::format("{}/start:{}", subject_.name, part), entry->second);
    rows_.count(part_row, "share", per(entry->second, total));
  }
}

bool Run::advance(std::uint64_t passes) {
  while (passes > 0) {
    const std::uint64_t made =
        interrupted_() ? 0 : integrator_->advance_up_to(passes, interrupted_);
    if (made == 0) return false;
    passes -= made;
  }
  return true;
}

bool Run::warm_up() {
  return advance(plan_.warmup - 1);
}

bool Run::measure_passes(const std::string& stage) {
  const KernelTimes times_before = device_->times();
  const render::Statistics before = integrator_->statistics();
  const double cpu = processor_seconds(), start = clock_seconds();
  if (!advance(plan_.passes)) return false;
  const double passes = static_cast<double>(plan_.passes);
  const double seconds = (clock_seconds() - start) / passes;
  const double cpu_seconds = (processor_seconds() - cpu) / passes;
  Row& row = rows_.add(subject_.name + stage + "/pass", seconds, cpu_seconds);
  row.iterations = plan_.passes;
  add_pass_counters(row, before, seconds);
  const KernelTimes times = times_between(times_before, device_->times());
  add_kernel_rates(add_kernels(stage, times, passes), before);
  return true;
}

void Run::add_pass_counters(Row& row, const render::Statistics& before, double seconds) {
  const render::Statistics& now = integrator_->statistics();
  const auto a_pass = [&](std::uint64_t then, std::uint64_t later) {
    return static_cast<double>(later - then) / static_cast<double>(plan_.passes);
  };
  const auto count = [&](const char* name, std::uint64_t then, std::uint64_t later) {
    rows_.count(row, name, a_pass(then, later));
    rows_.count(row, std::string(name) + "_per_second", per(a_pass(then, later), seconds));
  };
  count("photons_emitted", before.photons_emitted, now.photons_emitted);
  count("photons_stored", before.photons_stored, now.photons_stored);
  count("photon_rays", before.photon_rays, now.photon_rays);
  if (now.samples > before.samples) count("eye_rays", before.eye_rays, now.eye_rays);
  rows_.count(row, "passes_before", static_cast<double>(before.passes));
  rows_.count(row, "device_memory_bytes", static_cast<double>(device_->peak_bytes()));
  rows_.count(row, "host_memory_bytes", static_cast<double>(peak_memory_bytes()));
}

std::map<std::string, Row*> Run::add_kernels(const std::string& stage, const KernelTimes& times,
                                             double passes) {
  std::map<std::string, Row*> added;
  const double total = seconds_of(times);
  for (const auto& [kernel, time] : times) {
    Row& row = rows_.add(subject_.name + stage + "/kernel:" + kernel, time.seconds / passes);
    rows_.count(row, "share", per(time.seconds, total));
    rows_.count(row, "dispatches", static_cast<double>(time.dispatches) / passes);
    rows_.count(row, "items", static_cast<double>(time.items) / passes);
    added[kernel] = &row;
  }
  return added;
}

void Run::add_kernel_rates(const std::map<std::string, Row*>& kernels,
                           const render::Statistics& before) {
  const render::Statistics& now = integrator_->statistics();
  const double passes = static_cast<double>(plan_.passes);
  const double stored = static_cast<double>(now.photons_stored - before.photons_stored) / passes;
  const double rays = static_cast<double>(now.photon_rays - before.photon_rays) / passes;
  for (const auto& [kernel, row] : kernels) {
    const double seconds = row->seconds.back();
    row->iterations = plan_.passes;
    if (kernel == "photon") rows_.count(*row, "rays_per_second", per(rays, seconds));
    const auto bytes = streamed_bytes(kernel, static_cast<double>(now.hit_points), stored);
    if (!bytes) continue;
    rows_.count(*row, "bytes_streamed", *bytes);
    rows_.count(*row, "bytes_per_second", per(*bytes, seconds));
  }
}

bool Run::age() {
  const std::uint64_t wanted = passes_until_half(settings_.alpha);
  const std::uint64_t made = integrator_->statistics().passes;
  if (made < wanted && !advance(wanted - made)) return false;
  for (unsigned repetition = 0; repetition < plan_.repetitions; ++repetition) {
    if (!measure_passes("/aged")) return false;
  }
  return true;
}

void Run::check_validation() const {
  if (const std::uint64_t messages = device_->validation_messages(); messages > 0) {
    throw Failure(device_->description().name, "--validate",
                  fmt::format("{} validation messages", messages), "see the lines above");
  }
}

/// A rendering so small that its dispatches take no time to speak of but for what drivers do at the
/// first one of each kernel. The row, or null where interrupted.
Row* measure_compilation(const Plan& plan, const Poll& interrupted, RowSet& rows) {
  const scene::Scene scene = make_room(5000);
  render::Settings settings;
  settings.width = 16;
  settings.height = 12;
  settings.samples_per_pixel = 1;
  settings.photons_per_pass = 64;
  settings.camera = scene.cameras.front();
  Log log(Verbosity::quiet);
  gpu::Device device(plan.device);
  const auto integrator = render::make_integrator(settings, scene, device, log, plan.threads);
  if (!integrator->prepare(interrupted)) return nullptr;
  for (int pass = 0; pass < 3; ++pass) {
    if (!integrator->advance(interrupted)) return nullptr;
  }
  for (int picture = 0; picture < 2; ++picture) integrator->resolve();
  std::map<std::string, double> more;
  for (const auto& [kernel, time] : device.times()) {
    if (kernel == "copy") continue;
    const double later = time.dispatches > 1 ? (time.seconds - time.first_seconds) /
                                                   static_cast<double>(time.dispatches - 1)
                                             : 0.0;
    more[kernel] = std::max(0.0, time.first_seconds - later);
  }
  Row& row = rows.add("compile", sum_of(more));
  for (const auto& [kernel, seconds] : more) rows.count(row, kernel + "_seconds", seconds);
  return &row;
}

}  // namespace

std::uint64_t passes_until_half(double alpha) {
  std::uint64_t passes = 0;
  for (double area = 1.0; area > 0.25; ++passes) {
    const auto before = static_cast<double>(passes);
    area *= (before + alpha) / (before + 1.0);
  }
  return passes;
}

std::optional<std::vector<Row>> measure(const std::vector<Case>& cases, const Plan& plan,
                                        const Poll& interrupted, Log& log,
                                        const std::function<void(const std::string&)>& tell) {
  RowSet compilation;
  std::vector<RowSet> sets(cases.size());
  for (unsigned repetition = 0; repetition < plan.repetitions; ++repetition) {
    if (interrupted()) return std::nullopt;
    Row* const compile = measure_compilation(plan, interrupted, compilation);
    if (!compile) return std::nullopt;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case& subject = cases[i];
      tell(fmt::format("{}, repetition {} of {}", subject.name, repetition + 1, plan.repetitions));
      Run run(subject, plan, interrupted, log, sets[i]);
      if (!run.start()) return std::nullopt;
      if (i == 0)
        compilation.count(*compile, "share", per(compile->seconds.back(), run.start_seconds()));
      if (!run.warm_up() || !run.measure_passes("")) return std::nullopt;
      if (plan.aged && repetition + 1 == plan.repetitions) {
        tell(fmt::format("{}, once radii have halved", subject.name));
        if (!run.age()) return std::nullopt;
      }
      run.check_validation();
    }
  }
  std::vector<Row> rows = compilation.take();
  for (RowSet& set : sets) {
    for (Row& row : set.take()) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ppm::bench
