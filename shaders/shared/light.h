// Light sources: how they emit photons and how a surface point sees them.
//
// Each offers a position density (per area of the light, or of the disc a directional light shines
// through; 1 for a point) and a direction density (per solid angle; 1 for a delta), separately, so
// that a method may use either. The probability of choosing the light is not in any of them.
// Lengths are in the working frame. What a triangle's texture and coverage leave of its emission is
// for callers to multiply (light_texture in lib/coverage.glsl).
#ifndef PPM_SHARED_LIGHT_H
#define PPM_SHARED_LIGHT_H

#include "shared/warp.h"

PPM_NAMESPACE_BEGIN

// A light with what its record refers to.
struct Light {
  LightRecord record;
  vec3 corner0, corner1, corner2;  // triangle
  float two_sided;                 // 1 or 0; triangle
  uint medium;                     // of the solid that the triangle bounds, 0 for none
  vec3 bounding_centre;            // of the scene; directional
  float bounding_radius;
};

PPM_FN vec3 triangle_area_normal(Light light) {
  return cross(light.corner1 - light.corner0, light.corner2 - light.corner0);
}

// KHR_lights_punctual's falloff between the cones.
PPM_FN float spot_falloff(LightRecord record, float cosine) {
  float scale = 1.0f / max(0.001f, record.cos_inner - record.cos_outer);
  float attenuation = clamp((cosine - record.cos_outer) * scale, 0.0f, 1.0f);
  return attenuation * attenuation;
}

// How far a light reaches, working units: point and spot.
PPM_FN float light_range(LightRecord record) {
  return record.kind == PPM_LIGHT_POINT || record.kind == PPM_LIGHT_SPOT
             ? uintBitsToFloat(record.triangle)
             : 1e30f;
}

// KHR_lights_punctual's window, which makes a light end at its range: 1 - (distance / range)^4.
PPM_FN float range_window(float distance, float range) {
  float ratio = min(distance / range, 1.0f);
  return 1.0f - square(square(ratio));
}

// Power in watts times frame.scale^2, by channel. Triangle: pi A L a side; point: 4 pi I; spot: I
// integrated over its cone (both without regard to their range); directional and environment: the
// disc it shines through times E, or times radiance integrated over the sphere.
PPM_FN vec3 light_power(Light light) {
  LightRecord record = light.record;
  if (record.kind == PPM_LIGHT_TRIANGLE) {
    float area = 0.5f * length(triangle_area_normal(light));
    return record.emission * (PPM_PI * area * (1.0f + light.two_sided));
  }
  if (record.kind == PPM_LIGHT_POINT) return record.emission * (4.0f * PPM_PI);
  if (record.kind == PPM_LIGHT_SPOT) {
    float ramp = max(0.001f, record.cos_inner - record.cos_outer);
    float top = min(1.0f, record.cos_outer + ramp);
    return record.emission * (2.0f * PPM_PI * ((1.0f - top) + (top - record.cos_outer) / 3.0f));
  }
  return record.emission * (PPM_PI * square(light.bounding_radius));
}

struct LightEmission {
  vec3 position;
  vec3 normal;       // of the surface photons start on; zero for lights without one
  vec3 direction;    // the way the photon travels
  vec3 flux;         // emitted radiance (or intensity ...) * cosine / the two densities
  vec2 barycentric;  // triangle: weights of the corners 1 and 2
  float pdf_position_area;
  float pdf_direction_solid_angle;
};

