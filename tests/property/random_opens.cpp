// Cracks that open: between the volumes on two sides of a plane near by, and those that cuts and unsewing have left.
#include <algorithm>
#include <set>

#include "random_edits.h"

namespace dsw::oracle {

/// Faces between volumes of a random cluster that lie on different sides of a random plane; at times some are left out,
/// or all but one.
template <>
std::vector<dsw_cut_face> RandomEdits<3>::some_crack() {
  const Map<3>& map = env().map;
  std::vector<dsw::Cell> cells{some_cell()};
  const size_t wanted = 2 + rng_.below(rng_.chance(0.3) ? 200 : 30);
  std::set<uint32_t> seen{cells[0].unit};
  for (size_t i = 0; i < cells.size() && cells.size() < wanted; ++i) {
    for (uint32_t f = 0; f < map.facets_of(cells[i]); ++f) {
      const HalfFacet o = map.opposite(map.half_facet(cells[i], f));
      if (o.valid() && seen.insert(map.cell_of(o).unit).second) cells.push_back(map.cell_of(o));
    }
  }
  const double* const through = env().point(cells[0], rng_.below(map.vertices_of(cells[0])));
  const double normal[3] = {rng_.range(-1, 1), rng_.range(-1, 1), rng_.range(-1, 1)};
  const auto is_before = [&](dsw::Cell c) {
    double at[3], height = 0;
    centre(env(), c, at);
    for (int k = 0; k < 3; ++k) height += normal[k] * (at[k] - through[k]);
    return height > 0;
  };
  const double kept = rng_.chance(0.8) ? 1 : 0.7;
  std::vector<dsw_cut_face> faces;
  for (const dsw::Cell c : cells) {
    if (!is_before(c)) continue;
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      if (!o.valid() || seen.count(map.cell_of(o).unit) == 0 || is_before(map.cell_of(o)) || !rng_.chance(kept))
        continue;
      faces.push_back({face_id(map, h), face_id(map, o)});
    }
  }
  return faces;
}

template <>
dsw_status RandomEdits<3>::open() {
  const Map<3>& map = env().map;
  std::vector<dsw_cut_face> faces;
  if (rng_.chance(0.6)) faces = some_crack();
  const double share = rng_.chance(0.6) ? 1 : 0.7;
  std::set<uint32_t> named;  // detaching sews some, which then can be unsewn again
  for (const auto& pair : unsewn_) {
    const auto is_alive = [&](dsw_face_id f) { return map.is_alive(f.volume, f.generation); };
    if (!is_alive(pair[0]) || !is_alive(pair[1]) || !rng_.chance(share)) continue;
    const HalfFacet h = map.half_facet(map.cell(pair[0].volume), pair[0].local);
    const HalfFacet o = map.half_facet(map.cell(pair[1].volume), pair[1].local);
    if (map.opposite(h).valid() || named.count(h.word) + named.count(o.word) != 0) continue;
    named.insert({h.word, o.word});
    faces.push_back({pair[0], pair[1]});
  }
  const double widths[] = {1e-9, 0.01, 0.1, 1, 10};
  dsw_open_crack_desc desc = defaults(dsw_open_crack_desc_init);
  desc.faces = faces.data();
  desc.face_count = faces.size();
  desc.width = place_.size() * widths[rng_.below(5)];
  desc.region = rng_.chance(0.5) ? 99 : 0;
  may_change_ = true;
  return dsw_environment_open_crack(place_.get(), &desc, nullptr);
}

}  // namespace dsw::oracle
