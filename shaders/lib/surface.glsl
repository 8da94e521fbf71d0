// From a hit to everything shading needs: normals, the material's lobes, light given off.
#ifndef PPM_LIB_SURFACE_GLSL
#define PPM_LIB_SURFACE_GLSL

#include "lib/scene_kinds.glsl"

#include "lib/coverage.glsl"
#include "lib/traverse.glsl"
#include "lib/triangle_data.glsl"
#include "shared/bsdf.h"
#include "shared/bsdf/dispersion.h"

// A point on a surface as a path meets it. All normals are on the side the path comes from.
struct Surface {
  vec3 position;
  vec3 geometric_normal;
  vec3 interpolated_normal, mapped_normal;  // the latter 0 where there is none
  vec3 shading_normal;                      // of these, that which the path sees
  uint material;       // index
  uint flags;          // of the material
  uint medium;         // that begins behind the front side, 0 for none
  bool front;          // the path comes from the front side
  vec3 emission;       // radiance given off towards the path
  Bsdf bsdf;
  vec3 channel_eta;    // bsdf.eta of each channel, with kDispersion
};

// The lobes of a material at a point, textures and vertex colours applied. `front`: seen from outside.
Bsdf make_bsdf(MaterialRecord material, bool front) {
  float dielectric = 1.0 - material.metallic;
  float opaque = dielectric * (1.0 - material.transmission);
  Bsdf bsdf;
  bsdf.diffuse.albedo = material.base_color * opaque;
  vec3 specular_f0 = min(material.specular_f0, vec3(1.0)) * material.specular;
  bsdf.diffuse.coat_f0 = max_component(specular_f0);
  bsdf.diffuse.coat_f90 = material.specular;
  bsdf.glossy.f0 = material.base_color * material.metallic + specular_f0 * opaque;
  bsdf.glossy.f90 = material.metallic + material.specular * opaque;
  bsdf.glossy.alpha = material.roughness < PPM_DELTA_ROUGHNESS ? 0.0 : square(material.roughness);
  bsdf.glass = dielectric * material.transmission;
  bsdf.glass_tint = material.base_color;
  bool solid = (material.flags & PPM_MATERIAL_SOLID) != 0u;
  bsdf.eta = !solid ? 1.0 : front ? material.ior : 1.0 / material.ior;
  bsdf.thin_ior = solid ? 0.0 : material.ior;
  float coat_roughness = material.clearcoat_roughness;
  bsdf.coat =
      Clearcoat(material.clearcoat, coat_roughness < PPM_DELTA_ROUGHNESS ? 0.0 : square(coat_roughness));
  return bsdf;
}

// Multiplies the factors of a material by its textures. Returns the normal of its normal map, in tangent space.
// One loop over what the material has, since lavapipe runs the code of every branch.
vec3 apply_textures(inout MaterialRecord material, Texcoords texcoords) {
  vec3 normal = vec3(0.0, 0.0, 1.0);
  uint rest = material.use_mask;
  if (rest == 0u) return normal;
  uint use = material.first_use;
  do {
    uint which = rest & (0u - rest);
    vec4 value = sample_use(use, texcoords);
    material.base_color *= which == PPM_USE_BASE_COLOR ? value.rgb : vec3(1.0);
    material.roughness *= which == PPM_USE_METALLIC_ROUGHNESS ? value.g : 1.0;
    material.metallic *= which == PPM_USE_METALLIC_ROUGHNESS ? value.b : 1.0;
    if (kDetails) normal = which == PPM_USE_NORMAL ? 2.0 * value.rgb - 1.0 : normal;
    material.emission *= which == PPM_USE_EMISSIVE ? value.rgb : vec3(1.0);
    material.transmission *= which == PPM_USE_TRANSMISSION ? value.r : 1.0;
    material.specular *= which == PPM_USE_SPECULAR ? value.a : 1.0;
    material.specular_f0 *= which == PPM_USE_SPECULAR_COLOR ? value.rgb : vec3(1.0);
    if (kLayers) {
      material.clearcoat *= which == PPM_USE_CLEARCOAT ? value.r : 1.0;
      material.clearcoat_roughness *= which == PPM_USE_CLEARCOAT_ROUGHNESS ? value.g : 1.0;
    }
    rest ^= which;
    ++use;
  } while (rest != 0u);
  // Textures of floats may hold more.
  material.base_color = min(material.base_color, vec3(1.0));
  material.roughness = min(material.roughness, 1.0);
  material.metallic = min(material.metallic, 1.0);
  material.transmission = min(material.transmission, 1.0);
  material.specular = min(material.specular, 1.0);
  return normal;
}