// A photon's start. u: position (xy), direction (zw); side: uniform, chooses the side of a
// two-sided light.
PPM_FN LightEmission light_emit(Light light, vec4 u, float side) {
  LightRecord record = light.record;
  LightEmission result;
  result.normal = vec3(0.0f);
  result.barycentric = vec2(0.0f);
  if (record.kind == PPM_LIGHT_TRIANGLE) {
    vec2 b = sample_triangle(vec2(u.x, u.y));
    result.barycentric = b;
    vec3 area_normal = triangle_area_normal(light);
    float doubled_area = length(area_normal);
    vec3 normal = area_normal / doubled_area;
    float sides = 1.0f + light.two_sided;
    if (light.two_sided > 0.0f && side < 0.5f) normal = -normal;
    vec3 local = sample_cosine_hemisphere(vec2(u.z, u.w));
    result.position =
        light.corner0 * (1.0f - b.x - b.y) + light.corner1 * b.x + light.corner2 * b.y;
    result.normal = normal;
    result.direction = to_world(local, normal);
    result.pdf_position_area = 2.0f / doubled_area;
    result.pdf_direction_solid_angle = cosine_hemisphere_pdf_solid_angle(local.z) / sides;
    // cosine / densities, with the cosine cancelled so that grazing directions keep their digits.
    result.flux = record.emission * (0.5f * doubled_area * PPM_PI * sides);
    return result;
  }
  if (record.kind == PPM_LIGHT_DIRECTIONAL) {
    vec2 disc = sample_disc(vec2(u.x, u.y)) * light.bounding_radius;
    vec3 tangent;
    vec3 bitangent;
    tangent_frame(record.direction, tangent, bitangent);
    result.position = light.bounding_centre - record.direction * light.bounding_radius +
                      tangent * disc.x + bitangent * disc.y;
    result.direction = record.direction;
    result.pdf_position_area = disc_pdf_area() / square(light.bounding_radius);
    result.pdf_direction_solid_angle = 1.0f;
    result.flux = record.emission / result.pdf_position_area;
    return result;
  }
  result.position = record.position;
  result.pdf_position_area = 1.0f;
  if (record.kind == PPM_LIGHT_POINT) {
    result.direction = sample_sphere(vec2(u.z, u.w));
    result.pdf_direction_solid_angle = sphere_pdf_solid_angle();
    result.flux = record.emission / result.pdf_direction_solid_angle;
  } else {
    vec3 local = sample_cone(vec2(u.z, u.w), record.cos_outer);
    result.direction = to_world(local, record.direction);
    result.pdf_direction_solid_angle = cone_pdf_solid_angle(record.cos_outer);
    result.flux =
        record.emission * (spot_falloff(record, local.z) / result.pdf_direction_solid_angle);
  }
  return result;
}

struct LightConnection {
  vec2 barycentric;  // triangle: weights of the corners 1 and 2 of the point on the light
  vec3 direction;    // from the receiver to the light, unit
  float distance;    // infinity is 1e30
  vec3 radiance;     // so that radiance * f * cosine / pdf_solid_angle estimates reflected light
  float pdf_solid_angle;                 // at the receiver; 1 for delta lights
  float pdf_position_area;               // of the light point
  float emit_pdf_direction_solid_angle;  // with which light_emit would send a photon this way
  float light_cosine;                    // at the light; 1 where it has no surface
};

// What `point` sees of the light, at a random position on it. radiance is zero on the dark side.
PPM_FN LightConnection light_connect(Light light, vec3 point, vec2 u) {
  LightRecord record = light.record;
  LightConnection result;
  result.pdf_solid_angle = 1.0f;
  result.pdf_position_area = 1.0f;
  result.light_cosine = 1.0f;
  result.barycentric = vec2(0.0f);
  if (record.kind == PPM_LIGHT_DIRECTIONAL) {
    result.direction = -record.direction;
    result.distance = 1e30f;
    result.radiance = record.emission;
    result.pdf_position_area = disc_pdf_area() / square(light.bounding_radius);
    result.emit_pdf_direction_solid_angle = 1.0f;
    return result;
  }
  vec3 position = record.position;
  vec3 area_normal = vec3(0.0f);
  if (record.kind == PPM_LIGHT_TRIANGLE) {
    vec2 b = sample_triangle(u);
    result.barycentric = b;
    position = light.corner0 * (1.0f - b.x - b.y) + light.corner1 * b.x + light.corner2 * b.y;
    area_normal = triangle_area_normal(light);
  }
  vec3 to_light = position - point;
  float distance2 = max(dot(to_light, to_light), 1e-30f);
  result.distance = sqrt(distance2);
  result.direction = to_light / result.distance;
  if (record.kind == PPM_LIGHT_TRIANGLE) {
    float doubled_area = length(area_normal);
    float cosine = -dot(result.direction, area_normal) / doubled_area;
    if (light.two_sided > 0.0f) cosine = abs(cosine);
    result.light_cosine = max(cosine, 0.0f);
    result.pdf_position_area = 2.0f / doubled_area;
    result.pdf_solid_angle =
        result.pdf_position_area * distance2 / max(result.light_cosine, 1e-12f);
    result.emit_pdf_direction_solid_angle =
        cosine_hemisphere_pdf_solid_angle(result.light_cosine) / (1.0f + light.two_sided);
    result.radiance = cosine > 0.0f ? record.emission : vec3(0.0f);
  } else if (record.kind == PPM_LIGHT_POINT) {
    result.emit_pdf_direction_solid_angle = sphere_pdf_solid_angle();
    result.radiance =
        record.emission * (range_window(result.distance, light_range(record)) / distance2);
  } else {
    float cosine = -dot(result.direction, record.direction);
    bool inside = cosine > record.cos_outer;
    result.emit_pdf_direction_solid_angle = inside ? cone_pdf_solid_angle(record.cos_outer) : 0.0f;
    result.radiance =
        inside ? record.emission * (spot_falloff(record, cosine) *
                                    range_window(result.distance, light_range(record)) / distance2)
               : vec3(0.0f);
  }
  return result;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_LIGHT_H
