#include "walls/rigid_push.h"

#include "base/dimensions.h"
#include "base/eigen.h"
#include "base/points.h"
#include "base/position.h"
#include "response/touched_planes.h"

namespace dsw {
namespace {

constexpr int kMostInARow = 16;  // pushes of one body by one vertex
constexpr int kMostTurns = 2;    // of those: more would rock a body that is touched in two places

}  // namespace

template <int D>
Vec way_out(const WallHit& touch, const double* from, const double* to, double radius, int pushes) noexcept {
  const Vec way = difference<D>(to, from), normal = to_vec<D>(touch.end_normal), left = touch.left * way;
  const double size = std::max(largest(to_vec<D>(touch.point)), largest(to_vec<D>(to)));
  const double last_places = std::ldexp(std::max(size * 0x1p-51, 0x1p-1073), std::max(0, pushes - 4));
  const double room = 0x1p-31 * length(way) + 0x1p-30 * radius + last_places, depth = dot(left, normal);
  // What is in the way by no more than rounding, or than a push out of another wall, is not carried along.
  if (depth <= 8 * room) return (depth + room) * normal;
  return left + room * normal;
}

template <int D>
RigidPushes<D>::RigidPushes(const Body<D>& body, const double* at, const Vec& normal, const Vec& way, bool sticks)
    : now_(body.shape[0].moved), normal_(normal), way_(way), depth_(dot(normal, way)), sticks_(sticks) {
  double centre[D], size = 0, count = 0;
  now_.centre_now(centre);
  arm_ = difference<D>(at, centre);
  for (const BodyVertex<D>& vertex : body.vertices) {
    if (!vertex.cell.valid()) continue;
    for (int k = 0; k < D; ++k) size = std::max(size, std::fabs(vertex.position[k] - centre[k]));
    ++count;
  }
  if (!(size > 0) || !std::isfinite(size) || !(depth_ > 0)) return;
  double t[3][3];
  find_inertia(body, to_vec<D>(centre), size, 1, 0x1p-10 * count, t);
  Eigen::Matrix3d inertia;
  inertia << t[0][0], t[1][0], t[2][0], t[1][0], t[1][1], t[2][1], t[2][0], t[2][1], t[2][2];
  const Vec lever = arm_ / size, torque = lever.cross(normal);
  const Eigen::Vector3d turned = inertia.inverse() * Eigen::Vector3d(torque.data());
  const Vec spin(turned.x(), turned.y(), turned.z());
  const double mobility = 1 / count + dot(torque, spin), impulse = depth_ / mobility;
  spin_ = impulse / size * spin;
  shift_ = impulse / count * normal;
  // No more than half a radian at once.
  const double angle = length(spin_);
  if (std::isfinite(angle) && angle > 0 && std::isfinite(length(shift_))) turn_ = std::min(1.0, 0.5 / angle);
}

template <int D>
bool RigidPushes<D>::get(int k, RigidMotion<D>& moved) const noexcept {
  const double part = k == 0 ? 0 : turn_ / (1 << (k - 1));
  if (part == 0 && k != 0) return false;
  // Half of the rotation vector, beside 1: an angle a little smaller, without a sine.
  const Vec half = part / 2 * spin_;
  double turn[4] = {half.x(), half.y(), half.z(), 1};
  normalise(turn);
  RigidMotion<3> about;
  std::copy_n(turn, 4, about.rotation);
  Vec arm = arm_;
  about.place(arm.data(), arm.data());
  Vec shift = part * shift_ + (1 - part) * way_;
  if (sticks_) {
    shift = way_ - (arm - arm_);
  } else {
    const double missing = depth_ - dot(normal_, arm - arm_ + shift);
    if (missing > 0) shift = shift + missing * normal_;
  }
  double by[D];
  store<D>(shift, by);
  moved = now_;
  moved.add(turn, by);
  return true;
}

template <int D>
bool find_places(const Body<D>& body, const RigidMotion<D>& moved, Array<double>& places) {
  places.resize(D * body.vertices.size());
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    moved.place(rest_of(body.shape[0], v), &places[D * size_t{v}]);
    if (!is_finite<D>(&places[D * size_t{v}])) return false;
  }
  return true;
}

