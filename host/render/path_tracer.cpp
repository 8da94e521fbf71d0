#include "path_tracer.hpp"

#include <algorithm>

#include "film_state.hpp"
#include "pass_capacities.hpp"
#include "ppm_shaders.hpp"
#include "region.hpp"
#include "stopwatch.hpp"
#include "surface_layers.hpp"

namespace ppm::render {
namespace {

constexpr std::uint32_t kHeuristic = 0;  // specialisation constant of path.comp

gpu::BindingTable scene_table(const SceneBuffers& buffers) {
  gpu::BindingTable table;
  buffers.bind(table);
  return table;
}

gpu::Kernel path_kernel(gpu::Device& device, const SceneTraits& traits, const Settings& settings) {
  return make_kernel(device, traits, shaders::path, shaders::path_plain,
                     {{kHeuristic, settings.integrator == "pt-mis"}});
}

}  // namespace

PathTracer::PathTracer(const Settings& settings, const scene::Scene& scene, gpu::Device& device,
                       Log& /*log*/, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      buffers_(scene, settings, device, threads),
      traits_(buffers_.traits_of(scene)),
      table_(scene_table(buffers_)),
      pipelines_begin_(clock_seconds()),
      kernel_(path_kernel(device, traits_, settings)),
      path_capacity_(pass_capacities(settings, PassLimits::of(device)).camera_paths),
      queue_{{device, "camera paths A", path_capacity_ * sizeof(shared::CameraPath),
              gpu::Usage::storage},
             {device, "camera paths B", path_capacity_ * sizeof(shared::CameraPath),
              gpu::Usage::storage}},
      batch_(device),
      counters_(device),
      film_(device, buffers_.constants(), settings.keeps_film) {
  statistics_.seconds["pipelines"] = clock_seconds() - pipelines_begin_;
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
  batch_.bind(table_);
  counters_.bind(table_);
  film_.bind(table_);
}

bool PathTracer::prepare(const std::function<bool()>& interrupted) {
  return !interrupted();
}

void PathTracer::look_from(const scene::Camera& camera) {
  settings_.camera = camera;
  buffers_.look_from(settings_, traits_, device_);
  film_.clear();
  statistics_ = statistics_.of_scene();
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
  const bool can_go_back = in_parts && film_.keep();
  for (std::uint64_t first = 0; first < all; first += path_capacity_) {
    if (first > 0 && can_go_back && interrupted()) {
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
  rounds_.begin();
  device_.run([&](gpu::Recorder& recorder) {
    batch_.begin(recorder, paths);
    counters_.clear(recorder);
    record_rounds(recorder, first, paths);
  });
  rounds_.learn(batch_, paths);
  while (batch_->alive[rounds_.count()] > 0) {
    device_.run([&](gpu::Recorder& recorder) {
      batch_.begin_again(recorder, rounds_.count());
      rounds_.go_on();
      record_rounds(recorder, first, paths);
    });
    rounds_.learn(batch_, paths);
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
  for (push.round = 0; push.round < rounds_.count(); ++push.round) {
    push.generate = rounds_.starts_paths(push.round) ? 1 : 0;
    table_.set(PPM_BIND_PATHS_IN, queue_[push.round % 2]);
    table_.set(PPM_BIND_PATHS_OUT, queue_[(push.round + 1) % 2]);
    recorder.dispatch(kernel_, table_, push,
                      batch_.alive(push.round, paths, rounds_.expected(push.round, paths)));
  }
  batch_.read(recorder);
  counters_.read(recorder);
}

Picture PathTracer::resolve() {
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  return film_.resolve(static_cast<double>(std::max<std::uint64_t>(statistics_.samples, 1)));
}

SavedState PathTracer::save_state() {
  const std::uint64_t fingerprint = film_fingerprint(settings_, buffers_.constants(), scene_);
  return save_film(film_, {fingerprint, statistics_.passes});
}

void PathTracer::restore_state(const SavedState& state) {
  const std::uint64_t fingerprint = film_fingerprint(settings_, buffers_.constants(), scene_);
  statistics_.passes = statistics_.samples = restore_film(film_, state, fingerprint);
}

std::vector<image::Layer> PathTracer::layers(std::span<const LayerKind> kinds) {
  return surface_layers(device_, buffers_.table(), traits_, settings_, scene_.frame, kinds);
}

const Statistics& PathTracer::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
