// Every field of every record of shared/layout.h by name: one list that a kernel writes by and the
// host reads by. The includer defines what U (uint), F (float) and their vectors do with a field.
#ifndef PPM_TESTS_LAYOUT_FIELDS_H
#define PPM_TESTS_LAYOUT_FIELDS_H

// clang-format off

#define PPM_FIELDS_4(a, n) U1(a[n]) U1(a[n + 1]) U1(a[n + 2]) U1(a[n + 3])
#define PPM_FIELDS_16(a, n) \
  PPM_FIELDS_4(a, n) PPM_FIELDS_4(a, n + 4) PPM_FIELDS_4(a, n + 8) PPM_FIELDS_4(a, n + 12)

#define PPM_FIELDS_BVH_NODE(r) U4(r.box_x) U4(r.box_y) U4(r.box_z) U4(r.children)
#define PPM_FIELDS_TRIANGLE_POSITIONS(r) \
  F3(r.corner0) U1(r.material) F3(r.corner1) F1(r.light_probability) F3(r.corner2) U1(r.spare2)
#define PPM_FIELDS_TRIANGLE_SHADING(r) \
  U1(r.normal0) U1(r.normal1) U1(r.normal2) U1(r.material) F2(r.texcoord0) F2(r.texcoord1) \
  F2(r.texcoord2) U2(r.color0) U2(r.color1) U2(r.color2)
#define PPM_FIELDS_MATERIAL_RECORD(r) \
  F3(r.base_color) U1(r.first_use) F1(r.metallic) F1(r.roughness) F1(r.transmission) F1(r.ior) \
  F3(r.specular_f0) F1(r.specular) F3(r.emission) U1(r.flags) F1(r.alpha) F1(r.alpha_cutoff) \
  F1(r.normal_scale) U1(r.use_mask) F1(r.clearcoat) F1(r.clearcoat_roughness) \
  U1(r.medium) U1(r.spare)
#define PPM_FIELDS_TRIANGLE_DETAIL(r) \
  F2(r.texcoord0) F2(r.texcoord1) F2(r.texcoord2) U1(r.tangent0) U1(r.tangent1) U1(r.tangent2) \
  U1(r.spare0) U1(r.spare1) U1(r.spare2)
#define PPM_FIELDS_TEXTURE_USE(r) F3(r.row_s) U1(r.texture) F3(r.row_t) U1(r.spare)
#define PPM_FIELDS_MEDIUM_RECORD(r) \
  F3(r.absorption) F1(r.ior) F1(r.dispersion) U1(r.spare0) U1(r.spare1) U1(r.spare2)
#define PPM_FIELDS_START_MEDIA_PUSH(r) U1(r.first) U1(r.count)
#define PPM_FIELDS_TEXTURE_RECORD(r) U1(r.width) U1(r.height) U1(r.first) U1(r.sampling)
#define PPM_FIELDS_LIGHT_RECORD(r) \
  F3(r.position) U1(r.kind) F3(r.emission) F1(r.probability) F3(r.direction) U1(r.triangle) \
  F1(r.cos_inner) F1(r.cos_outer) U1(r.alias_threshold) U1(r.alias)
#define PPM_FIELDS_SCENE_CONSTANTS(r) \
  F3(r.grid_origin) U1(r.light_count) F3(r.grid_step) F1(r.total_power) F3(r.bounding_centre) \
  F1(r.bounding_radius) F3(r.camera_position) F1(r.camera_tan_half_y) F3(r.camera_right) \
  F1(r.camera_tan_half_x) F3(r.camera_up) U1(r.width) F3(r.camera_forward) U1(r.height) \
  U1(r.seed) U1(r.max_depth) U1(r.photon_bounce_cap) U1(r.eye_bounce_cap) U1(r.camera_kind) \
  U1(r.environment_width) U1(r.environment_height) F1(r.environment_turn) \
  F1(r.environment_pdf_scale)
