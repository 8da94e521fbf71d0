// An environment: light from infinitely far away, as a map of radiance over longitude and latitude.
//
// Columns run with the longitude: the middle of the map lies towards +X, +Z is a quarter of the
// width to its right; rows run from +Y down to -Y. Between the texels' centres radiance is
// bilinear, around in longitude, constant beyond the first and last row's centres.
//
// That interpolant is a sum of tents, one a texel, and this is how directions are drawn: a texel in
// proportion to its height and the sine of its latitude, then a point under its tent. The density
// is then the interpolant itself but for a factor that varies by the sine within a row only:
// positive wherever radiance is, and photons carry about equal fluxes.
#ifndef PPM_SHARED_ENVIRONMENT_H
#define PPM_SHARED_ENVIRONMENT_H

#include "shared/light.h"

PPM_NAMESPACE_BEGIN

// A texel: radiance in two words (pack_radiance), then its bin of the alias table.
#define PPM_ENVIRONMENT_WORDS 4u

struct EnvironmentShape {
  uint width, height;
  float turn;       // rotation about +Y, counter-clockwise seen from above, in turns
  float pdf_scale;  // width * height / (2 pi^2 * sum of mean radiance * row weight)
};

// Three 16-bit mantissas under one exponent, as in photon.h; 0 where all is 0.
PPM_FN uvec2 pack_radiance(vec3 radiance) {
  uint exponent = max(floatBitsToUint(max_component(radiance)) >> 23u, 16u);
  vec3 mantissa = radiance * uintBitsToFloat((269u - exponent) << 23u);  // below 2^16
  uint red = uint(min(roundEven(mantissa.x), 65535.0f));
  uint green = uint(min(roundEven(mantissa.y), 65535.0f));
  uint blue = uint(min(roundEven(mantissa.z), 65535.0f));
  return uvec2(red | (green << 16u), blue | ((exponent - 15u) << 16u));
}
PPM_FN vec3 unpack_radiance(uvec2 words) {
  float scale = uintBitsToFloat((words.y << 7u) & 0x7f800000u);
  return vec3(float(words.x & 0xffffu), float(words.x >> 16u), float(words.y & 0xffffu)) * scale;
}

// The angle of (x, y) in turns, in [-1/2, 1/2]; error below 1e-7. Vulkan grants atan only 2^-11.
// Abramowitz and Stegun: Handbook of Mathematical Functions, 4.4.49.
PPM_FN float turn_of(float x, float y) {
  float larger = max(abs(x), abs(y));
  float ratio = larger > 0.0f ? min(abs(x), abs(y)) / larger : 0.0f;
  float r2 = ratio * ratio;
  float series = 0.0028662257f;
  series = series * r2 - 0.0161657367f;
  series = series * r2 + 0.0429096138f;
  series = series * r2 - 0.0752896400f;
  series = series * r2 + 0.1065626393f;
  series = series * r2 - 0.1420889944f;
  series = series * r2 + 0.1999355085f;
  series = series * r2 - 0.3333314528f;
  float turn = ratio * (1.0f + r2 * series) * (0.5f * PPM_INVERSE_PI);
  if (abs(y) > abs(x)) turn = 0.25f - turn;
  if (x < 0.0f) turn = 0.5f - turn;
  return y < 0.0f ? -turn : turn;
}

PPM_FN float fraction(float x) {
  return x - floor(x);
}

// Where on the map a direction lies, in texels from its upper left corner.
PPM_FN vec2 environment_texel(EnvironmentShape shape, vec3 direction) {
  float around = fraction(0.5f + shape.turn + turn_of(direction.x, direction.z));
  float horizontal = sqrt(direction.x * direction.x + direction.z * direction.z);
  float down = 2.0f * turn_of(direction.y, horizontal);
  return vec2(around * float(shape.width), down * float(shape.height));
}

// Sine of the angle from the pole, at a height in rows.
PPM_FN float environment_sine(EnvironmentShape shape, float row) {
  float height = float(shape.height);
  return unit_circle(max(min(row, height - row), 0.0f) / (2.0f * height)).y;
}

// The direction towards that point of the sky. Unit.
PPM_FN vec3 environment_direction(EnvironmentShape shape, vec2 texel) {
  vec2 around = unit_circle(fraction(texel.x / float(shape.width) - 0.5f - shape.turn));
  float sine = environment_sine(shape, texel.y);
  float cosine = unit_circle(min(texel.y / (2.0f * float(shape.height)), 0.5f)).x;
  return vec3(sine * around.x, cosine, sine * around.y);
}

// The four texels that a point lies between: indices and weights.
struct EnvironmentTaps {
  uvec4 index;
  vec4 weight;
  vec2 row_weight;  // of the upper two and the lower two
};

