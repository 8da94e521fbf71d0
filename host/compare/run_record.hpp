// What one rendering of a comparison did, as a file beside its pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ppm::compare {

/// Names and values, as texts, of all that decides the pixels but the seed.
using Options = std::map<std::string, std::string>;

/// A picture that was kept.
struct KeptPicture {
  std::string file;  ///< EXR, beside the record
  /// Rendering time that it took: all passes until then and its own resolving, not that of earlier
  /// pictures.
  double seconds = 0.0;
  double resolve_seconds = 0.0;                          ///< the part of it for resolving
  std::uint64_t passes = 0, samples = 0, mutations = 0;  ///< samples and mutations: a pixel
  std::uint64_t photons_emitted = 0, photons_stored = 0, rays = 0;
};

struct RunRecord {
  std::string label;
  std::uint32_t seed = 0;
  Options options;
  double budget_seconds = 0.0;
  double start_seconds = 0.0;    ///< before the clock: tree, upload, pipelines
  double prepare_seconds = 0.0;  ///< of the clock: what precedes the first pass
  bool complete = false;         ///< the method had all that it can take before the time was spent
  std::vector<KeptPicture> pictures;  ///< one or more, in the order of time; the last: the result
  std::uint64_t hit_points = 0, paths_cut = 0;
  double initial_radius = 0.0;  ///< median, world units; 0: the method has none
  std::map<std::string, std::uint64_t> rejected;
  std::vector<std::string> warnings;

  const KeptPicture& last() const { return pictures.back(); }
};

std::string record_json(const RunRecord& record);
/// Throws Failure, which names the file, for anything that record_json would not have written.
RunRecord read_record(const std::filesystem::path& file);

/// The first difference in words ("alpha 0.8 instead of 0.7"), empty where they are equal.
std::string difference_of(const Options& found, const Options& wanted);

}  // namespace ppm::compare
