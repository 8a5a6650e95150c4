// Each touched pair becomes a plane between its nearest points, which goes along with the wall. What is left of a motion is projected
// on what the planes allow, and that is the next motion: it makes the same share of its way as the environment does.

#include "scene/motions_left.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/search.h"
#include "predicates/hull_gap.h"
#include "scene/rigid_moves.h"

namespace dsw {
namespace {

/** The part that a contact names. */
template <class Named>
Simplex part_of(const Named& named) noexcept {
  if (named.face.generation != 0) return {Simplex::kFace, named.face.index};
  if (named.edge.generation != 0) return {Simplex::kEdge, named.edge.index};
  return {Simplex::kVertex, named.vertex.index};
}

/** Across a face, or across two edges; in the plane across an edge. Zero if there is none. */
template <int D>
Vec across(const ConvexHull& a, const ConvexHull& b) noexcept {
  const auto side = [](const ConvexHull& hull, uint32_t i) { return difference<D>(hull.points[i], hull.points[0]); };
  if (D == 2) return a.count == 2 ? unit(turned(side(a, 1))) : b.count == 2 ? unit(turned(side(b, 1))) : Vec::Zero();
  if (a.count == 2 && b.count == 2) return unit(unit(side(a, 1)).cross(unit(side(b, 1))));
  const ConvexHull& face = a.count == 3 ? a : b;
  return face.count == 3 ? unit(unit(side(face, 1)).cross(unit(side(face, 2)))) : Vec::Zero();
}

template <int D>
Vec nearest_point(const ConvexHull& hull, const double* weights) noexcept {
  Vec point = Vec::Zero();
  for (uint32_t i = 0; i < hull.count; ++i) point += weights[i] * to_vec<D>(hull.points[i]);
  return point;
}

}  // namespace

template <int D>
MotionsLeft<D>::MotionsLeft(Scene<D>& scene, const Environment<D>& env, BodyRecord<D>* const* bodies,
                            const RigidMove<D>* motions, size_t count)
    : scene_(scene),
      env_(env),
      bodies_(bodies),
      count_(count),
      ends_(scene.memory),
      made_(scene.memory),
      targets_(scene.memory),
      pairs_(scene.memory) {
  for (size_t i = 0; i < count; ++i) {
    const Body<D>& body = bodies[i]->body;
    ends_.push_back(motions[i].part(1));
    RigidMotion<D>& made = made_.emplace_back();
    std::copy_n(ends_[i].centre, D, made.centre);
    Array<double>& targets = targets_.emplace_back(D * body.vertices.size(), 0.0, scene.memory);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) ends_[i].place(body.position(v), &targets[D * size_t{v}]);
    }
    pairs_.emplace_back(scene.memory);
  }
}

template <int D>
void MotionsLeft<D>::follow(const RigidMove<D>* motions, double fraction) {
  for (size_t i = 0; i < count_; ++i) {
    const RigidMotion<D> part = motions[i].part(fraction);
    made_[i].add_about(part.rotation, part.centre, part.translation);
  }
}

template <int D>
bool MotionsLeft<D>::note(const Array<dsw_wall_contact>& walls) {
  bool can_go = true;
  for (const dsw_wall_contact& contact : walls) {
    size_t i = 0;
    const auto is_it = [&](const BodyRecord<D>& of) {
      return contact.body.generation != 0 && &of == &scene_.bodies[contact.body.index];
    };
    while (i < count_ && !is_it(*bodies_[i])) ++i;
    can_go = can_go && i < count_;
    if (i == count_) continue;
    Pair pair{part_of(contact), {}, kNone, {}, 0, to_vec<3>(contact.contact.normal)};
    for (const dsw_vertex_id corner : {contact.moving, contact.others[0], contact.others[1]}) {
      if (corner.generation != 0) pair.corners[pair.count++] = corner.index;
    }
    add(i, pair);
  }
  for (size_t i = 0; i < count_; ++i) {
    const MoveRecord& record = bodies_[i]->next;
    for (size_t k = 0; k < record.partners.size(); ++k) {
      const dsw_contact_partner& partner = record.partners[k];
      if (partner.body.generation == 0) continue;
      add(i, {part_of(record.contacts[k]),
              part_of(partner),
              partner.body.index,
              {},
              0,
              to_vec<3>(record.contacts[k].contact.normal)});
    }
  }
  return can_go;
}

/** What is touched again goes to the end: the oldest are forgotten first. */
template <int D>
void MotionsLeft<D>::add(size_t i, const Pair& pair) {
  constexpr size_t kMost = 12;
  Array<Pair>& pairs = pairs_[i];
  const auto is_same = [&](const Pair& each) {
    return each.part.kind == pair.part.kind && each.part.index == pair.part.index && each.other == pair.other &&
           each.other_part.kind == pair.other_part.kind && each.other_part.index == pair.other_part.index &&
           each.count == pair.count && std::equal(pair.corners, pair.corners + pair.count, each.corners);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_same), pairs.end());
  if (pairs.size() == kMost) pairs.erase(pairs.begin());
  pairs.push_back(pair);
}