// The normal that a normal map makes of the interpolated one.
vec3 mapped_normal(vec3 normal, vec4 tangent, vec3 map, float scale) {
  vec3 t = tangent.xyz - normal * dot(tangent.xyz, normal);
  float size = length(t);
  vec3 other;
  if (size > 1e-6) {
    t /= size;
  } else {
    tangent_frame(normal, t, other);
  }
  vec3 bitangent = cross(normal, t) * tangent.w;
  vec3 mapped = t * (map.x * scale) + bitangent * (map.y * scale) + normal * map.z;
  float mapped_size = length(mapped);
  return mapped_size > 0.0 ? mapped / mapped_size : normal;
}

// The shading normal that a path sees which comes or goes along `direction`: the finest that has the path on the same
// side as the geometric normal.
vec3 shading_normal_towards(Surface surface, vec3 direction) {
  float side = dot(surface.geometric_normal, direction) < 0.0 ? -1.0 : 1.0;
  vec3 normal = surface.geometric_normal;
  normal = side * dot(surface.interpolated_normal, direction) > 0.0 ? surface.interpolated_normal : normal;
  if (kTextures && kDetails) normal = side * dot(surface.mapped_normal, direction) > 0.0 ? surface.mapped_normal : normal;
  return normal;
}

// How a surface scatters is what the eye sees: its f_r is about the normal that the eye's side of the path sees. Whether
// light that travels along `direction` shows at all in a `normal` chosen by the eye's side.
bool lit_above(vec3 normal, vec3 direction) { return dot(normal, direction) < 0.0; }

// `direction` is the way the path travels.
Surface surface_at(Hit hit, vec3 direction) {
  TriangleCorners corners = fetch_triangle(hit.triangle);
  uvec4 a = PPM_FETCH_SEGMENTED(triangle_shading, 4u * hit.triangle);
  uvec4 b = PPM_FETCH_SEGMENTED(triangle_shading, 4u * hit.triangle + 1u);
  uvec4 c = PPM_FETCH_SEGMENTED(triangle_shading, 4u * hit.triangle + 2u);
  uvec4 d = PPM_FETCH_SEGMENTED(triangle_shading, 4u * hit.triangle + 3u);
  vec3 weights = corner_weights(hit.barycentric);

  Surface surface;
  surface.position = corners.corner0 * weights.x + corners.corner1 * weights.y + corners.corner2 * weights.z;
  surface.material = a.w;
  vec3 geometric = normalize(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
  surface.front = dot(geometric, direction) < 0.0;
  surface.geometric_normal = surface.front ? geometric : -geometric;

  MaterialRecord material = fetch_material(surface.material);
  surface.flags = material.flags;
  surface.medium = material.medium;
  material.base_color *= color_at(c, d, weights).rgb;
  vec3 map = vec3(0.0, 0.0, 1.0);
  Details details;
  if (kTextures) {
    if (kDetails) details = details_at(hit.triangle, weights);
    map = apply_textures(material, texcoords_at(b, c, weights, details));
  }

  vec3 interpolated = unpack_direction(a.x) * weights.x + unpack_direction(a.y) * weights.y +
                      unpack_direction(a.z) * weights.z;
  float size = length(interpolated);
  interpolated = size > 0.0 ? interpolated / size : geometric;
  float side = dot(interpolated, surface.geometric_normal) < 0.0 ? -1.0 : 1.0;
  surface.interpolated_normal = side * interpolated;
  surface.mapped_normal = vec3(0.0);
  if (kTextures && kDetails) {
    // Seen from behind all of a normal map is turned round.
    vec3 mapped = side * mapped_normal(interpolated, details.tangent, map, material.normal_scale);
    surface.mapped_normal = dot(mapped, surface.geometric_normal) > 0.0 ? mapped : vec3(0.0);
  }
  surface.shading_normal = shading_normal_towards(surface, direction);

  bool emits = surface.front || (material.flags & PPM_MATERIAL_DOUBLE_SIDED) != 0u;
  surface.emission = emits ? material.emission : vec3(0.0);
  if ((material.flags & PPM_MATERIAL_UNLIT) != 0u) {  // the eye sees its colour, and it reflects nothing
    surface.emission = material.base_color;
    material.base_color = vec3(0.0);
  }
  surface.bsdf = make_bsdf(material, surface.front);
  if (kLayers) {
    surface.emission *= clearcoat_transmittance(surface.bsdf.coat, -dot(surface.geometric_normal, direction));
  }
  surface.channel_eta = vec3(surface.bsdf.eta);
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

// A reflected direction must stay on the path's side of the geometric surface. One that does not (a grazing
// reflection off an interpolated normal) is reflected about the geometric normal instead, which keeps its energy.
vec3 reflected_direction(Surface surface, vec3 direction) {
  vec3 reflected = reflect(direction, surface.shading_normal);
  return dot(reflected, surface.geometric_normal) > 0.0 ? reflected
                                                        : reflect(direction, surface.geometric_normal);
}

#endif
