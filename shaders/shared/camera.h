// The camera, a pinhole or orthographic, and the order in which pixels are worked off.
#ifndef PPM_SHARED_CAMERA_H
#define PPM_SHARED_CAMERA_H

#include "shared/random.h"
#include "shared/warp.h"

PPM_NAMESPACE_BEGIN

// An orthographic camera's footprints do not grow with distance. Its eye paths are taken to come
// from so far away, in working units, that those of any scene do not either.
#define PPM_CAMERA_FAR_AWAY 1e4f

// A point of the film, in pixels from its top left corner, on the plane where the view's half
// height is camera_tan_half_y; from the middle of that plane.
PPM_FN vec3 camera_offset(SceneConstants scene, vec2 film) {
  float x = (2.0f * film.x / float(scene.width) - 1.0f) * scene.camera_tan_half_x;
  float y = (1.0f - 2.0f * film.y / float(scene.height)) * scene.camera_tan_half_y;
  return scene.camera_right * x + scene.camera_up * y;
}

// Where the eye path through a point of the film starts.
PPM_FN vec3 camera_origin(SceneConstants scene, vec2 film) {
  float spread = scene.camera_kind == PPM_CAMERA_ORTHOGRAPHIC ? 1.0f : 0.0f;
  return scene.camera_position + camera_offset(scene, film) * spread;
}

// Direction through a point of the film. Unit.
PPM_FN vec3 camera_direction(SceneConstants scene, vec2 film) {
  float spread = scene.camera_kind == PPM_CAMERA_ORTHOGRAPHIC ? 0.0f : 1.0f;
  return normalize(scene.camera_forward + camera_offset(scene, film) * spread);
}

// How long a path is before it leaves the camera.
PPM_FN float camera_distance(SceneConstants scene) {
  return scene.camera_kind == PPM_CAMERA_ORTHOGRAPHIC ? PPM_CAMERA_FAR_AWAY : 0.0f;
}

// Area of one pixel on the plane of camera_offset: at distance 1, or orthographic at any.
PPM_FN float pixel_area(SceneConstants scene) {
  return 4.0f * scene.camera_tan_half_x * scene.camera_tan_half_y /
         (float(scene.width) * float(scene.height));
}

// Solid angle of the pixel seen along a direction, from camera_distance before the camera.
PPM_FN float pixel_solid_angle(SceneConstants scene, vec3 direction) {
  float cosine = dot(direction, scene.camera_forward);
  float far_away = 1.0f / (PPM_CAMERA_FAR_AWAY * PPM_CAMERA_FAR_AWAY);
  return pixel_area(scene) *
         (scene.camera_kind == PPM_CAMERA_ORTHOGRAPHIC ? far_away : cosine * cosine * cosine);
}

struct CameraImportance {
  vec2 film;         // where the direction meets the film, in pixels
  float importance;  // We of a film that averages over one pixel: 1 / (pixel area * cos^4); 0 if
                     // off the film
  float pdf_solid_angle;  // with which one eye path through that pixel takes the direction: 1 /
                          // solid angle
};

// For paths that reach the camera from the scene; `direction` leaves the camera. (A lens connection
// multiplies by the cosine at the camera: importance * cosine = pdf_solid_angle.) No path meets an
// orthographic camera by chance.
// `margin`: how far around the picture the film reaches, in pixels.
PPM_FN CameraImportance camera_importance_around(SceneConstants scene, vec3 direction,
                                                 float margin) {
  CameraImportance result;
  result.film = vec2(0.0f);
  result.importance = 0.0f;
  result.pdf_solid_angle = 0.0f;
  float cosine = dot(direction, scene.camera_forward);
  if (cosine <= 0.0f || scene.camera_kind == PPM_CAMERA_ORTHOGRAPHIC) return result;
  float x = dot(direction, scene.camera_right) / (cosine * scene.camera_tan_half_x);
  float y = dot(direction, scene.camera_up) / (cosine * scene.camera_tan_half_y);
  if (abs(x) > 1.0f + 2.0f * margin / float(scene.width)) return result;
  if (abs(y) > 1.0f + 2.0f * margin / float(scene.height)) return result;
  result.film =
      vec2((x + 1.0f) * 0.5f * float(scene.width), (1.0f - y) * 0.5f * float(scene.height));
  result.pdf_solid_angle = 1.0f / pixel_solid_angle(scene, direction);
  result.importance = result.pdf_solid_angle / cosine;
  return result;
}
PPM_FN CameraImportance camera_importance(SceneConstants scene, vec3 direction) {
  return camera_importance_around(scene, direction, 0.0f);
}

