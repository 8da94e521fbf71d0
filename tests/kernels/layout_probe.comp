// Writes a number of its own into every component of every record, two of each, by the fields' names; and passes on,
// component by component, the records that the kernels' own fetch functions and a uniform block read.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "layout_fields.h"
#include "lib/lights.glsl"

layout(push_constant, scalar) uniform PushBlock { uint first, count; } push;

#define RECORD(type, name, fields) type name[2];
layout(binding = PPM_BIND_TEST_0, scalar) writeonly buffer Records { PPM_ALL_RECORDS } records;
#undef RECORD
layout(binding = PPM_BIND_TEST_1, scalar) writeonly buffer Fetched { uint fetched[]; };

void write_records() {
  uint n = 1u;
#define U1(v) v = n; n += 1u;
#define U2(v) v = uvec2(n, n + 1u); n += 2u;
#define U3(v) v = uvec3(n, n + 1u, n + 2u); n += 3u;
#define U4(v) v = uvec4(n, n + 1u, n + 2u, n + 3u); n += 4u;
#define F1(v) v = float(n); n += 1u;
#define F2(v) v = vec2(float(n), float(n + 1u)); n += 2u;
#define F3(v) v = vec3(float(n), float(n + 1u), float(n + 2u)); n += 3u;
#define RECORD(type, name, fields) fields(records.name[0]) fields(records.name[1])
  PPM_ALL_RECORDS
#undef RECORD
#undef U1
#undef U2
#undef U3
#undef U4
#undef F1
#undef F2
#undef F3
}

void pass_on() {
  uint n = 0u;
#define U1(v) fetched[n++] = v;
#define F1(v) fetched[n++] = floatBitsToUint(v);
#define F3(v) F1(v.x) F1(v.y) F1(v.z)
  MaterialRecord material = fetch_material(1u);
  PPM_FIELDS_MATERIAL_RECORD(material)
  LightRecord light = fetch_light(1u).record;
  PPM_FIELDS_LIGHT_RECORD(light)
  TriangleCorners corners = fetch_triangle(1u);
  F3(corners.corner0) U1(corners.material) F3(corners.corner1) F3(corners.corner2)
  PPM_FIELDS_SCENE_CONSTANTS(scene)
}

void main() {
  if (item_of_invocation(push.first) != 0u) return;
  write_records();
  pass_on();
}
