// The scene's lights: choosing one, and what a ray that leaves the scene sees.
#ifndef PPM_LIB_LIGHTS_GLSL
#define PPM_LIB_LIGHTS_GLSL

#include "lib/scene.glsl"
#include "shared/light.h"
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
  light.corner0 = light.corner1 = light.corner2 = vec3(0.0);
  if (a.w == PPM_LIGHT_TRIANGLE) {
    TriangleCorners corners = fetch_triangle(c.w);
    light.corner0 = corners.corner0;
    light.corner1 = corners.corner1;
    light.corner2 = corners.corner2;
    uint flags = fetch_material(corners.material & ~PPM_HAS_COVERAGE).flags;
    light.two_sided = (flags & PPM_MATERIAL_DOUBLE_SIDED) != 0u ? 1.0 : 0.0;
  }
  return light;
}

// A light in proportion to its power (Vose's alias method): one word chooses the bin, one decides within it.
uint choose_light(uint bin_word, uint alias_word) {
  uint bin = index_from_word(bin_word, scene.light_count);
  uvec4 d = PPM_FETCH_SEGMENTED(lights, PPM_LIGHT_TEXELS * bin + 3u);
  return alias_word < d.z ? bin : d.w;
}

// Radiance of a ray that misses everything. Black: no light of today lies behind the scene.
vec3 miss_radiance(vec3 direction) { return vec3(0.0); }

#endif
