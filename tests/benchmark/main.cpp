// The developer's benchmark: measured beside Embree in the same run, alternately, so that figures
// hold on machines whose speed wanders. Medians of five repeats or more. Run it on an idle machine:
// ppm_benchmark [THREADS] [PART...], PART rendering, traversal or trees; all by default
#include <fmt/core.h>

#include <cctype>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "failure.hpp"
#include "parts.hpp"

namespace ppm::benchmark {
namespace {

struct Part {
  std::string_view name;
  void (*measure)(const Bench&);
};

constexpr Part kParts[] = {
    {"rendering", measure_rendering}, {"traversal", measure_traversal}, {"trees", measure_trees}};

int usage() {
  fmt::print(stderr, "usage: ppm_benchmark [THREADS] [rendering|traversal|trees]...\n");
  return 2;
}

const Part* find_part(std::string_view name) {
  for (const Part& part : kParts)
    if (part.name == name) return &part;
  return nullptr;
}

void run(unsigned threads, const std::vector<Part>& parts) {
  const RTCDevice embree = rtcNewDevice(fmt::format("threads={}", threads).c_str());
  gpu::Device device({});
  for (const Part& part : parts) part.measure({device, embree, threads});
  rtcReleaseDevice(embree);
}

int run(int argc, char** argv) {
  long threads = std::thread::hardware_concurrency();
  std::vector<Part> parts;
  int next = 1;
  if (next < argc && std::isdigit(static_cast<unsigned char>(argv[next][0])) != 0)
    threads = std::strtol(argv[next++], nullptr, 10);
  for (; next < argc; ++next) {
    const Part* const part = find_part(argv[next]);
    if (part == nullptr) return usage();
    parts.push_back(*part);
  }
  if (threads < 1 || threads > 1024) return usage();
  if (parts.empty()) parts.assign(std::begin(kParts), std::end(kParts));
  run(static_cast<unsigned>(threads), parts);
  return 0;
}

}  // namespace
}  // namespace ppm::benchmark

int main(int argc, char** argv) {
  try {
    return ppm::benchmark::run(argc, argv);
  } catch (const ppm::Failure& failure) {
    fmt::print(stderr, "ppm_benchmark: {}\n", failure.what());
    return 1;
  }
}
