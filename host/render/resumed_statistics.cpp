#include "resumed_statistics.hpp"

#include <utility>

namespace ppm::render {
namespace {

template <class Map>
Map sum(Map first, const Map& second) {
  for (const auto& [name, value] : second) first[name] += value;
  return first;
}

}  // namespace

ResumedStatistics::ResumedStatistics(Statistics before, Statistics restored)
    : before_(std::move(before)), restored_(std::move(restored)) {}

Statistics ResumedStatistics::joined(const Statistics& now) const {
  Statistics all = now;
  // What integrators do not restore, since no pass depends on it.
  const auto add = [&](auto member) {
    all.*member = before_.*member + (now.*member - restored_.*member);
  };
  add(&Statistics::eye_rays);
  add(&Statistics::photon_rays);
  add(&Statistics::paths_cut);
  all.rejected = sum(before_.rejected, now.rejected);
  for (const auto& [reason, count] : restored_.rejected) all.rejected[reason] -= count;
  all.initial_radius_min = before_.initial_radius_min;
  all.initial_radius_median = before_.initial_radius_median;
  all.initial_radius_max = before_.initial_radius_max;
  all.seconds = sum(before_.seconds, now.seconds);
  all.kernel_seconds = sum(before_.kernel_seconds, now.kernel_seconds);
  all.pass_seconds = before_.pass_seconds;
  all.pass_seconds.insert(all.pass_seconds.end(), now.pass_seconds.begin(), now.pass_seconds.end());
  return all;
}

}  // namespace ppm::render
