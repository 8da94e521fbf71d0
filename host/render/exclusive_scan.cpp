#include "exclusive_scan.hpp"

#include "ppm_shaders.hpp"
#include "shared/layout.h"

namespace ppm::render {
namespace {

std::uint32_t chunk_count(std::uint64_t entries) {
  return static_cast<std::uint32_t>((entries + PPM_SCAN_CHUNK - 1) / PPM_SCAN_CHUNK);
}

}  // namespace

ExclusiveScan::ExclusiveScan(gpu::Device& device, std::uint64_t max_entries)
    : sums_(device, shaders::scan_sums),
      chunks_(device, shaders::scan_chunks),
      offsets_(device, shaders::scan_offsets),
      chunk_sums_(device, "scan sums", (chunk_count(max_entries) + 1) * sizeof(std::uint32_t),
                  gpu::Usage::storage) {}

void ExclusiveScan::record(gpu::Recorder& recorder, const gpu::Buffer& counts,
                           const gpu::Buffer& starts, std::uint32_t entries) const {
  gpu::BindingTable table;
  table.set(PPM_BIND_CELL_COUNT, counts);
  table.set(PPM_BIND_CELL_START, starts);
  table.set(PPM_BIND_SCAN_SUMS, chunk_sums_);
  const std::uint32_t chunks = chunk_count(entries);
  recorder.dispatch(sums_, table, shared::ScanPush{0, 0, entries, 0}, chunks);
  for (std::uint32_t slice = 0; slice < chunks; slice += PPM_SCAN_SLICE) {
    recorder.dispatch(chunks_, table, shared::ScanPush{0, 0, chunks, slice}, 1);
  }
  recorder.dispatch(offsets_, table, shared::ScanPush{0, 0, entries, 0}, chunks);
}

}  // namespace ppm::render
