// The scene's lights: choosing one, and what a ray that leaves the scene sees.
#ifndef PPM_LIB_LIGHTS_GLSL
#define PPM_LIB_LIGHTS_GLSL

#include "lib/scene_kinds.glsl"

#include "lib/scene.glsl"
#include "shared/environment.h"
#include "shared/light.h"
#include "shared/media.h"
#include "shared/random.h"

PPM_SEGMENTED_TEXELS(PPM_BIND_LIGHTS, lights);

Light fetch_light(uint index) {
  uvec4 a = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * index);
  uvec4 b = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * index + 1u);
  uvec4 c = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * index + 2u);
  uvec4 d = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * index + 3u);
  Light light;
  light.record = LightRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
                             uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.x), uintBitsToFloat(d.y), d.z, d.w);
  light.bounding_centre = scene.bounding_centre;
  light.bounding_radius = scene.bounding_radius;
  light.two_sided = 0.0;
  light.medium = 0u;
  light.corner0 = light.corner1 = light.corner2 = vec3(0.0);
  if (a.w == PPM_LIGHT_TRIANGLE) {
    TriangleCorners corners = fetch_triangle(c.w);
    light.corner0 = corners.corner0;
    light.corner1 = corners.corner1;
    light.corner2 = corners.corner2;
    MaterialRecord material = fetch_material(corners.material & ~PPM_HAS_COVERAGE);
    light.two_sided = (material.flags & PPM_MATERIAL_DOUBLE_SIDED) != 0u ? 1.0 : 0.0;
    light.medium = material.medium;
  }
  return light;
}

// A light in proportion to its power (Vose's alias method): one word chooses the bin, one decides within it.
uint choose_light(uint bin_word, uint alias_word) {
  uint bin = index_from_word(bin_word, scene.light_count);
  uvec4 d = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * bin + 3u);
  return alias_word < d.z ? bin : d.w;
}

// The probability with which choose_light chooses what a path has met: a triangle, or the environment.
float light_probability_of(uint triangle) {
  return uintBitsToFloat(PPM_FETCH_SEGMENTED(triangle_positions, 3u * triangle + 1u).w);
}
float environment_probability() {  // of the last light
  return uintBitsToFloat(PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * (scene.light_count - 1u) + 1u).w);
}

#ifndef PPM_FINDS_START_MEDIA  // the kernel that writes them
PPM_TEXELS(PPM_BIND_LIGHT_MEDIA, light_media);

uint fetch_light_media(uint index) { return PPM_FETCH(light_media, index / 4u)[index % 4u]; }

// The media in which a photon starts from light number `index`; `normal` of the surface on the side it leaves from.
uint start_media(Light light, uint index, vec3 normal) {
  if (!kMedia) return PPM_MEDIA_OUTSIDE;
  uint media = fetch_light_media(index);  // in front of a triangle
  bool back = light.medium != 0u && dot(normal, triangle_area_normal(light)) < 0.0;
  return back ? media_after_entering(media, light.medium) : media;
}

// The media in which the camera stands.
uint camera_media() { return kMedia ? fetch_light_media(scene.light_count) : PPM_MEDIA_OUTSIDE; }
#endif

PPM_TEXELS(PPM_BIND_ENVIRONMENT, environment);

EnvironmentShape environment_shape() {
  return EnvironmentShape(scene.environment_width, scene.environment_height, scene.environment_turn,
                          scene.environment_pdf_scale);
}

EnvironmentSight environment_sight_at(EnvironmentShape shape, vec2 texel) {
  EnvironmentTaps taps = environment_taps(shape, texel);
  return environment_sight(shape, texel, taps, unpack_radiance(PPM_FETCH(environment, taps.index.x).xy),
                           unpack_radiance(PPM_FETCH(environment, taps.index.y).xy),
                           unpack_radiance(PPM_FETCH(environment, taps.index.z).xy),
                           unpack_radiance(PPM_FETCH(environment, taps.index.w).xy));
}

// A direction towards the sky and what it shows. words: the texel; u: the point under its tent.
EnvironmentSight sample_environment(uvec2 words, vec2 u, out vec3 towards_sky) {
  EnvironmentShape shape = environment_shape();
  uint bin = index_from_word(words.x, shape.width * shape.height);
  uvec4 texel = PPM_FETCH(environment, bin);
  vec2 point = environment_sample_texel(shape, words.y < texel.z ? bin : texel.w, u);
  towards_sky = environment_direction(shape, point);
  return environment_sight_at(shape, point);
}

// What a ray that misses everything sees.
EnvironmentSight environment_towards(vec3 direction) {
  EnvironmentShape shape = environment_shape();
  return environment_sight_at(shape, environment_texel(shape, direction));
}

vec3 miss_radiance(vec3 direction) { return kEnvironment ? environment_towards(direction).radiance : vec3(0.0); }

#endif
