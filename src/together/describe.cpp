#include "together/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/vec.h"
#include "contact/describe.h"
#include "contact/normals.h"
#include "environment/marking.h"

namespace dsw {
namespace {

/** Where the points of a pair are when it touches, and how they move. */
template <int D>
struct Moment {
  Vec at[D + 1], way[D + 1];

  explicit Moment(const WayTouch<D>& touch) {
    for (int i = 0; i <= D; ++i) {
      double place[D];
      point_at<D>(touch.pair.start[i], touch.pair.end[i], touch.first.time, place);
      at[i] = to_vec<D>(place);
      way[i] = difference<D>(touch.pair.end[i], touch.pair.start[i]);
    }
  }
};

/** A place on a segment, as a share of it. */
double clamped_share(double along, double whole) { return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0; }

/** The point of the first segment that is nearest to the second. */
Vec nearest_on_first(const Vec& p, const Vec& q, const Vec& a, const Vec& b) {
  const Vec d = q - p, e = b - a, w = p - a;
  const double dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dw = dot(d, w), ew = dot(e, w);
  const double whole = dd * ee - de * de;
  double share = clamped_share(de * ew - ee * dw, whole);
  const double other = clamped_share(ew + share * de, ee);
  share = clamped_share(other * de - dw, dd);
  return p + share * d;
}

/** Unit normal from the second side of a pair to the first, and where they touch. */
struct Geometry {
  Vec normal, point;
};

/** The sides of a pair are on two sides of the plane with this normal, which turns as `turn` says. They come together
 * there: `gap` leads from the second to the first, and grows by `way`. */
Vec normal_of(const Vec& across, const Vec& turn, const Vec& gap, const Vec& way) {
  const double approach = dot(across, way) + dot(turn, gap);
  if (is_zero(across)) return against(Vec::Zero(), way);
  return (approach > 0 ? -1.0 : 1.0) * unit(across);
}

template <int D>
Geometry geometry_of(const WayTouch<D>& touch) {
  const Moment<D> m(touch);
  if constexpr (D == 2) {
    const Vec edge = m.at[2] - m.at[1], edge_way = m.way[2] - m.way[1];
    return {normal_of(turned(edge), turned(edge_way), m.at[0] - m.at[1], m.way[0] - m.way[1]), m.at[0]};
  } else if (touch.pair.kind == PairKind::kVertexFace) {
    const Vec e = m.at[2] - m.at[1], f = m.at[3] - m.at[1], we = m.way[2] - m.way[1], wf = m.way[3] - m.way[1];
    const Vec turn = we.cross(f) + e.cross(wf);
    return {normal_of(e.cross(f), turn, m.at[0] - m.at[1], m.way[0] - m.way[1]), m.at[0]};
  } else {
    const Vec e = m.at[1] - m.at[0], f = m.at[3] - m.at[2], we = m.way[1] - m.way[0], wf = m.way[3] - m.way[2];
    const Vec turn = we.cross(f) + e.cross(wf);
    return {normal_of(e.cross(f), turn, m.at[0] - m.at[2], m.way[0] - m.way[2]),
            nearest_on_first(m.at[0], m.at[1], m.at[2], m.at[3])};
  }
}

template <int D>
void name_feature(const Environment<D>& env, const WallFeature& wall, dsw_contact& contact) {
  const bool is_marked_vertex = wall.count == 1 && vertex_marked(env, wall.vertices[0]);
  const uint32_t named = wall.count == D ? 0 : wall.count;  // a whole facet has its name
  name_obstacle(env, {wall.facet, wall.cell, wall.vertices, named, is_marked_vertex ? DSW_CELL_VERTEX : DSW_CELL_EDGE},
                contact);
}

/** A contact as one side of a touch has it. */
template <int D>
struct OneSide {
  const Trajectory<D>& of;
  Simplex part;
  const Partner<D>* other;  // null: the environment
  Simplex other_part;
};

template <int D>
void place_at(const Trajectory<D>& of, uint32_t v, double time, double* place) {
  point_at<D>(of.start(v), of.end(v), time, place);
}

template <int D>
dsw_body_contact contact_of(const Environment<D>& env, const OneSide<D>& side, const WayTouch<D>& touch,
                            const Geometry& geometry) {
  const Trajectory<D>& of = side.of;
  const Body<D>& body = *of.motion.body;
  const double time = touch.first.time;
  const SimplexCorners<D> corners(body, side.part);
  uint32_t v = kNone;
  for (const uint32_t each : corners) {
    if (of.moves(each)) v = std::min(v, each);
  }
  dsw_body_contact contact{};
  contact.vertex = vertex_id(body, v);
  std::copy_n(of.start(v), D, contact.from);
  std::copy_n(of.end(v), D, contact.to);
  contact.time = time;
  place_at(of, v, time, contact.position);
  store<D>(geometry.point, contact.point);
  store<D>(geometry.normal + Vec::Zero(), contact.contact.normal);  // never -0
  if (side.part.kind == Simplex::kEdge) {
    contact.edge = edge_id(body, side.part.index);
    place_at(of, body.edges[side.part.index].other(v), time, contact.fixed[0]);
    contact.edge_parameter = share_along<D>(contact.position, contact.fixed[0], contact.point);
  } else if (side.part.kind == Simplex::kFace) {
    contact.face = face_id(body, side.part.index);
    place_at(of, body.faces[side.part.index].after(v), time, contact.fixed[0]);
    place_at(of, body.faces[side.part.index].before(v), time, contact.fixed[1]);
  }
  if (side.other == nullptr) {
    name_feature(env, touch.wall, contact.contact);
    return contact;
  }
  contact.contact.front = volume_id(env.map, body.vertices[v].cell);
  contact.contact.kind = contact_kind(side.other_part.kind);
  return contact;
}

template <int D>
dsw_contact_partner partner_of(const OneSide<D>& side) {
  return side.other == nullptr ? dsw_contact_partner{} : name_partner(*side.other, side.other_part);
}

}  // namespace

template <int D>
void describe_touches(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& touches) {
  std::sort(touches.begin(), touches.end(),
            [](const WayTouch<D>& a, const WayTouch<D>& b) { return name_of(a) < name_of(b); });
  for (const WayTouch<D>& touch : touches) {
    const Geometry geometry = geometry_of(touch);
    const auto add = [&](uint32_t number, const OneSide<D>& side, double sign) {
      const SimplexCorners<D> corners(*side.of.motion.body, side.part);
      if (std::none_of(corners.begin(), corners.end(), [&](uint32_t v) { return side.of.moves(v); })) return;
      const Geometry turned_to{sign * geometry.normal, geometry.point};
      trajectories[number].record->add(contact_of(env, side, touch, turned_to), partner_of(side));
    };
    const double sign = touch.comes_first ? 1 : -1;
    const OneSide<D> one{trajectories[touch.trajectory], touch.part, touch.other, touch.other_part};
    add(touch.trajectory, one, sign);
    if (touch.other_trajectory == kNone) continue;
    const Trajectory<D>& other = trajectories[touch.other_trajectory];
    add(touch.other_trajectory, {other, touch.other_part, &trajectories[touch.trajectory].name, touch.part}, -sign);
  }
}

template <int D>
dsw_wall_contact describe_wall(const Environment<D>& env, const Array<Trajectory<D>>& trajectories,
                               const WayTouch<D>& touch) {
  const Trajectory<D>& of = trajectories[touch.trajectory];
  const SimplexCorners<D> corners(*of.motion.body, touch.part);
  Geometry geometry = geometry_of(touch);
  if (!touch.comes_first) geometry.normal *= -1;
  const uint32_t first_wall = touch.comes_first ? corners.count : 0;
  dsw_wall_contact contact{};
  std::copy_n(touch.pair.start[first_wall], D, contact.from);
  std::copy_n(touch.pair.end[first_wall], D, contact.to);
  contact.time = touch.first.time;
  store<D>(geometry.point, contact.point);
  store<D>(geometry.normal + Vec::Zero(), contact.contact.normal);  // never -0
  name_feature(env, touch.wall, contact.contact);
  if (touch.part.kind == Simplex::kEdge) {
    double ends[2][D];
    for (uint32_t i = 0; i < 2; ++i) place_at(of, corners.vertices[i], touch.first.time, ends[i]);
    contact.edge_parameter = share_along<D>(ends[0], ends[1], contact.point);
  }
  const auto id_of = [&](uint32_t v) { return dsw_vertex_id{v, env.map.vertex_generation(v)}; };
  contact.moving = id_of(touch.wall.vertices[0]);
  for (uint32_t i = 1; i < touch.wall.count; ++i) contact.others[i - 1] = id_of(touch.wall.vertices[i]);
  contact.response = DSW_WALL_STOP;
  return contact;
}

DSW_INSTANTIATE(describe_wall);
template void describe_touches(const Environment<2>&, Array<Trajectory<2>>&, Array<WayTouch<2>>&);
template void describe_touches(const Environment<3>&, Array<Trajectory<3>>&, Array<WayTouch<3>>&);

}  // namespace dsw
