// From values of the host to records on the device, in pieces: never a second copy of all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "parallel.hpp"
#include "segmented_buffer.hpp"

namespace ppm::render {

/// A buffer of `count` records, of which `make(i)` makes number i, on up to `threads` threads at a
/// time.
template <class Record, class Make>
gpu::SegmentedBuffer upload_records(gpu::Device& device, const std::string& name, std::size_t count,
                                    unsigned threads, gpu::SegmentSize size, const Make& make) {
  constexpr std::size_t kBlock = 4096, kPiece = 64 * kBlock;
  gpu::SegmentedBuffer buffer(device, name, count * sizeof(Record), size);
  std::vector<Record> piece(std::min(count, kPiece));
  for (std::size_t first = 0; first < count; first += kPiece) {
    const std::size_t records = std::min(count - first, kPiece);
    bvh::parallel_for(threads, (records + kBlock - 1) / kBlock, [&](std::size_t block) {
      const std::size_t end = std::min((block + 1) * kBlock, records);
      for (std::size_t i = block * kBlock; i < end; ++i) piece[i] = make(first + i);
    });
    buffer.upload(piece.data(), records * sizeof(Record), first * sizeof(Record));
  }
  return buffer;
}

/// The same of records that are there already.
template <class Record>
gpu::SegmentedBuffer upload_records(gpu::Device& device, const std::string& name,
                                    const std::vector<Record>& records, gpu::SegmentSize size) {
  gpu::SegmentedBuffer buffer(device, name, records.size() * sizeof(Record), size);
  buffer.upload(records.data(), records.size() * sizeof(Record));
  return buffer;
}

}  // namespace ppm::render
