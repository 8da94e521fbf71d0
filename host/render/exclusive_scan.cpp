#include "exclusive_scan.hpp"

#include "ppm_shaders.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

std::uint32_t chunk_count(std::uint64_t entries) {
  return static_cast<std::uint32_t>((entries + PPM_SCAN_CHUNK - 1) / PPM_SCAN_CHUNK);
}

gpu::Buffer words(gpu::Device& device, const char* name, std::uint64_t count) {
  return gpu::Buffer(device, name, count * sizeof(std::uint32_t), gpu::Usage::storage);
}

}  // namespace

ExclusiveScan::ExclusiveScan(gpu::Device& device, std::uint64_t max_entries)
    : serial_chunks_(device.profile().serial_scan_chunks),
      sums_(device, shaders::scan_sums),
      chunks_(device, shaders::scan_chunks),
      offsets_(device, shaders::scan_offsets),
      chunk_sums_(words(device, "scan sums", chunk_count(max_entries) + 1ull)) {
  const std::uint32_t chunks = chunk_count(max_entries);
  if (chunks <= serial_chunks_) return;
  chunk_starts_ = words(device, "scan chunks", chunks + 1ull);
  upper_sums_ = words(device, "scan sums of sums", chunk_count(chunks) + 1ull);
}

void ExclusiveScan::record(gpu::Recorder& recorder, const gpu::Buffer& counts,
                           const gpu::Buffer& starts, std::uint32_t entries) const {
  const std::uint32_t chunks = chunk_count(entries);
  record_sums(recorder, counts, chunk_sums_, entries);
  if (chunks <= serial_chunks_) {
    record_serial(recorder, chunk_sums_, chunks);
    record_offsets(recorder, counts, chunk_sums_, starts, entries);
  } else {
    record_sums(recorder, chunk_sums_, upper_sums_, chunks);
    record_serial(recorder, upper_sums_, chunk_count(chunks));
    record_offsets(recorder, chunk_sums_, upper_sums_, chunk_starts_, chunks);
    record_offsets(recorder, counts, chunk_starts_, starts, entries);
  }
}

void ExclusiveScan::record_sums(gpu::Recorder& recorder, const gpu::Buffer& counts,
                                const gpu::Buffer& sums, std::uint32_t entries) const {
  gpu::BindingTable table;
  table.set(PPM_BIND_CELL_COUNT, counts);
  table.set(PPM_BIND_SCAN_SUMS, sums);
  recorder.dispatch(sums_, table, shared::ScanPush{0, 0, entries, 0}, chunk_count(entries));
}

void ExclusiveScan::record_serial(gpu::Recorder& recorder, const gpu::Buffer& sums,
                                  std::uint32_t chunks) const {
  gpu::BindingTable table;
  table.set(PPM_BIND_SCAN_SUMS, sums);
  for (std::uint32_t slice = 0; slice < chunks; slice += PPM_SCAN_SLICE) {
    recorder.dispatch(chunks_, table, shared::ScanPush{0, 0, chunks, slice}, 1);
  }
}

void ExclusiveScan::record_offsets(gpu::Recorder& recorder, const gpu::Buffer& counts,
                                   const gpu::Buffer& sums, const gpu::Buffer& starts,
                                   std::uint32_t entries) const {
  gpu::BindingTable table;
  table.set(PPM_BIND_CELL_COUNT, counts);
  table.set(PPM_BIND_SCAN_SUMS, sums);
  table.set(PPM_BIND_CELL_START, starts);
  recorder.dispatch(offsets_, table, shared::ScanPush{0, 0, entries, 0}, chunk_count(entries));
}

}  // namespace ppm::render
