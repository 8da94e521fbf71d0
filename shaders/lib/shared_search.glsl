// Searches that the hit points of a subgroup make together: they fetch the photons of the cells that any of them
// touches, each invocation one, hand them round, and note a bit for each that lies in their own disc. What they found
// they visit afterwards, each on its own.
//
// The kernel that includes this defines what is done with a photon.
#ifndef PPM_LIB_SHARED_SEARCH_GLSL
#define PPM_LIB_SHARED_SEARCH_GLSL

#include "lib/search.glsl"
#include "lib/subgroup.glsl"

// What counts as in the disc.
#ifndef PPM_IN_REACH
#define PPM_IN_REACH(distance2, radius2) ((distance2) <= (radius2))
#endif

// A photon of the disc, if `found`; called by all invocations of the subgroup alike.
void visit(uint photon, bool found);

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

// Which photons of the chunk lie in the disc, a bit each: those from the 33rd invocation on, if any, in the second word.
uvec2 chunk_within(GridConstants grid, Chunk chunk, vec3 centre, float radius2) {
  uint photon = chunk.begin + lane();
  bool valid = photon < chunk.end;
  vec3 position = uintBitsToFloat(PPM_FETCH(sorted_position, valid ? photon : 0u).xyz);
  if (grid.table_mask != PPM_GRID_DENSE) {
    uvec3 cell = grid_cell(grid, position);
    valid = valid && cell.y == chunk.y && cell.z == chunk.z;
  }
  if (!valid) position = vec3(1e18);
  uvec2 found = uvec2(0u);
  for (uint i = 0u; i < min(kSubgroupSize, 32u); ++i) {
    float distance2 = squared_distance(subgroupShuffle(position, i), centre);
    found.x |= PPM_IN_REACH(distance2, radius2) ? 1u << i : 0u;
  }
  for (uint i = 32u; i < kSubgroupSize; ++i) {
    float distance2 = squared_distance(subgroupShuffle(position, i), centre);
    found.y |= PPM_IN_REACH(distance2, radius2) ? 1u << (i - 32u) : 0u;
  }
  return found;
}

// Visits the photons in the disc of each invocation that is `waiting`; those that are not help the others. Returns
// whether it was too long to be shared: then what has been visited means nothing.
bool search_together(GridConstants grid, bool waiting, vec3 position, float radius2) {
  CellBox own = cells_within(grid, position, radius2);
  uint chunks_a_batch = min(kBatch >> subgroup_bits(), kSubgroupSize);
  uint budget = kChunkBudget;
  bool too_long = false;

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
      CellRow row = cell_row_of_few(grid, box, min(first_row + lane(), rows - 1u));
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
          uvec2 bits = chunk_within(grid, chunk_of(batch, chunk), position, reach2);
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
          visit(word != 0u ? photon : 0u, word != 0u);
          word &= word - 1u;
          found = low_word ? uvec2(word, found.y) : uvec2(0u, word);
        } while (int(--most) > 0);
        first_chunk += chunks_a_batch;
      } while (first_chunk < total);
      first_row += kSubgroupSize;
    } while (first_row < rows && budget > 0u);

    too_long = too_long || (budget == 0u && joins);
    leader = subgroup_min(waiting ? lane() : kSubgroupSize);
  } while (leader < kSubgroupSize);
  return too_long;
}

#endif
