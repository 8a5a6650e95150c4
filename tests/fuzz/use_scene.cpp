// A small scene to be saved, and what may happen to one that was loaded.

#include "use.h"

namespace dsw_fuzz {
namespace {

/** A body of four vertices round a place. */
void add_body(dsw_scene* scene, const double (&at)[3], dsw_level level, uint32_t flags) {
  const double size = 0.3;
  const size_t dimension = dimension_of(dsw_scene_get_environment(scene));
  double positions[12];
  for (size_t v = 0; v < 4; ++v) {
    for (size_t k = 0; k < dimension; ++k) positions[dimension * v + k] = at[k] + (v == k + 1 ? size : 0);
  }
  const uint32_t edges[] = {0, 1, 1, 2, 2, 3}, offsets[] = {0, 3, 6}, corners[] = {0, 1, 2, 0, 2, 3};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.level = level;
  desc.positions = positions;
  desc.vertex_count = 4;
  desc.edges = edges;
  desc.edge_count = level == DSW_LEVEL_FACES ? 0 : 3;
  desc.face_offsets = offsets;
  desc.face_corners = corners;
  desc.face_count = level == DSW_LEVEL_FACES ? 2 : 0;
  desc.face_corner_count = level == DSW_LEVEL_FACES ? 6 : 0;
  dsw_body_id body;
  require(dsw_body_create(scene, &desc, &body) == DSW_STATUS_OK, "a body in the open");
}

/** Moves a body, if that is one, by the same way for all its vertices. */
void move_body(dsw_scene* scene, dsw_body_id body, const double (&by)[3]) {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  if (dsw_body_get_counts(scene, body, &counts) != DSW_STATUS_OK) return;
  const size_t dimension = dimension_of(dsw_scene_get_environment(scene));
  std::vector<double> targets(dimension * counts.vertex_slots);
  size_t count = 0;
  require(dsw_body_get_positions(scene, body, targets.data(), counts.vertex_slots, 0, nullptr, &count) == DSW_STATUS_OK,
          "positions of a body");
  for (size_t i = 0; i < targets.size(); ++i) targets[i] += by[i % dimension];
  const dsw_status status = dsw_body_move(scene, body, targets.data(), counts.vertex_slots, 0, nullptr, nullptr);
  require(status == DSW_STATUS_OK || status == DSW_STATUS_NON_FINITE, "a body moves");
  const dsw_body_contact* contacts = nullptr;
  require(dsw_body_get_contacts(scene, body, &contacts, &count) == DSW_STATUS_OK, "contacts of a body");
}

}  // namespace

dsw_scene* make_inhabited(dsw_environment* home) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_STATISTICS;
  dsw_scene* scene = nullptr;
  require(dsw_scene_create(home, &desc, &scene) == DSW_STATUS_OK, "a scene");
  const dsw_level levels[] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES};
  const int count = dimension_of(home) == 3 ? 4 : 3;
  for (int i = 0; i < count; ++i) {
    const double at[3] = {0.25 + 0.5 * i, 0.25, 0.4};
    add_body(scene, at, levels[i], i == 1 ? DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_CLEARANCE : 0);
    if (levels[i] == DSW_LEVEL_EDGES_SWEPT) dsw_body_set_radius(scene, {static_cast<uint32_t>(i), 1}, 1.0 / 64);
    dsw_particle_id particle;
    require(dsw_particle_create(scene, at, {0, 0}, &particle) == DSW_STATUS_OK, "a particle");
    if (i == 2) dsw_particle_destroy(scene, particle);
  }
  use_scene(scene);
  require(dsw_body_destroy(scene, {0, 1}) == DSW_STATUS_OK, "a body goes");
  return scene;
}

void use_scene(dsw_scene* scene) {
  const double ways[][3] = {{0, 0.7, 0.5}, {0.1, 0.4, 0.6}, {0.7, -0.3, 0.2}};
  for (const auto& way : ways) {
    for (uint32_t i = 0; i < 6; ++i) {
      for (uint32_t generation = 1; generation < 3; ++generation) {
        move_body(scene, {i, generation}, way);
        dsw_flight flight;
        const dsw_status status = dsw_particle_move(scene, {i, generation}, way, nullptr, &flight);
        require(status == DSW_STATUS_OK || status == DSW_STATUS_STALE_ID, "a particle moves");
      }
    }
    check_radii(scene);
  }
}

}  // namespace dsw_fuzz
