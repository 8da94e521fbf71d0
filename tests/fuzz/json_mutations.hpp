// Mutations that keep a document JSON: what byte flips hardly ever reach.
#pragma once

#include <nlohmann/json.hpp>
#include <random>

namespace ppm::fuzz {

/// Bends one random place of `document`: another number, another type, a member more or less, a
/// part of it elsewhere.
void bend(nlohmann::json& document, std::minstd_rand& random);

/// Puts a random part of `other` into a random place of `document`.
void graft(nlohmann::json& document, const nlohmann::json& other, std::minstd_rand& random);

}  // namespace ppm::fuzz
