// What the CAMERA_VERTICES see of the lights: one invocation asks for a point of one light (next event estimation), or
// adds light that a camera path has hit.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/bidirectional.glsl"

PPM_TEXELS(PPM_BIND_CAMERA_VERTICES, camera_vertices);

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= min(counters[PPM_COUNTER_CAMERA_VERTICES], push.vertex_capacity)) return;
  PathVertex vertex = PPM_FETCH_VERTEX(camera_vertices, item);
  if ((vertex.state & PPM_BDPT_EMISSION) != 0u) {
    deposit(vertex.path, vertex.throughput);
    return;
  }
  if ((kWays & PPM_BDPT_NEXT_EVENT) == 0u) return;
  Meeting meeting = meeting_at(vertex);
  vec3 position = meeting.surface.position;
  uint events = events_of(vertex.state);
  uint block = kCameraEventBlock + kCameraEventBlocks * events + 1u;
  uvec4 words = path_words(PPM_STREAM_CAMERA_PATH, vertex.path, block);
  Light light = fetch_light(choose_light(words.x, words.y));
  LightConnection connection = light_connect(light, position, units_of(words).zw);
  bool sky = kEnvironment && light.record.kind == PPM_LIGHT_ENVIRONMENT;
  if (sky) {
    vec3 towards_sky;
    uvec4 sky_words = path_words(PPM_STREAM_CAMERA_PATH, vertex.path, block + 1u);
    EnvironmentSight sight = sample_environment(sky_words.xy, units_of(sky_words).zw, towards_sky);
    connection = environment_connect(light, towards_sky, sight);
  }
  bool triangle = light.record.kind == PPM_LIGHT_TRIANGLE;
  bool infinite = sky || light.record.kind == PPM_LIGHT_DIRECTIONAL;
  vec3 radiance = connection.radiance;
  if (kTexturedLights && triangle) radiance *= light_texture(light.record.triangle, connection.barycentric);
  if (kLayers && triangle) {
    float coat = light_coat(light.record.triangle, connection.barycentric);
    radiance *= clearcoat_transmittance(Clearcoat(coat, 0.0), connection.light_cosine);
  }
  Lead lead = lead_towards(meeting, connection.direction, false);
  float probability = light.record.probability;
  vec3 value = lead.value * radiance / (probability * connection.pdf_solid_angle);
  if (!(max_component(value) > 0.0)) return;

  bool hittable = (triangle || sky) && (kWays & PPM_BDPT_EMITTERS) != 0u;
  float emitter = hittable ? lead.forward_pdf / (probability * connection.pdf_solid_angle) : 0.0;
  float pdf_area = infinite ? connection.pdf_position_area * lead.cosine
                            : connection.emit_pdf_direction_solid_angle * lead.cosine / square(connection.distance);
  value /= 1.0 + emitter + mis_others(mis_of(vertex), pdf_area, lead.reverse_pdf, camera_connects(vertex.state));

  set_coverage_key(PPM_STREAM_CONNECTION, vertex.path, 0xffff0000u | events);
  vec3 direction = connection.direction;
  float distance = connection.distance;
  if (!infinite) {
    vec3 end = light.record.position;
    if (triangle) {
      vec3 normal = normalize(triangle_area_normal(light));
      vec3 b = corner_weights(connection.barycentric);
      end = offset_origin(light.corner0 * b.x + light.corner1 * b.y + light.corner2 * b.z,
                          dot(normal, direction) < 0.0 ? normal : -normal);
    }
    vec3 across = end - lead.origin;
    distance = length(across);
    direction = across / distance;
  }
  value *= visible_share(lead.origin, direction, distance, vertex.triangle, lead.media);
  if (max_component(value) > 0.0) deposit(vertex.path, value);
}
