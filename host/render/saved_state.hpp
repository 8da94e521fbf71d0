// What the saved states of all methods begin with: a header that says what they belong to.
#pragma once

#include <cstdint>
#include <cstring>

#include "integrator.hpp"

namespace ppm::render {

/// Throws the Failure of a state that cannot be restored.
[[noreturn]] void refuse_state(const char* why);

/// The header, in front of whatever is appended.
template <class Header>
SavedState state_of(const Header& header) {
  SavedState state(sizeof header);
  std::memcpy(state.data(), &header, sizeof header);
  return state;
}

/// The header of `state`; throws Failure when that is too short for one, or of another scene or
/// other settings than those of `fingerprint`.
template <class Header>
Header header_of(const SavedState& state, std::uint64_t fingerprint) {
  Header header;
  if (state.size() < sizeof header) refuse_state("truncated");
  std::memcpy(&header, state.data(), sizeof header);
  if (header.fingerprint != fingerprint) refuse_state("of another scene or other options");
  return header;
}

}  // namespace ppm::render
