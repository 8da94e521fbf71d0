// The sums M(x) and tau_M(x) of [HOJ08 Eq. 11] over the photons in each hit point's disc.
//
// One invocation owns one hit point and adds to its GATHER_SUMS: integers, so that neither the order of photons nor
// their division into chunks matters. Hit points come in SEARCH_ORDER, so that those of a subgroup lie close together
// and search together: they fetch the photons of the cells that any of them touches, each invocation one, hand them
// round, and note a bit for each that lies in their own disc. What they found they add afterwards, each on its own.
// A search that is too long for this is left to gather_slices.comp by a cursor in CONTINUE_OUT.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/receiver.glsl"
#include "lib/subgroup.glsl"

layout(push_constant, scalar) uniform PushBlock { GatherPush push; };
PPM_TEXELS(PPM_BIND_SEARCH_ORDER, search_order);
layout(binding = PPM_BIND_CONTINUE_OUT, scalar) writeonly buffer ContinueOut { GatherCursor continue_out[]; };

// Photons looked at before those that were found are added: the more, the more evenly the adding is shared.
const uint kBatch = 64u;
// Chunks of photons, as many as the subgroup has invocations, and sets of rows that it looks at in all. Loops of one
// invocation may take 65535 turns altogether on some drivers: here up to 4096 chunks, and 64 photons for 8 of them.
const uint kChunkBudget = 4096u;

uint subgroup_bits() { return uint(findMSB(kSubgroupSize)); }

// A stretch of photons to look at, at most one an invocation, in one row of cells.
struct Chunk {
  uint begin, end;
  uint y, z;
};

Chunk chunk_of(Chunk chunks, uint source) {
  return Chunk(subgroupShuffle(chunks.begin, source), subgroupShuffle(chunks.end, source),
               subgroupShuffle(chunks.y, source), subgroupShuffle(chunks.z, source));
}

float squared_distance(vec3 a, vec3 b) {
  precise vec3 offset = a - b;
  precise float distance2 = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
  return distance2;
}

// Which photons of the chunk lie in the disc, a bit each: those from the 33rd invocation on, if any, in the second word.
uvec2 chunk_within(Chunk chunk, vec3 centre, float radius2) {
  uint photon = chunk.begin + lane();
  bool valid = photon < chunk.end;
  vec3 position = uintBitsToFloat(PPM_FETCH(sorted_position, valid ? photon : 0u).xyz);
  if (push.grid.table_mask != PPM_GRID_DENSE) {
    uvec3 cell = grid_cell(push.grid, position);
    valid = valid && cell.y == chunk.y && cell.z == chunk.z;
  }
  if (!valid) position = vec3(1e18);
  uvec2 found = uvec2(0u);
  for (uint i = 0u; i < min(kSubgroupSize, 32u); ++i) {
    found.x |= squared_distance(subgroupShuffle(position, i), centre) <= radius2 ? 1u << i : 0u;
  }
  for (uint i = 32u; i < kSubgroupSize; ++i) {
    found.y |= squared_distance(subgroupShuffle(position, i), centre) <= radius2 ? 1u << (i - 32u) : 0u;
  }
  return found;
}

void main() {
  uint item = item_of_invocation(push.first);
  // Invocations beyond the end stay to help the others.
  bool waiting = item < push.first + push.count;
  uint order = waiting ? item : push.first;
  uint hit = PPM_FETCH(search_order, order >> 2u)[order & 3u];
  Receiver receiver = fetch_receiver(hit);
  float radius2 = fetch_radius2(hit);
  CellBox own = cells_within(push.grid, receiver.position, radius2);
  Sums sums = no_sums();
  uint chunks_a_batch = min(kBatch >> subgroup_bits(), kSubgroupSize);
  uint budget = kChunkBudget;

  // Those near the first that waits search with it; then the next, and those near that one. All loops are tested at
  // their ends: lavapipe runs the body of another kind once more, with no lane in it.
  uint leader = subgroup_min(waiting ? lane() : kSubgroupSize);
  do {
    uvec3 low = subgroupShuffle(own.low, min(leader, kSubgroupSize - 1u));
    uvec3 high = subgroupShuffle(own.high, min(leader, kSubgroupSize - 1u));
    uvec3 margin = max(high - low, uvec3(2u));
    bool joins = waiting && all(greaterThanEqual(own.low + margin, low)) && all(lessThanEqual(own.high, high + margin));
    waiting = waiting && !joins;
    float reach2 = joins ? radius2 : -1.0;
    CellBox box = CellBox(subgroup_min(joins ? own.low : low), subgroup_max(joins ? own.high : high));

    uint rows = row_count(box);
    uint first_row = 0u;
    do {
      CellRow row = cell_row_of_few(push.grid, box, min(first_row + lane(), rows - 1u));
      uint own_chunks = first_row + lane() < rows ? (row.end - row.begin + kSubgroupSize - 1u) >> subgroup_bits() : 0u;
      uint chunks_to_here = subgroup_inclusive_sum(own_chunks);
      uint total = subgroupShuffle(chunks_to_here, kSubgroupSize - 1u);
      bool affordable = total < budget;
      budget = affordable ? budget - total - 1u : 0u;
      total = affordable ? total : 0u;
      // Chunk c of this row begins here, if c counts from the first row's first.
      Chunk of_row = Chunk(row.begin - (chunks_to_here - own_chunks) * kSubgroupSize, row.end, row.y, row.z);

      uint first_chunk = 0u;
      do {
        // Each invocation finds out about one chunk of the batch.
        uint number = first_chunk + lane();
        uint source = 0u;
        for (uint i = 0u; i < kSubgroupSize; ++i) source += subgroupShuffle(chunks_to_here, i) <= number ? 1u : 0u;
        Chunk batch = chunk_of(of_row, min(source, kSubgroupSize - 1u));
        batch.begin += number * kSubgroupSize;

        uvec2 found = uvec2(0u);
        uint count = min(chunks_a_batch, total - first_chunk);
        uint chunk = 0u;
        do {
          uvec2 bits = chunk_within(chunk_of(batch, chunk), receiver.position, reach2);
          uint place = chunk * kSubgroupSize;
          uint placed = bits.x << (place & 31u);
          found |= place < 32u ? uvec2(placed, bits.y) : uvec2(0u, placed);
        } while (++chunk < count);

        uint most = subgroup_max(bitCount(found.x) + bitCount(found.y));
        do {
          bool low_word = found.x != 0u;
          uint word = low_word ? found.x : found.y;
          uint bit = uint(findLSB(word)) & 31u;
          uint place = bit + (low_word ? 0u : 32u);
          uint photon = subgroupShuffle(batch.begin, place >> subgroup_bits()) + (place & (kSubgroupSize - 1u));
          add_photon(receiver, PPM_FETCH(sorted_flux, word != 0u ? photon : 0u), word != 0u, sums);
          word &= word - 1u;
          found = low_word ? uvec2(word, found.y) : uvec2(0u, word);
        } while (int(--most) > 0);
        first_chunk += chunks_a_batch;
      } while (first_chunk < total);
      first_row += kSubgroupSize;
    } while (first_row < rows && budget > 0u);

    if (budget == 0u && joins) {
      sums = no_sums();
      uint slot = atomicAdd(counters[PPM_COUNTER_CONTINUE], 1u);
      if (slot < push.cursor_capacity) continue_out[slot] = GatherCursor(hit, 0u, 0u);
    }
    leader = subgroup_min(waiting ? lane() : kSubgroupSize);
  } while (leader < kSubgroupSize);
  add_to_hit_point(hit, sums);
}