template <int D>
PlainMotion MotionsLeft<D>::left(size_t i) const noexcept {
  return motion_left(ends_[i], made_[i]);
}

template <int D>
void MotionsLeft<D>::add_plane(const Body<D>& body, const Pair& pair, double share, const double* next,
                               TouchedPlanes<D>& planes) const {
  constexpr double kNear = 0x1p-20, kOff = 0x1p-32, kMostMissing = 0x1p-29;
  ConvexHull mine, other;
  const auto add_corners = [](const Body<D>& of, const Simplex& part, ConvexHull& hull) {
    for (const uint32_t v : SimplexCorners<D>(of, part)) hull.points[hull.count++] = of.position(v);
  };
  add_corners(body, pair.part, mine);
  double radii = body.radius;
  for (uint32_t k = 0; k < pair.count; ++k) other.points[other.count++] = env_.point(pair.corners[k]);
  if (pair.other != kNone) {
    const Body<D>& partner = scene_.bodies[pair.other].body;
    add_corners(partner, pair.other_part, other);
    radii += partner.radius;
  }
  const HullGap gap = find_gap<D>(mine, other, std::numeric_limits<double>::infinity(), 0);
  double size = 0, turn = 0;
  Vec way = Vec::Zero();
  const auto way_of = [&](uint32_t k) {
    return share * difference<D>(next + size_t{D} * pair.corners[k], env_.point(pair.corners[k]));
  };
  for (uint32_t i = 1; i < mine.count; ++i)
    size = std::max(size, length(difference<D>(mine.points[i], mine.points[0])));
  for (uint32_t k = 0; k < pair.count; ++k) {
    way += gap.other_weights[k] * way_of(k);
    if (k == 0) continue;
    const double side = length(difference<D>(other.points[k], other.points[0]));
    size = std::max(size, side);
    if (side > 0) turn = std::max(turn, length(way_of(k) - way_of(0)) / side);
  }
  // The nearest points of what nearly touches say nothing of the direction.
  Vec normal = gap.distance > kNear * size ? gap.normal : across<D>(mine, other);
  if (is_zero(normal)) normal = is_zero(gap.normal) ? pair.normal : gap.normal;
  if (dot(normal, pair.normal) < 0 && !(gap.distance > kNear * size)) normal = -normal;
  const Vec at = nearest_point<D>(other, gap.other_weights) + radii * (1 + kOff) * normal;
  const Vec point = nearest_point<D>(mine, gap.weights);
  // What has lost some of its distance gets it back. Across a short gap the normal may be another one, and tell too much.
  const double missing = std::clamp(dot(normal, at - point), 0.0, kMostMissing * radii);
  planes.add_moving(normal, at, point, way, turn, missing);
}

/** Whoever has touched nothing goes on. Whoever may go nowhere waits. */
template <int D>
Allowed MotionsLeft<D>::propose_one(size_t i, double share, const double* next, PlainMotion* motion) const {
  const PlainMotion whole = left(i);
  const RigidMotion<D> part = RigidMove<D>(whole.rotation, whole.centre, whole.translation).part(share);
  *motion = whole;
  if (share < 1) {
    std::copy_n(part.rotation, 4, motion->rotation);
    std::copy_n(part.translation, D, motion->translation);
  }
  if (pairs_[i].empty()) return Allowed::kFound;
  const Body<D>& body = bodies_[i]->body;
  TouchedPlanes<D> planes;
  for (const Pair& each : pairs_[i]) add_plane(body, each, share, next, planes);
  const Allowed allowed = find_allowed(body, Inertia<D>(body), planes, whole, share, motion);
  if (allowed != Allowed::kNothing) return allowed;
  *motion = PlainMotion();
  std::copy_n(whole.centre, 3, motion->centre);
  return Allowed::kFound;
}

template <int D>
double MotionsLeft<D>::propose(double share, const double* next, Array<RigidMove<D>>& motions) const {
  constexpr int kMostHalvings = 24;
  for (int halvings = 0; halvings < kMostHalvings; ++halvings, share *= 0.5) {
    motions.clear();
    while (motions.size() < count_) {
      PlainMotion motion;
      if (propose_one(motions.size(), share, next, &motion) == Allowed::kTooFar) break;
      motions.push_back({motion.rotation, motion.centre, motion.translation});
    }
    if (motions.size() == count_) return share;
  }
  return 0;
}

template class MotionsLeft<2>;
template class MotionsLeft<3>;

}  // namespace dsw
