#include "path_tracer.hpp"

#include <algorithm>
#include <cstring>

#include "failure.hpp"
#include "fingerprint.hpp"
#include "pass_capacities.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "stopwatch.hpp"

namespace ppm::render {
namespace {

constexpr std::uint32_t kHeuristic = 0;  // specialisation constant of path.comp

// Before anything is known: rounds to record, the share of paths that survive each.
constexpr std::uint32_t kFirstRounds = 16;
constexpr double kFirstSurvival = 0.7;
// Rounds recorded beyond the usual ones: they cost less than a look from the host.
constexpr std::uint32_t kSpareRounds = 2;
static_assert(PPM_TRACE_ROUNDS % 2 == 0, "paths that are left must lie in the first queue");

struct Header {
  std::uint64_t fingerprint, passes;
};

std::uint32_t even(std::uint32_t rounds) {
  return std::clamp((rounds + 1) / 2 * 2, 2u, std::uint32_t{PPM_TRACE_ROUNDS});
}

gpu::BindingTable scene_table(const SceneBuffers& buffers) {
  gpu::BindingTable table;
  buffers.bind(table);
  return table;
}

gpu::Kernel path_kernel(gpu::Device& device, const scene::Scene& scene, const SceneBuffers& buffers,
                        const Settings& settings) {
  SceneTraits traits = traits_of(scene);
  buffers.add_segments(traits);
  return make_kernel(device, traits, shaders::path, shaders::path_plain,
                     {{kHeuristic, settings.integrator == "pt-mis"}});
}

[[noreturn]] void refuse(const char* why) {
  throw Failure("", "saved state", why, "resume with the scene and options it was saved with");
}

}  // namespace

PathTracer::PathTracer(const Settings& settings, const scene::Scene& scene, gpu::Device& device,
                       Log& /*log*/, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      buffers_(scene, settings, device, threads),
      table_(scene_table(buffers_)),
      pipelines_begin_(clock_seconds()),
      kernel_(path_kernel(device, scene, buffers_, settings)),
      path_capacity_(pass_capacities(settings, PassLimits::of(device)).camera_paths),
      queue_{{device, "camera paths A", path_capacity_ * sizeof(shared::CameraPath),
              gpu::Usage::storage},
             {device, "camera paths B", path_capacity_ * sizeof(shared::CameraPath),
              gpu::Usage::storage}},
      batch_(device),
      counters_(device),
      film_(device, buffers_.constants()),
      usual_rounds_(kFirstRounds) {
  statistics_.seconds["pipelines"] = clock_seconds() - pipelines_begin_;
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
  require_light(buffers_, scene);
  batch_.bind(table_);
  counters_.bind(table_);
  film_.bind(table_);
  double share = 1.0;
  for (double& usual : usual_alive_) {
    usual = share;
    share *= kFirstSurvival;
  }
}

bool PathTracer::prepare(const std::function<bool()>& interrupted) {
  return !interrupted();
}

bool PathTracer::advance(const std::function<bool()>& interrupted) {
  return advance_up_to(1, interrupted) == 1;
}

std::uint64_t PathTracer::advance_up_to(std::uint64_t passes,
                                        const std::function<bool()>& interrupted) {
  const double start = clock_seconds();
  const std::uint64_t pixels = std::uint64_t{settings_.width} * settings_.height;
  const std::uint64_t fitting =
      std::clamp<std::uint64_t>(path_capacity_ / pixels, 1, PPM_PATH_MOST_PASSES);
  const std::uint64_t made = std::min(passes, fitting);
  const std::uint64_t all = made * pixels;
  const bool in_parts = all > path_capacity_;
  if (interrupted()) return 0;
  if (in_parts) film_.keep();
  for (std::uint64_t first = 0; first < all; first += path_capacity_) {
    if (first > 0 && interrupted()) {
      film_.revert();
      return 0;
    }
    trace(static_cast<std::uint32_t>(first),
          static_cast<std::uint32_t>(std::min(path_capacity_, all - first)));
  }
  statistics_.passes += made;
  statistics_.samples = statistics_.passes;
  const double seconds = (clock_seconds() - start) / static_cast<double>(made);
  statistics_.pass_seconds.insert(statistics_.pass_seconds.end(), made, seconds);
  return made;
}

void PathTracer::trace(std::uint32_t first, std::uint32_t paths) {
  const gpu::Region region(device_, "paths");
  rounds_ = usual_rounds_;
  traced_ = 0;
  device_.run([&](gpu::Recorder& recorder) {
    batch_.begin(recorder, paths);
    counters_.clear(recorder);
    record_rounds(recorder, first, paths);
  });
  learn(paths);
  while (batch_->alive[rounds_] > 0) {
    device_.run([&](gpu::Recorder& recorder) {
      batch_.begin_again(recorder, rounds_);
      traced_ += rounds_;
      record_rounds(recorder, first, paths);
    });
    learn(paths);
  }
  statistics_.eye_rays += counters_[PPM_COUNTER_EYE_RAYS];
  statistics_.paths_cut += counters_[PPM_COUNTER_PATHS_CUT];
  statistics_.rejected["non_finite"] += counters_[PPM_COUNTER_NON_FINITE];
  statistics_.rejected["overflow"] += counters_[PPM_COUNTER_OVERFLOW];
}

void PathTracer::record_rounds(gpu::Recorder& recorder, std::uint32_t first, std::uint32_t paths) {
  shared::PathPush push{};
  push.pass = static_cast<std::uint32_t>(statistics_.passes);
  push.path_first = first;
  push.path_capacity = static_cast<std::uint32_t>(path_capacity_);
  push.filter_kind = static_cast<std::uint32_t>(settings_.filter);
  for (push.round = 0; push.round < rounds_; ++push.round) {
    push.generate = traced_ + push.round == 0 ? 1 : 0;
    table_.set(PPM_BIND_PATHS_IN, queue_[push.round % 2]);
    table_.set(PPM_BIND_PATHS_OUT, queue_[(push.round + 1) % 2]);
    const double share =
        usual_alive_[std::min<std::uint32_t>(traced_ + push.round, PPM_TRACE_ROUNDS - 1)];
    recorder.dispatch(kernel_, table_, push,
                      batch_.alive(push.round, paths, static_cast<std::uint64_t>(share * paths)));
  }
  batch_.read(recorder);
  counters_.read(recorder);
}

// What the rounds that have run say about the next range's.
void PathTracer::learn(std::uint32_t paths) {
  std::uint32_t used = 0;
  for (; used < rounds_ && batch_->alive[used] > 0; ++used) {
    if (traced_ + used < PPM_TRACE_ROUNDS) {
      usual_alive_[traced_ + used] = static_cast<double>(batch_->alive[used]) / paths;
    }
  }
  usual_rounds_ = even(traced_ + used + kSpareRounds);
}

Picture PathTracer::resolve() {
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  return film_.resolve(static_cast<double>(std::max<std::uint64_t>(statistics_.samples, 1)));
}

std::uint64_t PathTracer::fingerprint() const {
  Hash hash;
  hash.add(settings_.integrator.data(), settings_.integrator.size());
  hash.add(static_cast<std::uint32_t>(settings_.filter));
  hash.add(&buffers_.constants(), sizeof(shared::SceneConstants));
  add_scene(hash, scene_);
  return hash.value();
}

SavedState PathTracer::save_state() {
  const Header header{fingerprint(), statistics_.passes};
  const std::vector<std::uint32_t> sums = film_.save();
  SavedState state(sizeof header + sums.size() * sizeof sums[0]);
  std::memcpy(state.data(), &header, sizeof header);
  std::memcpy(state.data() + sizeof header, sums.data(), state.size() - sizeof header);
  return state;
}

void PathTracer::restore_state(const SavedState& state) {
  Header header;
  if (state.size() < sizeof header) refuse("truncated");
  std::memcpy(&header, state.data(), sizeof header);
  if (header.fingerprint != fingerprint()) refuse("of another scene or other options");
  std::vector<std::uint32_t> sums((state.size() - sizeof header) / sizeof(std::uint32_t));
  std::memcpy(sums.data(), state.data() + sizeof header, sums.size() * sizeof sums[0]);
  if (!film_.restore(sums)) refuse("truncated");
  statistics_.passes = statistics_.samples = header.passes;
}

const Statistics& PathTracer::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
