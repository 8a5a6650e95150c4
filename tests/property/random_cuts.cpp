// Cuts along random blades, most of them unfit to cut with, and pieces that come off.
#include <algorithm>
#include <cmath>

#include "random_edits.h"
#include "random_shapes.h"

namespace dsw::oracle {

/// Through the environment somewhere, or through its vertices; flat, bent, folded, or of no extent; much smaller or
/// larger than volumes.
template <>
std::vector<double> RandomEdits<3>::some_blade(uint32_t rows, uint32_t columns) {
  double at[3], across[3], along[3];
  const dsw::Cell c = some_cell();
  const auto vertex = [&] { return env().point(c, rng_.below(env().map.vertices_of(c))); };
  const double sizes[] = {1e-6, 0.02, 0.2, 0.5, 2, 100, 1e9};
  const double size = place_.size() * sizes[rng_.below(7)];
  if (rng_.chance(0.4)) {
    // The plane of three vertices: along a face, or through edges.
    const double *const p = vertex(), *const q = vertex(), *const r = vertex();
    const double stretch = rng_.chance(0.5) ? 1 : 10;
    for (int k = 0; k < 3; ++k) {
      across[k] = stretch * (q[k] - p[k]);
      along[k] = stretch * (r[k] - p[k]);
      at[k] = p[k] - (rng_.chance(0.5) ? 0 : 0.5) * (across[k] + along[k]);
    }
  } else {
    double middle[3];
    centre(env(), c, middle);
    for (int k = 0; k < 3; ++k) {
      across[k] = rng_.range(-size, size);
      along[k] = rng_.range(-size, size);
      at[k] = middle[k] - 0.5 * (across[k] + along[k]);
    }
    if (rng_.chance(0.2)) std::copy_n(along, 3, across);
    if (rng_.chance(0.1)) std::fill_n(across, 3, 0.0);
  }
  const double bend = rng_.chance(0.5) ? 0 : rng_.range(0, 0.3) * size;
  std::vector<double> points;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      for (int k = 0; k < 3; ++k) {
        const double u = double(row) / (rows - 1), v = double(column) / (columns - 1);
        points.push_back(at[k] + u * across[k] + v * along[k] + rng_.range(-bend, bend));
      }
    }
  }
  return points;
}

template <>
dsw_status RandomEdits<3>::cut() {
  dsw_cut_desc desc = defaults(dsw_cut_desc_init);
  desc.rows = 2 + rng_.below(3);
  desc.columns = 2 + rng_.below(3);
  const std::vector<double> points = some_blade(desc.rows, desc.columns);
  desc.points = points.data();
  desc.flags = rng_.chance(0.3) ? uint32_t{DSW_CUT_UNSEW} : 0;
  const double snaps[] = {0, 1e-12, 0.25, 0.05};
  desc.snap = snaps[rng_.below(4)];
  if (rng_.chance(0.7)) desc.start = volume_id(env().map, some_cell());
  may_change_ = true;
  const dsw_status status = dsw_environment_cut(place_.get(), &desc, nullptr);
  if (status != DSW_STATUS_OK || desc.flags == 0) return status;
  const dsw_cut_face *faces = change_of(place_.get()).faces;
  const size_t count = change_of(place_.get()).face_count;
  for (size_t i = 0; i < count; ++i) unsewn_.push_back({faces[i].front, faces[i].back});
  return status;
}

template <>
dsw_status RandomEdits<3>::carve() {
  const ClosedSurface surface = some_surface(env(), place_.size(), rng_);
  dsw_carve_desc desc = defaults(dsw_carve_desc_init);
  desc.points = surface.points.data();
  desc.point_count = surface.points.size() / 3;
  desc.triangles = surface.triangles.data();
  desc.triangle_count = surface.triangles.size() / 3;
  desc.flags = rng_.chance(0.2) ? uint32_t{DSW_CARVE_WHOLE} : rng_.chance(0.2) ? uint32_t{DSW_CARVE_COVER} : 0;
  if ((desc.flags & DSW_CARVE_WHOLE) == 0 && rng_.chance(0.3)) desc.finest = place_.size() * rng_.range(0.1, 0.5);
  if (rng_.chance(0.5)) desc.start = volume_id(env().map, some_cell());
  may_change_ = true;
  return dsw_environment_carve(place_.get(), &desc, nullptr);
}

/// What stays whole becomes impassable; carving makes up for it.
template <>
dsw_status RandomEdits<3>::tie() {
  const std::vector<double> loop = some_loop(env(), place_.size(), rng_);
  dsw_tie_desc desc = defaults(dsw_tie_desc_init);
  desc.points = loop.data();
  desc.point_count = loop.size() / 3;
  if (rng_.chance(0.5)) desc.start = volume_id(env().map, some_cell());
  may_change_ = true;
  return dsw_environment_tie(place_.get(), &desc, nullptr);
}

/// What is impassable somewhere; if nothing is, a volume with some that hang together with it becomes so.
template <>
dsw_status RandomEdits<3>::detach() {
  const Map<3> &map = env().map;
  dsw::Cell c = some_cell();
  for (int tries = 0; tries < 100 && !map.marked(c); ++tries) c = some_cell();
  if (!map.marked(c) || rng_.chance(0.3)) {
    std::vector<dsw_volume_id> volumes;
    for (uint32_t n = 1 + rng_.below(6); n > 0; --n) {
      volumes.push_back(volume_id(map, c));
      const HalfFacet o = map.opposite(map.half_facet(c, rng_.below(map.facets_of(c))));
      if (o.valid()) c = map.cell_of(o);
    }
    return dsw_environment_mark_volumes(place_.get(), volumes.data(), volumes.size(), DSW_MARK_IMPASSABLE,
                                        DSW_MARK_SKIP_OCCUPIED, nullptr);
  }
  dsw_detach_desc desc = defaults(dsw_detach_desc_init);
  desc.volume = volume_id(map, c);
  desc.level = static_cast<dsw_level>(1 + rng_.below(4));
  const double gaps[] = {0, 1e-9, 0.25, 0.05};
  desc.gap = gaps[rng_.below(4)];
  dsw_body_id body;
  return dsw_environment_detach(dsw_scene_get_environment(scene_.get()), &desc, &body, nullptr);
}

/// Else there would be more and more bodies.
template <>
void RandomEdits<3>::drop_pieces() {
  for (size_t b = first_bodies_; b < scene().bodies.size(); ++b) {
    const auto slot = static_cast<uint32_t>(b);
    dsw_body_destroy(scene_.get(), {slot, scene().body_slots.generation(slot)});
  }
}

}  // namespace dsw::oracle
