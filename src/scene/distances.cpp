#include "scene/distances.h"

#include <algorithm>

#include "base/dimensions.h"
#include "environment/marking.h"
#include "proximity/thick_sweep.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {
namespace {

/** What a body may come too near to, where it stands and within a limit. */
template <int D>
class Near {
 public:
  Near(const Scene<D>& scene, const Body<D>& body, double limit) : meets_(scene.features.contacts), all_(scene.memory) {
    if (meets_) find_partners_at_rest(scene, body, limit, all_);
  }
  const Partners<D>* partners() const { return meets_ ? &all_ : nullptr; }

 private:
  bool meets_;
  Partners<D> all_;
};

}  // namespace

template <int D>
void check_distances(Scene<D>& scene, const Body<D>& body) {
  const Near<D> near(scene, body, 0);
  if (!ThickSweep<D>::is_thick(near.partners(), body)) return;
  ThickSweep<D> thick(scene.env);
  for_each_outer(body, [&](const Simplex& part) {
    if (thick.keeps_at_rest(near.partners(), body, part)) return true;
    const SimplexCorners<D> corners(body, part);
    scene.offending.push_back(corners.vertices[0]);
    scene.offending.push_back(corners.vertices[corners.count > 1 ? 1 : 0]);
    return true;
  });
  if (scene.offending.empty()) return;
  fail(DSW_STATUS_OCCUPIED, "%zu vertices, edges or faces are too near to something; the first has vertices %u and %u",
       scene.offending.size() / 2, scene.offending[0], scene.offending[1]);
}

template <int D>
bool keeps_distances(const Scene<D>& scene, const Body<D>& body, const Places<D>& places) {
  if (!(body.radius > 0)) return true;
  ThickSweep<D> thick(scene.env);
  return for_each_outer(body, [&](const Simplex& part) {
    Box<D> box;
    for (const uint32_t v : SimplexCorners<D>(body, part)) box.add(body.position(v));
    box = widened(box, body.radius);
    const double* const corners[2] = {box.lower, box.upper};
    return !places.overlap(corners, 2) || thick.keeps_at_rest(nullptr, body, part);
  });
}

template <int D>
size_t leave_out_near(Environment<D>& env, const Body<D>& body) {
  if (!(body.radius > 0)) return 0;
  ThickSweep<D> thick(env);
  Array<HalfFacet> walls(env.memory);
  size_t left_out = 0;
  for (bool any = true; any;) {  // behind a cell whose mark is taken back the next one may be too near
    any = false;
    for_each_outer(body, [&](const Simplex& part) {
      walls.clear();
      thick.find_walls(body, part, walls);
      for (const HalfFacet wall : walls) {
        const HalfFacet behind = env.map.opposite(wall);
        if (behind.valid() && set_cell_mark(env, env.map.cell_of(behind), false)) ++left_out, any = true;
      }
      return true;
    });
  }
  return left_out;
}

template <int D>
void set_radius(Scene<D>& scene, BodyRecord<D>& of, double radius) {
  scene.offending.clear();
  Body<D>& body = of.body;
  const double before = body.radius;
  Array<double> lengths(body.lengths);
  body.radius = radius;
  try {
    measure_lengths(body);
    // With a smaller radius fewer of its own parts are joined, and else nothing new is too near.
    if (radius > before || body.keeps_lengths()) check_distances(scene, body);
  } catch (...) {
    body.radius = before;
    std::swap(body.lengths, lengths);
    throw;
  }
  refresh_body(scene, of);
}

template <int D>
double find_least_gap(const Scene<D>& scene, const Body<D>& body, double limit) {
  const Near<D> near(scene, body, limit);
  ThickSweep<D> thick(scene.env);
  double least = limit;
  for_each_outer(body, [&](const Simplex& part) {
    least = std::min(least, thick.least_gap(near.partners(), body, part, least));
    return true;
  });
  return least;
}

DSW_INSTANTIATE(check_distances);
DSW_INSTANTIATE(keeps_distances);
DSW_INSTANTIATE(leave_out_near);
DSW_INSTANTIATE(set_radius);
DSW_INSTANTIATE(find_least_gap);

}  // namespace dsw
