// Saving and restoring Markov chains between two passes.
#include <cstring>

#include "fingerprint.hpp"
#include "mlt.hpp"
#include "saved_state.hpp"
#include "shared/markov_chain.h"

namespace ppm::render {
namespace {

// Then follow the film's sums and, unless no light was found, the chains' words, the chains, and
// the splats of their states, chain by chain.
struct MltHeader {
  std::uint64_t fingerprint;
  std::uint64_t passes, steps;
  double bootstrap_sum;
  std::uint64_t splats;
};

template <class T>
void append(SavedState& state, const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  state.insert(state.end(), bytes, bytes + values.size() * sizeof(T));
}

/// The next `count` values; they must be there.
template <class T>
std::vector<T> take(const SavedState& state, std::size_t& next, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), state.data() + next, count * sizeof(T));
  next += count * sizeof(T);
  return values;
}

}  // namespace

std::uint64_t MltIntegrator::fingerprint() const {
  Hash hash;
  hash.add(settings_.integrator.data(), settings_.integrator.size());
  hash.add(static_cast<std::uint32_t>(settings_.filter));
  hash.add(chains_);
  hash.add(&buffers_.constants(), sizeof(shared::SceneConstants));
  add_scene(hash, scene_);
  return hash.value();
}

SavedState MltIntegrator::save_state() {
  MltHeader header{fingerprint(), statistics_.passes, steps_, bootstrap_sum_, 0};
  std::vector<std::uint32_t> words;
  std::vector<shared::Chain> chains;
  std::vector<shared::LensSplat> splats;
  if (bootstrap_sum_ > 0.0) {
    words = words_.download<std::uint32_t>(words_.bytes() / sizeof(std::uint32_t));
    chains = states_.download<shared::Chain>(chains_);
    const auto pool = splats_[pool_].download<shared::LensSplat>(splat_capacity_);
    for (shared::Chain& chain : chains) {
      const auto first = pool.begin() + (chain.splat_count > 0 ? chain.splats : 0);
      chain.splats = static_cast<std::uint32_t>(splats.size());
      splats.insert(splats.end(), first, first + chain.splat_count);
    }
  }
  header.splats = splats.size();
  SavedState state = state_of(header);
  append(state, film_.save());
  append(state, words);
  append(state, chains);
  append(state, splats);
  return state;
}

void MltIntegrator::restore_state(const SavedState& state) {
  const auto header = header_of<MltHeader>(state, fingerprint());
  const bool lit = header.bootstrap_sum > 0.0;
  const std::size_t film_words =
      3 * std::size_t{settings_.width} * settings_.height * sizeof(shared::FilmSum) / 4;
  const std::size_t chain_words = lit ? words_.bytes() / sizeof(std::uint32_t) : 0;
  const std::size_t chain_count = lit ? chains_ : 0;
  const std::size_t fixed = sizeof header + (film_words + chain_words) * sizeof(std::uint32_t) +
                            chain_count * sizeof(shared::Chain);
  if (state.size() < fixed || (state.size() - fixed) / sizeof(shared::LensSplat) != header.splats ||
      (state.size() - fixed) % sizeof(shared::LensSplat) != 0) {
    refuse_state("truncated");
  }
  std::size_t next = sizeof header;
  if (!film_.restore(take<std::uint32_t>(state, next, film_words))) refuse_state("truncated");
  const auto words = take<std::uint32_t>(state, next, chain_words);
  const auto chains = take<shared::Chain>(state, next, chain_count);
  const auto splats = take<shared::LensSplat>(state, next, header.splats);
  std::uint64_t sum = 0;
  for (const shared::Chain& chain : chains) {
    if (chain.splats != sum) refuse_state("damaged");
    sum += chain.splat_count;
  }
  if (sum != splats.size()) refuse_state("damaged");
  if (sum > splat_capacity_) refuse_state("its chains need more memory than there is now");
  if (lit) {
    words_.upload(std::span(words));
    states_.upload(std::span(chains));
    if (!splats.empty()) splats_[pool_].upload(std::span(splats));
  }
  bootstrap_sum_ = header.bootstrap_sum;
  normalisation_ = bootstrap_sum_ / bootstrap_;
  if (lit) refine_normalisation();
  steps_ = header.steps;
  statistics_.passes = statistics_.mutations = header.passes;
}

}  // namespace ppm::render