#define PPM_FIELDS_PHOTON_PATH(r) \
  F3(r.origin) U1(r.path) F3(r.direction) U1(r.state) F3(r.flux) U1(r.skip) U1(r.media)
#define PPM_FIELDS_PHOTON_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.pass) U1(r.paths) U1(r.passes) U1(r.emit_first) U1(r.generate) \
  U1(r.photon_share) U1(r.path_capacity) U1(r.stream) U1(r.round)
#define PPM_FIELDS_CAMERA_PATH(r) \
  F3(r.origin) U1(r.pixel) F3(r.direction) U1(r.state) F3(r.weight) U1(r.skip) F3(r.radiance) \
  U1(r.media) F1(r.pdf_solid_angle) F1(r.distance)
#define PPM_FIELDS_PATH_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.pass) U1(r.path_first) U1(r.generate) U1(r.path_capacity) \
  U1(r.round) U1(r.filter_kind)
#define PPM_FIELDS_BATCH_CHECK_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.step) U1(r.pass) U1(r.passes) U1(r.photon_share) U1(r.rounds)
#define PPM_FIELDS_BATCH_WORDS(r) \
  U1(r.go_on) U1(r.completed) U1(r.clamped) U1(r.overflow) \
  PPM_FIELDS_16(r.alive, 0) PPM_FIELDS_16(r.alive, 16) U1(r.alive[32]) \
  PPM_FIELDS_16(r.photons, 0) PPM_FIELDS_16(r.sortable, 0)
#define PPM_FIELDS_GRID_CONSTANTS(r) \
  F3(r.origin) F1(r.inverse_cell) U3(r.size) U1(r.table_mask) U1(r.table_first)
#define PPM_FIELDS_GRID_PUSH(r) \
  U1(r.first) U1(r.count) PPM_FIELDS_GRID_CONSTANTS(r.grid) U1(r.photon_share) U1(r.entries)
#define PPM_FIELDS_SCAN_PUSH(r) U1(r.first) U1(r.count) U1(r.total) U1(r.slice)
#define PPM_FIELDS_EYE_PATH(r) \
  F3(r.origin) U1(r.group) F3(r.direction) U1(r.state) F3(r.weight) U1(r.skip) U1(r.code) \
  U1(r.splits) F1(r.distance) F1(r.solid_angle) U1(r.media)
#define PPM_FIELDS_EYE_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.pass) U1(r.tile_first) U1(r.samples) U1(r.filter_kind) U1(r.hit_capacity) U1(r.path_capacity) F1(r.split_weight) U1(r.bounces)
#define PPM_FIELDS_HIT_POINT(r) \
  F3(r.position) U1(r.geometric_normal) U1(r.shading_normal) U1(r.outgoing) U1(r.statistics) \
  U1(r.flags) F3(r.weight) U1(r.bsdf_extra) U4(r.bsdf) U4(r.layers)
#define PPM_FIELDS_HIT_KEY(r) U1(r.group) U1(r.arrival) U1(r.order) U1(r.code)
#define PPM_FIELDS_EYE_ORDER_PUSH(r) U1(r.first) U1(r.count) U1(r.samples)
#define PPM_FIELDS_GATHER_SUM(r) \
  U1(r.count) U1(r.flux[0]) U1(r.flux[1]) U1(r.flux[2]) U1(r.flux[3]) U1(r.flux[4]) U1(r.flux[5]) \
  U1(r.nearby) U1(r.second_moment[0]) U1(r.second_moment[1])
#define PPM_FIELDS_GATHER_CURSOR(r) U1(r.hit) U1(r.row) U1(r.offset)
#define PPM_FIELDS_GATHER_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.cursor_capacity) PPM_FIELDS_GRID_CONSTANTS(r.grid)
#define PPM_FIELDS_UPDATE_PUSH(r) U1(r.first) U1(r.count) F1(r.alpha)
#define PPM_FIELDS_RESOLVE_PUSH(r) U1(r.first) U1(r.count) U1(r.samples) U1(r.skip) F1(r.scale)
#define PPM_FIELDS_PILOT_PUSH(r) \
  U1(r.first) U1(r.count) U1(r.round_index) U1(r.last_round) F1(r.radius) F1(r.footprints_min) \
  U1(r.wanted) U1(r.from_list) U1(r.coarse) PPM_FIELDS_GRID_CONSTANTS(r.grid)