template <int D>
RigidPush<D>::RigidPush(const Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around)
    : env_(env), all_(all), around_(around) {}

template <int D>
bool RigidPush<D>::push(const WallHit& hit, const WallSweep<D>& walls, StarSweep<D>& sweeps, const double* from,
                        const double* to) {
  Body<D>& body = *all_.bodies[hit.feature.owner].body;
  keep_shape(body);
  before_.assign(body.vertices.begin(), body.vertices.end());
  const RigidMotion<D> before = body.shape[0].moved;
  for (int kind = 0; kind < RigidPushes<D>::kCount; ++kind) {
    if (go_out(hit, kind, walls, sweeps, from, to) && around_.note_body(hit.feature.owner)) return true;
    body.shape[0].moved = before;
    put_vertices(body, before_.data());
  }
  return false;
}

/** Moves a body by motions of a kind until the walls do not touch it; whether they do not. */
template <int D>
bool RigidPush<D>::go_out(const WallHit& first, int kind, const WallSweep<D>& walls, StarSweep<D>& sweeps,
                          const double* from, const double* to) {
  const uint32_t owner = first.feature.owner;
  Body<D>& body = *all_.bodies[owner].body;
  WallHit hit = first;
  for (int round = 0; round < kMostInARow; ++round) {
    measure(env_, all_, from, to, hit);
    const Vec way = way_out<D>(hit, from, to, body.radius, round);
    const RigidPushes<D> pushes(body, hit.point, to_vec<D>(hit.end_normal), way, true);
    RigidMotion<D> moved;
    const bool turns = round < kMostTurns && pushes.get(kind, moved);
    if (!turns && (round == 0 || !pushes.get(0, moved))) return false;
    if (!find_places(body, moved, targets_)) return false;
    // Perhaps for want of cells: those that only this body gets to have not been opened.
    if (!go(owner, sweeps) && !(open_ways(owner) && go(owner, sweeps))) return false;
    body.shape[0].moved = moved;
    if (!find_first(owner, walls, from, to, &hit)) return true;
  }
  return false;
}

/** Moves all vertices to their targets, one after the other; if one can't go, the body has moved only in part. */
template <int D>
bool RigidPush<D>::go(uint32_t owner, StarSweep<D>& sweeps) {
  Body<D>& body = *all_.bodies[owner].body;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    const double* const to = &targets_[D * size_t{v}];
    if (!body.has_vertex(v) || is_same_place<D>(to, body.position(v))) continue;
    Cell cell;
    if (!sweeps.is_free(body, v, to, &cell)) return false;
    put_vertex(body, v, to, cell);
  }
  return true;
}

/** The first touch of a body by the walls on their way; whether there is one. */
template <int D>
bool RigidPush<D>::find_first(uint32_t owner, const WallSweep<D>& walls, const double* from, const double* to,
                              WallHit* first) const {
  bool any = false;
  for_each_simplex(*all_.bodies[owner].body, [&](const Simplex& each) {
    WallHit hit;
    if (!walls.meets(all_, {owner, each}, from, to, &hit) || (any && !(hit < *first))) return true;
    *first = hit;
    any = true;
    return true;
  });
  return any;
}

/** Lets the cells be entered that the body can meet on its way to the targets; whether there are any that could not. */
template <int D>
bool RigidPush<D>::open_ways(uint32_t owner) {
  const Body<D>& body = *all_.bodies[owner].body;
  bool any = false;
  for_each_simplex(body, [&](const Simplex& each) {
    Box<D> box;
    for (const uint32_t v : SimplexCorners<D>(body, each)) {
      box.add(body.position(v));
      box.add(&targets_[D * size_t{v}]);
    }
    any = around_.open_reach({owner, each}, widened(box, body.radius)) || any;
    return true;
  });
  return any;
}

template class RigidPushes<2>;
template class RigidPushes<3>;
template class RigidPush<2>;
template class RigidPush<3>;
DSW_INSTANTIATE(find_places);
DSW_INSTANTIATE(way_out);

}  // namespace dsw
