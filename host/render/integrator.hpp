// What a method of light transport offers the driver.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device.hpp"
#include "log.hpp"
#include "scene.hpp"

namespace ppm::render {

enum class Filter : std::uint32_t { box = 0, tent = 1, gaussian = 2 };
enum class RadiusMode { automatic, footprint, fixed };

/// Everything that affects pixels, as plain values. Defaults are those of the command line.
struct Settings {
  std::string integrator = "ppm";
  std::uint32_t width = 640, height = 480;
  std::uint64_t photons_per_pass = 100000;
  double alpha = 0.7;  ///< in (0,1), Eq. 7
  RadiusMode radius_mode = RadiusMode::automatic;
  double radius = 0.0;  ///< world units, for RadiusMode::fixed
  std::uint32_t samples_per_pixel = 4;
  Filter filter = Filter::box;
  std::uint32_t seed = 0;
  std::uint32_t max_depth = 0;  ///< 0: no limit; at most 255
  std::uint32_t bdpt_strategies =
      15;  ///< ways in which paths may meet, for tests: 1 emitters that the camera path hits, 2
           ///< next event, 4 connections, 8 lens
  std::uint32_t mlt_chains = 0;  ///< 0: what suits the device and the picture
  scene::Camera camera;
  std::uint64_t tile_hits =
      1u << 20;  ///< hit points a tile holds at most; never changes the picture
  std::uint64_t segment_bytes = std::uint64_t{1}
                                << 27;  ///< of scene buffers, at most; never changes the picture
  std::uint64_t photon_capacity =
      0;  ///< photons stored at a time at most; 0: what suits the device
  std::uint64_t map_photons = 2000000;  ///< of classic photon mapping, in all
  std::uint32_t nearest = 500;          ///< of those, n of Eq. 1
  std::uint32_t passes_in_flight = 0;   ///< photon passes that the device is given at a time; 0:
                                        ///< what suits it. Neither ever changes the picture
  // How memory is saved; neither changes the picture. A pass that was begun can then not be
  // discarded: it is finished.
  bool traces_anew = false;  ///< hit points are traced anew for each pass
  bool keeps_film = true;    ///< as a pass begins, to go back to it
  // Bytes that may be in use on the device; beyond, hit points are traced anew.
  std::uint64_t eye_allowance = UINT64_MAX;   ///< while hit points are found
  std::uint64_t pass_allowance = UINT64_MAX;  ///< afterwards
};

/// A linear RGB picture, row-major from the top, radiance in W/(m^2 sr).
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;  ///< 3 * width * height

  static Picture black(std::uint32_t width, std::uint32_t height) {
    return {width, height, std::vector<float>(3ull * width * height, 0.0f)};
  }
};

/// What has been done so far; names and units as in the statistics file.
struct Statistics {
  std::uint64_t triangles = 0, lights = 0, hit_points = 0, tiles = 0;
  std::uint64_t passes = 0, photons_emitted = 0, photons_stored = 0;
  std::uint64_t samples = 0, mutations = 0;     ///< of each pixel, on average; 0 in methods without
  std::uint64_t eye_rays = 0, photon_rays = 0;  ///< searches for the closest hit; not the pilot's
  double initial_radius_min = 0.0, initial_radius_median = 0.0,
         initial_radius_max = 0.0;  ///< world units
  std::uint64_t map_photons = 0;    ///< in the photon map of classic photon mapping
  double nearest_radius_min = 0.0, nearest_radius_median = 0.0,
         nearest_radius_max = 0.0;  ///< of its estimate, world units
  std::uint64_t paths_cut = 0;
  std::map<std::string, std::uint64_t> rejected;  ///< non_finite, clamped, overflow
  std::map<std::string, double>
      seconds;  ///< bvh, upload, pipelines, pilot, eye, photons, grid, update, resolve
  std::map<std::string, double> kernel_seconds;  ///< device time by kernel
  std::vector<double> pass_seconds;              ///< wall time of each pass

  /// What does not depend on the camera.
  Statistics of_scene() const;
};

/// Complete state between passes: enough to go on as if never stopped.
using SavedState = std::vector<std::uint8_t>;

/// What a progressive method knows of a hit point [HOJ08 Figure 4].
struct ProbeReading {
  double photons = 0.0;              ///< N, a share alpha of all that were found
  double radius = 0.0;               ///< R, world units
  std::array<double, 3> radiance{};  ///< L by channel, Eq. 13
};

/// One rendering of one scene. Calls come in this order: prepare once (or restore), then any of the
/// others; after look_from prepare again.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Work before the first pass. `interrupted` is polled between submissions; returns false when it
  /// said so, after which only `resolve` (which then gives what there is) and destruction are
  /// allowed.
  virtual bool prepare(const std::function<bool()>& interrupted) = 0;

  /// One pass. When `interrupted` says so the pass in hand is discarded without trace and false
  /// returned; or it is finished, where memory is saved.
  virtual bool advance(const std::function<bool()>& interrupted) = 0;

  /// As many of `passes` (1 or more) as the method likes to make at a time. Returns how many were
  /// made; 0 when `interrupted` said so, which may also have ended it early.
  virtual std::uint64_t advance_up_to(std::uint64_t passes,
                                      const std::function<bool()>& interrupted) {
    return passes > 0 && advance(interrupted) ? 1 : 0;
  }

  /// Whether a further pass would change nothing: the method has all that it can take.
  virtual bool complete() const { return false; }

  /// Forgets all passes, also where one was interrupted, and begins anew with `camera` in the place
  /// of the settings', which must be as perspective or orthographic as that: the scene stays on the
  /// device, and what follows is the same as from a new integrator.
  virtual void look_from(const scene::Camera& camera) = 0;

  /// The picture after the passes so far.
  virtual Picture resolve() = 0;

  /// Of the hit point that weighs most in the pixel at column `x` and row `y` from the top left;
  /// nothing where there is none or the method knows of none.
  virtual std::optional<ProbeReading> probe(std::uint32_t /*x*/, std::uint32_t /*y*/) {
    return std::nullopt;
  }

  virtual SavedState save_state() = 0;
  /// Instead of prepare; throws Failure when the state does not belong to this scene and these
  /// settings.
  virtual void restore_state(const SavedState& state) = 0;

  virtual const Statistics& statistics() = 0;
};

/// Creates the integrator that the settings name; throws Failure on an unknown one.
/// `scene` and `device` must outlive it; of the scene's arrays (scene::release_arrays) only
/// save_state and restore_state make use again.
std::unique_ptr<Integrator> make_integrator(const Settings& settings, const scene::Scene& scene,
                                            gpu::Device& device, Log& log, unsigned threads);

/// What a pass of a method is.
enum class PassUnit {
  photons,    ///< a portion of photon paths
  samples,    ///< one more eye path through each pixel
  mutations,  ///< as many mutations as there are pixels
};

/// What the command line says of a method.
struct Method {
  std::string_view name, summary;
  PassUnit unit;
  std::string_view options;  ///< of those that only some methods have, separated by blanks
  bool ends_itself = false;  ///< complete at last, so that it needs no budget

  bool has_option(std::string_view option) const;
};

/// All that make_integrator knows.
std::vector<Method> methods();
bool is_method(std::string_view name);
/// Throws Failure on an unknown name.
Method method_named(std::string_view name);

}  // namespace ppm::render
