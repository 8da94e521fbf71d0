// Makes one text compile as C++ (with GLM) and as GLSL: spellings that differ between the two,
// nothing else.
//
// Shared code keeps to the common subset: no bool in structs, no swizzles, no implicit conversions,
// float literals with an f, functions marked PPM_FN, results through PPM_OUT / PPM_INOUT
// parameters.
#ifndef PPM_SHARED_LANG_H
#define PPM_SHARED_LANG_H

#ifdef __cplusplus

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/integer.hpp>
#include <glm/packing.hpp>

#define PPM_NAMESPACE_BEGIN namespace ppm::shared {
#define PPM_NAMESPACE_END }
#define PPM_FN inline
#define PPM_IN(T) const T&
#define PPM_OUT(T) T&
#define PPM_INOUT(T) T&
// Forbids contraction and reassociation of what is assigned to such a variable. The host is
// compiled with -ffp-contract=off, so that nothing need be said there.
#define PPM_PRECISE

namespace ppm::shared {
using std::uint32_t;
using uint = std::uint32_t;
using glm::ivec3;
using glm::mat3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::floatBitsToUint;
using glm::floor;
using glm::length;
using glm::log;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::packHalf2x16;
using glm::packUnorm2x16;
using glm::sqrt;
using glm::uaddCarry;
using glm::uintBitsToFloat;
using glm::umulExtended;
using glm::unpackHalf2x16;
using glm::unpackUnorm2x16;
// GLM's goes by way of int, which large numbers do not fit.
inline float roundEven(float x) {
  return std::nearbyint(x);
}
}  // namespace ppm::shared

#else  // GLSL

#define PPM_NAMESPACE_BEGIN
#define PPM_NAMESPACE_END
#define PPM_FN
#define PPM_IN(T) in T
#define PPM_OUT(T) out T
#define PPM_INOUT(T) inout T
#define PPM_PRECISE precise

#endif

#endif  // PPM_SHARED_LANG_H