PPM_FN uint reversed_bits(uint bits) {
  bits = (bits << 16u) | (bits >> 16u);
  bits = ((bits & 0x00ff00ffu) << 8u) | ((bits & 0xff00ff00u) >> 8u);
  bits = ((bits & 0x0f0f0f0fu) << 4u) | ((bits & 0xf0f0f0f0u) >> 4u);
  bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xccccccccu) >> 2u);
  return ((bits & 0x55555555u) << 1u) | ((bits & 0xaaaaaaaau) >> 1u);
}

// Van der Corput's sequence in base 2.
PPM_FN float radical_inverse(uint index) {
  return unit_from_word(reversed_bits(index));
}

// The second dimension of Sobol's sequence, which is a (0,2)-sequence with the reversed bits: each
// aligned 2^k points have one in every elementary interval of area 2^-k.
PPM_FN uint second_sobol_word(uint index) {
  uint word = 0u;
  uint direction = 0x80000000u;
  for (uint rest = index; rest != 0u; rest >>= 1u) {
    if ((rest & 1u) != 0u) word ^= direction;
    direction ^= direction >> 1u;
  }
  return word;
}

// The film position of one of a pixel's `samples` eye paths, drawn from the filter, stratified by a
// jittered Hammersley set. Its strata alone would not cover the pixel evenly (of n x n cells they
// hold n), so they are moved at random: powers of two of samples by a digital shift, which keeps
// one sample in every elementary interval; other numbers on the torus.
// u: jitter (xy) and the pixel's shift (z).
PPM_FN vec2 film_sample(uint filter_kind, uint x, uint y, uint sample_index, uint samples, vec3 u) {
  float strata = float(samples);
  float a = (float(sample_index) + u.x) / strata;
  float b = u.y / strata;
  if ((samples & (samples - 1u)) == 0u) {
    b += radical_inverse(sample_index ^ uint(u.z * strata));
  } else {
    b += radical_inverse(sample_index) + u.z;
    b -= floor(b);
  }
  // Rounding must not reach 1.
  a = min(a, 0.99999994f);
  b = min(b, 0.99999994f);
  return vec2(float(x) + 0.5f + sample_filter(filter_kind, a),
              float(y) + 0.5f + sample_filter(filter_kind, b));
}

// The same where nobody knows how many eye paths there will be: point number `sample_index` of a
// sequence whose every beginning covers the pixel evenly. `shift`: random words of the pixel, which
// keep the intervals that hold one point each.
PPM_FN vec2 film_sample_in_sequence(uint filter_kind, uint x, uint y, uint sample_index,
                                    uvec2 shift) {
  float a = unit_from_word(reversed_bits(sample_index) ^ shift.x);
  float b = unit_from_word(second_sobol_word(sample_index) ^ shift.y);
  return vec2(float(x) + 0.5f + sample_filter(filter_kind, a),
              float(y) + 0.5f + sample_filter(filter_kind, b));
}

// Light that meets the film at some place counts in every pixel whose filter reaches it. One of
// them, along one axis: chosen in proportion to its filter's value there, `weight` being the sum of
// all. `u` uniform.
struct FilterChoice {
  int pixel;
  float weight;
};

PPM_FN FilterChoice choose_filter(uint filter_kind, float film, float u) {
  float middle = floor(film);
  float below = filter_value(filter_kind, film - middle + 0.5f);
  float within = filter_value(filter_kind, film - middle - 0.5f);
  float above = filter_value(filter_kind, film - middle - 1.5f);
  FilterChoice choice;
  choice.weight = below + within + above;
  float chosen = u * choice.weight;
  choice.pixel = int(middle);
  if (chosen < below) {
    choice.pixel -= 1;
  } else if (chosen >= below + within && above > 0.0f) {
    choice.pixel += 1;
  }
  return choice;
}

// Pixels are numbered in blocks of 8 x 8 (bands of 8 rows, blocks from left to right), whole blocks
// in pieces of 4 x 2, so that any aligned 8, 16, 32 or 64 in number lie close together in the
// picture. Pixel number -> column and row.
PPM_FN uvec2 pixel_position(uint number, uint width, uint height) {
  uint band = number / (8u * width);
  uint rows = min(8u, height - 8u * band);
  uint rest = number - band * 8u * width;
  uint block = rest / (8u * rows);
  uint columns = min(8u, width - 8u * block);
  rest -= block * 8u * rows;
  uvec2 within = uvec2(rest % columns, rest / columns);
  if (rows == 8u && columns == 8u) {
    within.x = (rest & 3u) | ((rest >> 1u) & 4u);
    within.y = ((rest >> 2u) & 1u) | ((rest >> 3u) & 6u);
  }
  return uvec2(8u * block + within.x, 8u * band + within.y);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_CAMERA_H
