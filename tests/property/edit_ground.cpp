#include "edit_ground.h"

#include "body_state.h"

namespace dsw::oracle {

Ground<2>::Ground(const std::string& scene, uint64_t seed, dsw_context* context) {
  const std::vector<plane::Turn> turns = plane::turns(scene);
  const plane::Turn& turn = turns[seed % turns.size()];
  Rng rng(seed);
  world = plane::make_world(turn, rng);
  environment = plane::make_environment(turn, world, rng, context);
  for (size_t axis = 0; axis < 2; ++axis) {
    const auto less = [&](const plane::Vec& a, const plane::Vec& b) { return a[axis] < b[axis]; };
    const auto ends = std::minmax_element(world.points.begin(), world.points.end(), less);
    size_ = std::max(size_, (*ends.second)[axis] - (*ends.first)[axis]);
  }
}

/// Mostly inside of a cell, at times exactly on something.
plane::Vec Ground<2>::start(Rng& rng) const {
  const std::vector<int>& cell = world.cells[rng.below(world.cells.size())];
  const auto corner = [&]() -> const plane::Vec& {
    return world.points[static_cast<size_t>(cell[rng.below(cell.size())])];
  };
  plane::Vec p = corner();
  for (int k = rng.chance(0.1) ? 1 : 3; k > 0; --k) {
    const plane::Vec& to = corner();
    const double t = rng.chance(0.3) ? 0.5 : rng.unit();
    for (size_t axis = 0; axis < 2; ++axis) p[axis] += t * (to[axis] - p[axis]);
  }
  return p;
}

void create_some_body(dsw_scene* scene, const std::vector<Vec>& at, uint32_t number) {
  BodyPlan plan;
  plan.at = at;
  if (number % 2 == 0) {
    plan.edges = {{0, 1}, {1, 2}, {2, 3}};
  } else {
    plan.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
  }
  dsw_body_id body;
  const uint32_t flags = number % 2 == 0 ? DSW_BODY_SKIP_BY_CLEARANCE : 0;
  create_body(scene, plan, static_cast<dsw_level>(1 + number % 4), flags, {}, &body);
}

void create_some_body(dsw_scene* scene, const std::vector<plane::Vec>& at, uint32_t number) {
  const uint32_t edges[] = {0, 1, 1, 2, 2, 3, 3, 0};
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  desc.positions = at[0].data();
  desc.vertex_count = at.size();
  desc.edges = edges;
  desc.edge_count = number % 2 == 0 ? 3 : 4;
  desc.level = static_cast<dsw_level>(1 + number % 3);
  desc.flags = number % 2 == 0 ? DSW_BODY_SKIP_BY_CLEARANCE : 0;
  dsw_body_id body;
  dsw_body_create(scene, &desc, &body);
}

}  // namespace dsw::oracle