PPM_FN EnvironmentTaps environment_taps(EnvironmentShape shape, vec2 texel) {
  int width = int(shape.width);
  int height = int(shape.height);
  vec2 corner = vec2(floor(texel.x - 0.5f), floor(texel.y - 0.5f));
  vec2 part = vec2(texel.x - 0.5f - corner.x, texel.y - 0.5f - corner.y);
  int left = int(corner.x);
  if (left < 0) left += width;
  if (left >= width) left -= width;
  int right = left + 1 < width ? left + 1 : 0;
  int upper = clamp(int(corner.y), 0, height - 1);
  int lower = clamp(int(corner.y) + 1, 0, height - 1);
  EnvironmentTaps taps;
  taps.index = uvec4(uint(upper * width + left), uint(upper * width + right),
                     uint(lower * width + left), uint(lower * width + right));
  taps.weight = vec4((1.0f - part.x) * (1.0f - part.y), part.x * (1.0f - part.y),
                     (1.0f - part.x) * part.y, part.x * part.y);
  taps.row_weight = vec2(environment_sine(shape, float(upper) + 0.5f),
                         environment_sine(shape, float(lower) + 0.5f));
  return taps;
}

// What the sky shows at a point of the map.
struct EnvironmentSight {
  vec3 radiance;
  float pdf_solid_angle;  // with which environment_sample_texel draws the direction
};

// radiance_0 .. 3: of the four taps.
PPM_FN EnvironmentSight environment_sight(EnvironmentShape shape, vec2 texel, EnvironmentTaps taps,
                                          vec3 radiance_0, vec3 radiance_1, vec3 radiance_2,
                                          vec3 radiance_3) {
  vec3 upper = radiance_0 * taps.weight.x + radiance_1 * taps.weight.y;
  vec3 lower = radiance_2 * taps.weight.z + radiance_3 * taps.weight.w;
  EnvironmentSight sight;
  sight.radiance = upper + lower;
  float height =
      mean_component(upper) * taps.row_weight.x + mean_component(lower) * taps.row_weight.y;
  sight.pdf_solid_angle = height * shape.pdf_scale / max(environment_sine(shape, texel.y), 1e-12f);
  return sight;
}

// Under a tent of width 2: an offset from its middle. Flat: constant over half a unit on that side.
PPM_FN float sample_tent(float u, bool flat_below, bool flat_above) {
  bool below = u < 0.5f;
  float along = below ? 2.0f * u : 2.0f * u - 1.0f;  // in [0, 1)
  if (below) return flat_below ? 0.5f * along - 0.5f : sqrt(along) - 1.0f;
  return flat_above ? 0.5f * along : 1.0f - sqrt(1.0f - along);
}

// A point under the tent of texel `index`.
PPM_FN vec2 environment_sample_texel(EnvironmentShape shape, uint index, vec2 u) {
  uint row = index / shape.width;
  float x = float(index - row * shape.width) + 0.5f + sample_tent(u.x, false, false);
  float y = float(row) + 0.5f + sample_tent(u.y, row == 0u, row + 1u == shape.height);
  float width = float(shape.width);
  if (x < 0.0f) x += width;
  if (x >= width) x -= width;
  return vec2(x, clamp(y, 0.0f, float(shape.height)));
}

// A photon from the sky: it starts on the disc that the scene's bounding sphere shows to the
// direction it comes from. u: where on the disc.
PPM_FN LightEmission environment_emit(Light light, vec3 towards_sky, EnvironmentSight sight,
                                      vec2 u) {
  vec2 disc = sample_disc(u) * light.bounding_radius;
  vec3 tangent;
  vec3 bitangent;
  tangent_frame(towards_sky, tangent, bitangent);
  LightEmission result;
  result.position = light.bounding_centre + towards_sky * light.bounding_radius + tangent * disc.x +
                    bitangent * disc.y;
  result.normal = vec3(0.0f);
  result.direction = -towards_sky;
  result.pdf_position_area = disc_pdf_area() / square(light.bounding_radius);
  result.pdf_direction_solid_angle = sight.pdf_solid_angle;
  // At the very edge of a tent both may be zero.
  float density = sight.pdf_solid_angle * result.pdf_position_area;
  result.flux = density > 0.0f ? sight.radiance / density : vec3(0.0f);
  return result;
}

// What a point sees of the sky in a direction that was drawn by environment_sample_texel.
PPM_FN LightConnection environment_connect(Light light, vec3 towards_sky, EnvironmentSight sight) {
  LightConnection result;
  result.direction = towards_sky;
  result.distance = 1e30f;
  result.radiance = sight.radiance;
  result.pdf_solid_angle = sight.pdf_solid_angle;
  result.pdf_position_area = disc_pdf_area() / square(light.bounding_radius);
  result.emit_pdf_direction_solid_angle = sight.pdf_solid_angle;
  result.light_cosine = 1.0f;
  return result;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_ENVIRONMENT_H
