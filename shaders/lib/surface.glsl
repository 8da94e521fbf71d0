// From a hit to everything shading needs: normals, the material's lobes, light given off.
#ifndef PPM_LIB_SURFACE_GLSL
#define PPM_LIB_SURFACE_GLSL

#include "lib/scene_kinds.glsl"

#include "lib/texture.glsl"
#include "lib/traverse.glsl"
#include "shared/bsdf.h"
#include "shared/bsdf/dispersion.h"

PPM_TEXELS(PPM_BIND_TRIANGLE_SHADING, triangle_shading);

// A point on a surface as a path meets it. Both normals are on the side the path comes from.
struct Surface {
  vec3 position;
  vec3 geometric_normal;
  vec3 shading_normal;
  uint material;       // index
  uint flags;          // of the material
  bool front;          // the path comes from the front side
  vec3 emission;       // radiance given off towards the path
  Bsdf bsdf;
  vec3 channel_eta;    // bsdf.eta of each channel, with kDispersion
};

// The lobes of a material with a given base colour. `front`: seen from outside.
Bsdf make_bsdf(MaterialRecord material, vec3 base_color, bool front) {
  float dielectric = 1.0 - material.metallic;
  float opaque = dielectric * (1.0 - material.transmission);
  Bsdf bsdf;
  bsdf.diffuse.albedo = base_color * opaque;
  vec3 specular_f0 = min(material.specular_f0, vec3(1.0)) * material.specular;
  bsdf.diffuse.coat_f0 = max_component(specular_f0);
  bsdf.diffuse.coat_f90 = material.specular;
  bsdf.glossy.f0 = base_color * material.metallic + specular_f0 * opaque;
  bsdf.glossy.f90 = material.metallic + material.specular * opaque;
  bsdf.glossy.alpha = material.roughness < PPM_DELTA_ROUGHNESS ? 0.0 : square(material.roughness);
  bsdf.glass = dielectric * material.transmission;
  bsdf.glass_tint = base_color;
  bool solid = (material.flags & PPM_MATERIAL_SOLID) != 0u;
  bsdf.eta = !solid ? 1.0 : front ? material.ior : 1.0 / material.ior;
  bsdf.thin_ior = solid ? 0.0 : material.ior;
  float coat_roughness = material.clearcoat_roughness;
  bsdf.coat =
      Clearcoat(material.clearcoat, coat_roughness < PPM_DELTA_ROUGHNESS ? 0.0 : square(coat_roughness));
  return bsdf;
}

vec3 unpack_color(uvec2 words) { return vec3(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y).x); }

// `direction` is the way the path travels.
Surface surface_at(Hit hit, vec3 direction) {
  TriangleCorners corners = fetch_triangle(hit.triangle);
  uvec4 a = PPM_FETCH(triangle_shading, 4u * hit.triangle);
  uvec4 b = PPM_FETCH(triangle_shading, 4u * hit.triangle + 1u);
  uvec4 c = PPM_FETCH(triangle_shading, 4u * hit.triangle + 2u);
  uvec4 d = PPM_FETCH(triangle_shading, 4u * hit.triangle + 3u);
  vec3 weights = vec3(1.0 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);

  Surface surface;
  surface.position = corners.corner0 * weights.x + corners.corner1 * weights.y + corners.corner2 * weights.z;
  surface.material = a.w;
  vec3 geometric = normalize(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
  surface.front = dot(geometric, direction) < 0.0;
  surface.geometric_normal = surface.front ? geometric : -geometric;

  vec3 shading = unpack_direction(a.x) * weights.x + unpack_direction(a.y) * weights.y +
                 unpack_direction(a.z) * weights.z;
  float shading_length = length(shading);
  shading = shading_length > 0.0 ? shading / shading_length : geometric;
  if (dot(shading, surface.geometric_normal) < 0.0) shading = -shading;
  // A path that arrives above the geometric but below the shading surface sees the former.
  surface.shading_normal = dot(shading, direction) < 0.0 ? shading : surface.geometric_normal;

  MaterialRecord material = fetch_material(surface.material);
  surface.flags = material.flags;
  vec3 base_color = material.base_color * (unpack_color(c.zw) * weights.x + unpack_color(d.xy) * weights.y +
                                           unpack_color(d.zw) * weights.z);
  if (kTextures) {
    vec2 texcoord = uintBitsToFloat(b.xy) * weights.x + uintBitsToFloat(b.zw) * weights.y +
                    uintBitsToFloat(c.xy) * weights.z;
    Texcoords texcoords = Texcoords(texcoord, vec2(0.0));
    base_color *=
        sample_use(material.first_use, material.use_mask, PPM_USE_BASE_COLOR, texcoords, vec4(1.0)).rgb;
  }
  bool emits = surface.front || (material.flags & PPM_MATERIAL_DOUBLE_SIDED) != 0u;
  surface.emission = emits ? material.emission : vec3(0.0);
  surface.bsdf = make_bsdf(material, base_color, surface.front);
  if (kLayers) {
    surface.emission *= clearcoat_transmittance(surface.bsdf.coat, -dot(surface.geometric_normal, direction));
  }
  surface.channel_eta = vec3(surface.bsdf.eta);
  if (kDispersion && (material.flags & PPM_MATERIAL_SOLID) != 0u) {
    vec3 ior = vec3(dispersed_ior(material.ior, material.dispersion, 0u), material.ior,
                    dispersed_ior(material.ior, material.dispersion, 2u));
    surface.channel_eta = surface.front ? ior : 1.0 / ior;
  }
  return surface;
}

// Whether the surface bends the colours of a path apart.
bool disperses(Surface surface) {
  return kDispersion && surface.bsdf.glass > 0.0 && surface.channel_eta.x != surface.channel_eta.z;
}

// The surface as a path that carries this weight or flux meets it.
void show_to_channel(inout Surface surface, vec3 weight) {
  uint channel = channel_of(weight);
  if (kDispersion && channel != PPM_ALL_CHANNELS) surface.bsdf.eta = surface.channel_eta[channel];
}

// What is left of light after `distance` in the medium of a path's state (bits 16-31: 1 + material, 0 outside).
vec3 medium_transmittance(uint state, float distance) {
  uint medium = state >> 16u;
  if (!kMedia || medium == 0u) return vec3(1.0);
  return exp(-fetch_material(medium - 1u).absorption * distance);
}

// The state after a specular transmission through this surface, `events` scattering events being over.
uint transmitted_state(Surface surface, uint state, uint events) {
  if ((surface.flags & PPM_MATERIAL_SOLID) == 0u) return (state & 0xffff0000u) | events;
  return surface.front ? ((surface.material + 1u) << 16u) | events : events;
}

// A reflected direction must stay on the path's side of the geometric surface. One that does not (a grazing
// reflection off an interpolated normal) is reflected about the geometric normal instead, which keeps its energy.
vec3 reflected_direction(Surface surface, vec3 direction) {
  vec3 reflected = reflect(direction, surface.shading_normal);
  return dot(reflected, surface.geometric_normal) > 0.0 ? reflected
                                                        : reflect(direction, surface.geometric_normal);
}

#endif
