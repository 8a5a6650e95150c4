#include "together/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"
#include "base/vec.h"
#include "contact/describe.h"
#include "contact/normals.h"
#include "environment/marking.h"
#include "together/touch_moment.h"

namespace dsw {
namespace {

/** When and where a pair touches, with the unit normal from its second side to the first. */
template <int D>
Touch touch_of(const WayTouch<D>& met, double sign) {
  const TouchMoment<D> m(met.pair, met.first.time);
  const Vec normal = m.normal(met.pair.kind);
  Vec point = m.at[0];
  if constexpr (D == 3) {
    if (met.pair.kind == PairKind::kEdgeEdge) {
      point = point + nearest_share(m.at[0], m.at[1], m.at[2], m.at[3]) * (m.at[1] - m.at[0]);
    }
  }
  Touch touch;
  touch.time = met.first.time;
  store<D>(point, touch.point);
  store<D>(sign * normal + Vec::Zero(), touch.other.normal);  // never -0
  return touch;
}

template <int D>
void name_feature(const Environment<D>& env, const WallFeature& wall, dsw_contact& contact) {
  const bool is_marked_vertex = wall.count == 1 && vertex_marked(env, wall.vertices[0]);
  WallFeature named = wall;
  if (wall.count == D) named.count = 0;  // a whole facet has its name
  name_obstacle(env, named, is_marked_vertex ? DSW_CELL_VERTEX : DSW_CELL_EDGE, contact);
}

template <int D>
void place_at(const Trajectory<D>& of, uint32_t v, double time, double* place) {
  point_at<D>(of.start(v), of.end(v), time, place);
}

/** A contact as a part that moves has it.
 * @param other the touched body; null: the environment. */
template <int D>
dsw_body_contact describe_part(const Environment<D>& env, const Trajectory<D>& of, const Simplex& part,
                               const Partner<D>* other, const Simplex& other_part, const WallFeature& wall,
                               Touch touch) {
  const Body<D>& body = *of.motion.body;
  uint32_t v = kNone;
  for (const uint32_t each : SimplexCorners<D>(body, part)) {
    if (of.moves(each)) v = std::min(v, each);
  }
  touch.part = part;
  place_at(of, v, touch.time, touch.position);
  double fixed[2][3] = {};
  if (part.kind == Simplex::kEdge) {
    place_at(of, body.edges[part.index].other(v), touch.time, fixed[0]);
    touch.along = share_along<D>(touch.position, fixed[0], touch.point);
  } else if (part.kind == Simplex::kFace) {
    place_at(of, body.faces[part.index].after(v), touch.time, fixed[0]);
    place_at(of, body.faces[part.index].before(v), touch.time, fixed[1]);
  }
  if (other == nullptr) {
    name_feature(env, wall, touch.other);
  } else {
    touch.other.front = volume_id(env.map, body.vertices[v].cell);
    touch.other.kind = contact_kind(other_part.kind);
  }
  dsw_body_contact contact = describe(body, v, of.end(v), touch);
  std::copy_n(&fixed[0][0], 6, &contact.fixed[0][0]);
  return contact;
}

}  // namespace

template <int D>
void describe_touches(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& touches) {
  dsw::sort(touches.begin(), touches.end(),
            [](const WayTouch<D>& a, const WayTouch<D>& b) { return name_of(a) < name_of(b); });
  for (const WayTouch<D>& met : touches) {
    const auto add = [&](uint32_t number, const Simplex& part, const Partner<D>* other, const Simplex& other_part,
                         double sign) {
      const Trajectory<D>& of = trajectories[number];
      const SimplexCorners<D> corners(*of.motion.body, part);
      if (dsw::none_of(corners.begin(), corners.end(), [&](uint32_t v) { return of.moves(v); })) return;
      of.record->add(describe_part(env, of, part, other, other_part, met.wall, touch_of(met, sign)),
                     other == nullptr ? dsw_contact_partner{} : name_partner(*other, other_part));
    };
    const double sign = met.comes_first ? 1 : -1;
    add(met.trajectory, met.part, met.other, met.other_part, sign);
    if (met.other_trajectory == kNone) continue;
    add(met.other_trajectory, met.other_part, &trajectories[met.trajectory].name, met.part, -sign);
  }
}

template <int D>
Touch touch_of(const Environment<D>& env, const Trajectory<D>& of, const TooNearOnWay<D>& near) {
  Touch touch;
  touch.time = near.time;
  store<D>(near.points[1], touch.point);
  store<D>(near.normal + Vec::Zero(), touch.other.normal);  // never -0
  if (near.other == nullptr) name_feature(env, near.wall, touch.other);
  if (near.part.kind == Simplex::kEdge) {
    const SimplexCorners<D> corners(*of.motion.body, near.part);
    double ends[2][D];
    for (uint32_t i = 0; i < 2; ++i) place_at(of, corners.vertices[i], touch.time, ends[i]);
    touch.along = share_along<D>(ends[0], ends[1], touch.point);
  }
  return touch;
}

template <int D>
void describe_too_near(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<TooNearOnWay<D>>& first) {
  dsw::sort(first.begin(), first.end(),
            [&](const TooNearOnWay<D>& a, const TooNearOnWay<D>& b) { return name_of(a) < name_of(b); });
  for (const TooNearOnWay<D>& near : first) {
    const auto add = [&](uint32_t number, const Simplex& part, const Partner<D>* other, const Simplex& other_part,
                         bool is_first) {
      const Trajectory<D>& of = trajectories[number];
      const SimplexCorners<D> corners(*of.motion.body, part);
      if (dsw::none_of(corners.begin(), corners.end(), [&](uint32_t v) { return of.moves(v); })) return;
      Touch touch;
      touch.time = near.time;
      store<D>(near.points[is_first ? 1 : 0], touch.point);
      store<D>((is_first ? 1 : -1) * near.normal + Vec::Zero(), touch.other.normal);
      of.record->add(describe_part(env, of, part, other, other_part, near.wall, touch),
                     other == nullptr ? dsw_contact_partner{} : name_partner(*other, other_part));
    };
    add(near.trajectory, near.part, near.other, near.other_part, true);
    if (near.other_trajectory == kNone) continue;
    add(near.other_trajectory, near.other_part, &trajectories[near.trajectory].name, near.part, false);
  }
}

template <int D>
dsw_wall_contact describe_wall(const Environment<D>& env, const Array<Trajectory<D>>& trajectories,
                               const WayTouch<D>& met) {
  const Trajectory<D>& of = trajectories[met.trajectory];
  const SimplexCorners<D> corners(*of.motion.body, met.part);
  const uint32_t first_wall = met.comes_first ? corners.count : 0;
  Touch touch = touch_of(met, met.comes_first ? 1 : -1);
  name_feature(env, met.wall, touch.other);
  if (met.part.kind == Simplex::kEdge) {
    double ends[2][D];
    for (uint32_t i = 0; i < 2; ++i) place_at(of, corners.vertices[i], touch.time, ends[i]);
    touch.along = share_along<D>(ends[0], ends[1], touch.point);
  }
  return describe(env, met.wall, met.pair.start[first_wall], met.pair.end[first_wall], touch, DSW_WALL_STOP);
}

DSW_INSTANTIATE(describe_wall);
template Touch touch_of(const Environment<2>&, const Trajectory<2>&, const TooNearOnWay<2>&);
template Touch touch_of(const Environment<3>&, const Trajectory<3>&, const TooNearOnWay<3>&);
template void describe_too_near(const Environment<2>&, Array<Trajectory<2>>&, Array<TooNearOnWay<2>>&);
template void describe_too_near(const Environment<3>&, Array<Trajectory<3>>&, Array<TooNearOnWay<3>>&);
template void describe_touches(const Environment<2>&, Array<Trajectory<2>>&, Array<WayTouch<2>>&);
template void describe_touches(const Environment<3>&, Array<Trajectory<3>>&, Array<WayTouch<3>>&);

}  // namespace dsw