#define PPM_FIELDS_RADIUS_PUSH(r) U1(r.first) U1(r.count) F1(r.fixed_radius) F1(r.footprints)

// RECORD(type, name, fields), in the order in which one block holds two of each.
#define PPM_ALL_RECORDS \
  RECORD(BvhNode, bvh_node, PPM_FIELDS_BVH_NODE) \
  RECORD(TrianglePositions, triangle_positions_record, PPM_FIELDS_TRIANGLE_POSITIONS) \
  RECORD(TriangleShading, triangle_shading_record, PPM_FIELDS_TRIANGLE_SHADING) \
  RECORD(TriangleDetail, triangle_detail_record, PPM_FIELDS_TRIANGLE_DETAIL) \
  RECORD(TextureUse, texture_use_record, PPM_FIELDS_TEXTURE_USE) \
  RECORD(MaterialRecord, material_record, PPM_FIELDS_MATERIAL_RECORD) \
  RECORD(MediumRecord, medium_record, PPM_FIELDS_MEDIUM_RECORD) \
  RECORD(TextureRecord, texture_record, PPM_FIELDS_TEXTURE_RECORD) \
  RECORD(StartMediaPush, start_media_push, PPM_FIELDS_START_MEDIA_PUSH) \
  RECORD(LightRecord, light_record, PPM_FIELDS_LIGHT_RECORD) \
  RECORD(SceneConstants, scene_constants, PPM_FIELDS_SCENE_CONSTANTS) \
  RECORD(PhotonPath, photon_path, PPM_FIELDS_PHOTON_PATH) \
  RECORD(PhotonPush, photon_push, PPM_FIELDS_PHOTON_PUSH) \
  RECORD(CameraPath, camera_path, PPM_FIELDS_CAMERA_PATH) \
  RECORD(PathPush, path_push, PPM_FIELDS_PATH_PUSH) \
  RECORD(BatchCheckPush, batch_check_push, PPM_FIELDS_BATCH_CHECK_PUSH) \
  RECORD(BatchWords, batch_words, PPM_FIELDS_BATCH_WORDS) \
  RECORD(GridConstants, grid_constants, PPM_FIELDS_GRID_CONSTANTS) \
  RECORD(GridPush, grid_push, PPM_FIELDS_GRID_PUSH) \
  RECORD(ScanPush, scan_push, PPM_FIELDS_SCAN_PUSH) \
  RECORD(EyePath, eye_path, PPM_FIELDS_EYE_PATH) \
  RECORD(EyePush, eye_push, PPM_FIELDS_EYE_PUSH) \
  RECORD(HitPoint, hit_point, PPM_FIELDS_HIT_POINT) \
  RECORD(HitKey, hit_key, PPM_FIELDS_HIT_KEY) \
  RECORD(EyeOrderPush, eye_order_push, PPM_FIELDS_EYE_ORDER_PUSH) \
  RECORD(GatherSum, gather_sum, PPM_FIELDS_GATHER_SUM) \
  RECORD(GatherCursor, gather_cursor, PPM_FIELDS_GATHER_CURSOR) \
  RECORD(GatherPush, gather_push, PPM_FIELDS_GATHER_PUSH) \
  RECORD(UpdatePush, update_push, PPM_FIELDS_UPDATE_PUSH) \
  RECORD(ResolvePush, resolve_push, PPM_FIELDS_RESOLVE_PUSH) \
  RECORD(PilotPush, pilot_push, PPM_FIELDS_PILOT_PUSH) \
  RECORD(RadiusPush, radius_push, PPM_FIELDS_RADIUS_PUSH)

// clang-format on

#endif  // PPM_TESTS_LAYOUT_FIELDS_H
