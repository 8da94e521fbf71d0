#include "bdpt.hpp"

#include <algorithm>

#include "failure.hpp"
#include "film_state.hpp"
#include "stopwatch.hpp"
#include "surface_layers.hpp"

namespace ppm::render {
namespace {

gpu::BindingTable table_of(const SceneBuffers& buffers, const Film& film) {
  gpu::BindingTable table;
  buffers.bind(table);
  film.bind(table);
  return table;
}

std::uint32_t ways_of(const Settings& settings, const scene::Scene& scene) {
  if (settings.integrator != "lt") return settings.bdpt_strategies;
  if (settings.camera.ymag) {
    throw Failure(scene.file, "--integrator lt", "no light meets an orthographic camera's lens",
                  "choose a perspective camera, or bdpt");
  }
  return PPM_BDPT_LENS;
}

}  // namespace

BdptIntegrator::BdptIntegrator(const Settings& settings, const scene::Scene& scene,
                               gpu::Device& device, Log&, unsigned threads)
    : settings_(settings),
      scene_(scene),
      device_(device),
      buffers_(scene, settings, device, threads),
      traits_(buffers_.traits_of(scene)),
      film_(device, buffers_.constants(), settings.keeps_film),
      table_(table_of(buffers_, film_)),
      sampler_(device, table_, traits_, settings, ways_of(settings, scene)),
      tile_paths_(sampler_.path_capacity()) {
  statistics_.seconds["bvh"] = buffers_.bvh_seconds();
  statistics_.seconds["upload"] = buffers_.upload_seconds();
  statistics_.triangles = scene.triangles.size();
  statistics_.lights = buffers_.light_count();
}

bool BdptIntegrator::prepare(const std::function<bool()>& interrupted) {
  return !interrupted();
}

void BdptIntegrator::look_from(const scene::Camera& camera) {
  settings_.camera = camera;
  buffers_.look_from(settings_, traits_, device_);
  film_.clear();
  statistics_ = statistics_.of_scene();
}

bool BdptIntegrator::advance(const std::function<bool()>& interrupted) {
  return advance_up_to(1, interrupted) == 1;
}

std::uint64_t BdptIntegrator::advance_up_to(std::uint64_t passes,
                                            const std::function<bool()>& interrupted) {
  const double start = clock_seconds();
  const std::uint64_t pixels = std::uint64_t{settings_.width} * settings_.height;
  const std::uint64_t made =
      std::clamp<std::uint64_t>(sampler_.path_capacity() / pixels, 1, passes);
  const auto all = static_cast<std::uint32_t>(made * pixels);
  const Statistics before = statistics_;
  bool can_go_back = true;
  const auto stop = [&] { return can_go_back && interrupted(); };
  for (std::uint32_t first = 0; first < all;) {
    const std::uint32_t paths = std::min(tile_paths_, all - first);
    const BidirectionalSampler::Result result =
        sampler_.trace({static_cast<std::uint32_t>(statistics_.passes), first, paths, 0,
                        static_cast<std::uint32_t>(made)},
                       stop);
    if (result == BidirectionalSampler::Result::overflow) {
      if (paths == 1) {
        throw Failure("", "--max-depth", "the sub-paths of one sample do not fit", "limit it");
      }
      tile_paths_ = (paths + 1) / 2;
      continue;
    }
    if (result == BidirectionalSampler::Result::interrupted) {
      if (first > 0) film_.revert();
      statistics_ = before;
      return 0;
    }
    if (first == 0 && paths < all) can_go_back = film_.keep();
    sampler_.deposit();
    record(sampler_.counters());
    first += paths;
  }
  statistics_.passes += made;
  statistics_.samples = statistics_.passes;
  const double seconds = (clock_seconds() - start) / static_cast<double>(made);
  statistics_.pass_seconds.insert(statistics_.pass_seconds.end(), made, seconds);
  return made;
}

void BdptIntegrator::record(const Counters& counters) {
  statistics_.eye_rays += counters[PPM_COUNTER_EYE_RAYS];
  statistics_.photon_rays += counters[PPM_COUNTER_PHOTON_RAYS];
  statistics_.paths_cut += counters[PPM_COUNTER_PATHS_CUT];
  statistics_.rejected["non_finite"] += counters[PPM_COUNTER_NON_FINITE];
  statistics_.rejected["clamped"] += counters[PPM_COUNTER_CLAMPED];
  statistics_.rejected["overflow"] += counters[PPM_COUNTER_OVERFLOW];
}

Picture BdptIntegrator::resolve() {
  const Stopwatch stopwatch(statistics_.seconds["resolve"]);
  return film_.resolve(static_cast<double>(std::max<std::uint64_t>(statistics_.passes, 1)));
}

SavedState BdptIntegrator::save_state() {
  const std::uint64_t fingerprint = film_fingerprint(settings_, buffers_.constants(), scene_);
  return save_film(film_, {fingerprint, statistics_.passes});
}

void BdptIntegrator::restore_state(const SavedState& state) {
  const std::uint64_t fingerprint = film_fingerprint(settings_, buffers_.constants(), scene_);
  statistics_.passes = statistics_.samples = restore_film(film_, state, fingerprint);
}

std::vector<image::Layer> BdptIntegrator::layers(std::span<const LayerKind> kinds) {
  return surface_layers(device_, buffers_.table(), traits_, settings_, scene_.frame, kinds);
}

const Statistics& BdptIntegrator::statistics() {
  for (const auto& [kernel, time] : device_.times()) {
    statistics_.kernel_seconds[kernel] = time.seconds;
  }
  return statistics_;
}

}  // namespace ppm::render
