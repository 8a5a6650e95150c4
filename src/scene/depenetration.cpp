// Two ways are tried. First vertices that lie behind walls are put on the right side, from neighbour to neighbour, and
// parts that still cross something are pushed out in rounds, each by what is left of its depth. Then the body moves as a
// whole, in directions of which one is at most 28 degrees from any direction (the plane: 23): a convex body that has to
// go d to leave another one goes d / cos(28 degrees) at most. Doubles propose places; exact tests alone accept them.

#include "scene/depenetration.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "base/search.h"
#include "body/simplices.h"
#include "locate/bounded_flood.h"
#include "locate/locate.h"
#include "proximity/thick_sweep.h"
#include "scene/meeting.h"
#include "scene/penetrations.h"
#include "scene/right_side.h"
#include "sweep/body_probe.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr uint32_t kRounds = 64;  // of pushes
constexpr double kMargin = kPenetrationMargin;
constexpr int kFirstStep = -30, kLastStep = 0;  // exponents of tried lengths, as shares of the largest
constexpr int kBisections = 7;

template <int D>
class Depenetration {
 public:
  Depenetration(Scene<D>& scene, const Body<D>& start, double limit)
      : scene_(scene),
        env_(scene.env),
        work_(start),
        limit_(limit),
        best_(scene.memory),
        inside_(scene.memory),
        first_(scene.memory),
        found_(scene.memory),
        left_(scene.memory),
        partners_(scene.memory),
        notes_(scene.memory) {}

  bool run(Cell side);
  Body<D>&& body() { return std::move(best_[0]); }
  double distance() const { return best_distance_; }
  /** Two vertices of each part that the best round could not free. */
  const Array<uint32_t>& left() const { return left_; }

 private:
  void relax();
  void note_left();
  void push(const CrossedPart<D>& each);
  void push_from_wall(const CrossedPart<D>& each);
  void push_off(const CrossedPart<D>& each);
  void push_off_spike(const CrossedPart<D>& each);
  void push_from_body(const CrossedPart<D>& each);
  void shift(uint32_t v, const Vec& by) { side_.shift(v, by); }

  void translate();
  bool is_free_at(const Vec& by);
  bool is_free();
  double largest_step();
  void accept(double distance);
  double displacement() const;

  Scene<D>& scene_;
  const Environment<D>& env_;
  Body<D> work_;
  double limit_, smallest_ = 0;  // smallest_: what a place stays off walls
  double best_distance_ = 0;
  Array<Body<D>> best_;         // one, once it is free
  Array<bool> inside_;          // by vertex: in a passable cell of the right side
  Array<BodyVertex<D>> first_;  // vertices where they began
  Array<CrossedPart<D>> found_;
  Array<uint32_t> left_;
  Partners<D> partners_;
  BoundedNotes notes_;
  BodyProbe<D> probe_{scene_.env, Obstacle::kCells};
  ThickSweep<D> thick_{scene_.env};
  RightSide<D> side_{scene_.env, work_, inside_};
};

template <int D>
bool Depenetration<D>::run(Cell side) {
  find_cells(scene_, work_, inside_);
  Box<D> box;
  for (const BodyVertex<D>& each : work_.vertices) {
    if (each.cell.valid()) box.add(each.position);
  }
  if (box.empty()) return false;
  smallest_ =
      0x1p-30 * length(difference<D>(box.upper, box.lower)) + 0x1p-48 * largest_coordinate<D>(box.lower, box.upper);
  if (scene_.keeps_boxes()) keep_boxes(work_);
  find_penetrations(scene_, work_, inside_, found_);
  if (found_.empty()) {  // its surroundings have changed
    accept(0);
    return true;
  }
  note_left();
  const bool crosses_bodies =
      dsw::any_of(found_.begin(), found_.end(), [](const CrossedPart<D>& each) { return each.other.body != nullptr; });
  side_.choose(side, smallest_);
  first_.assign(work_.vertices.begin(), work_.vertices.end());
  if (!work_.is_rigid() && side_.place_all()) relax();
  if (best_.empty() || crosses_bodies) translate();
  return !best_.empty();
}

/** Pushes what crosses something, until nothing does. */
template <int D>
void Depenetration<D>::relax() {
  size_t fewest = left_.size();
  for (uint32_t round = 0; round < kRounds; ++round) {
    find_penetrations(scene_, work_, inside_, found_);
    if (found_.empty()) {
      const double distance = displacement();
      if (distance <= limit_) accept(distance);
      return;
    }
    if (2 * found_.size() < fewest) {
      note_left();
      fewest = left_.size();
    }
    for (const CrossedPart<D>& each : found_) push(each);
  }
}

template <int D>
void Depenetration<D>::note_left() {
  left_.clear();
  for (const CrossedPart<D>& each : found_) {
    const SimplexCorners<D> corners(work_, each.part);
    left_.push_back(corners.vertices[0]);
    left_.push_back(corners.vertices[corners.count > 1 ? 1 : 0]);
  }
}

template <int D>
void Depenetration<D>::push(const CrossedPart<D>& each) {
  if (each.other.body != nullptr) return push_from_body(each);
  if (each.part.kind == Simplex::kEdge && each.wall.valid()) return push_from_wall(each);
  if (each.part.kind == Simplex::kFace && each.wall.valid()) return push_off_spike(each);
  push_off(each);
}

/** Something is too near: away from the nearest wall. */
template <int D>
void Depenetration<D>::push_off(const CrossedPart<D>& each) {
  const SimplexCorners<D> corners(work_, each.part);
  const BodyVertex<D>&a = work_.vertices[corners.vertices[0]], &b = work_.vertices[corners.vertices[corners.count - 1]];
  SegmentNearest nearest;
  const double wanted = work_.radius * (1 + kMargin) + smallest_;
  if (!find_nearest_to_segment(env_, a.position, b.position, a.cell, wanted, notes_, nearest)) return;
  const Vec by = to_vec<3>(nearest.normal) * (wanted - nearest.distance);
  for (const uint32_t v : corners) shift(v, by);
}

/** An edge between two places on the right side cuts through a ridge: both ends go by the height of the ridge that the
 * walls at both sides form. */
template <int D>
void Depenetration<D>::push_from_wall(const CrossedPart<D>& each) {
  const uint32_t* const ends = work_.edges[each.part.index].ends;
  const BodyVertex<D>&a = work_.vertices[ends[0]], &b = work_.vertices[ends[1]];
  const Vec way = difference<D>(b.position, a.position), along = unit(way);
  const CastResult there = cast(env_, a.position, b.position, a.cell),
                   back = cast(env_, b.position, a.position, b.cell);
  if (there.end != CastEnd::kHit || back.end != CastEnd::kHit) return;
  const double* corner = nullptr;
  const Vec first = normal_of(env_, there, way, &corner), second = normal_of(env_, back, -way, &corner);
  const Vec out = unit(first + second);
  if (is_zero(out)) return;
  const double sine_a = std::fabs(dot(first, along)), sine_b = std::fabs(dot(second, along));
  const double cut =
      length(way) * std::max(0.0, 1 - crossing_time(env_, there.cell, there.simplex, a.position, b.position) -
                                      crossing_time(env_, back.cell, back.simplex, b.position, a.position));
  const double sine_both =
      sine_a * std::sqrt(std::max(0.0, 1 - sine_b * sine_b)) + sine_b * std::sqrt(std::max(0.0, 1 - sine_a * sine_a));
  const double height = sine_both > 0 ? std::min(cut, cut * sine_a * sine_b / sine_both) : cut;
  const Vec by = out * (height * (1 + kMargin) + smallest_ + work_.radius * kMargin);
  shift(ends[0], by);
  shift(ends[1], by);
}

/** The side of a plane on which less of something lies, as the way from there to the plane. */
Vec way_back(const Vec& normal, double lowest, double highest, double room) {
  return highest < -lowest ? normal * -(highest * (1 + kMargin) + room) : normal * (-lowest * (1 + kMargin) + room);
}

/** A wall pierces a face: the face goes by the height of the lower part of the wall. */
template <int D>
void Depenetration<D>::push_off_spike(const CrossedPart<D>& each) {
  if constexpr (D == 3) {
    const uint32_t* const c = work_.faces[each.part.index].corners;
    const Vec normal = unit(difference<3>(work_.position(c[1]), work_.position(c[0]))
                                .cross(difference<3>(work_.position(c[2]), work_.position(c[0]))));
    double lowest = 0, highest = 0;
    const Cell cell = env_.map.cell_of(each.wall);
    const Shape shape = env_.map.shape(cell);
    const uint16_t* const facets = shape.simplex_facets(3);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      if (facets[s] != env_.map.local_of(each.wall, cell)) continue;
      const double* points[3];
      boundary_points(env_, cell, s, points);
      for (const double* p : points) {
        const double height = dot(normal, difference<3>(p, work_.position(c[0])));
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
    }
    const Vec by = -way_back(normal, lowest, highest, smallest_);
    for (int k = 0; k < 3; ++k) shift(c[k], by);
  }
}

/** An edge pierces a face, in the plane an edge: what of it lies on the smaller side goes back, or the face does. Both
 * go half of the way if both are the body's own. */
template <int D>
void Depenetration<D>::push_from_body(const CrossedPart<D>& each) {
  const Body<D>& other = *each.other.body;
  const bool self = &other == &work_, is_plane_own = D == 3 && each.part.kind == Simplex::kFace;
  const Simplex& plane = is_plane_own ? each.part : each.other_part;
  const Simplex& piercing = is_plane_own ? each.other_part : each.part;
  if (plane.kind + 1 != D || piercing.kind != Simplex::kEdge) return;
  const SimplexCorners<D> corners(is_plane_own ? work_ : other, plane), ends(is_plane_own ? other : work_, piercing);
  const Body<D>&of_plane = is_plane_own ? work_ : other, &of_edge = is_plane_own ? other : work_;
  const double* const origin = of_plane.position(corners.vertices[0]);
  const Vec side = difference<D>(of_plane.position(corners.vertices[1]), origin);
  const Vec normal =
      unit(D == 2 ? turned(side) : side.cross(difference<D>(of_plane.position(corners.vertices[D - 1]), origin)));
  double heights[2];
  for (int k = 0; k < 2; ++k) heights[k] = dot(normal, difference<D>(of_edge.position(ends.vertices[k]), origin));
  if (heights[0] * heights[1] > 0) return;  // another push has parted them
  const int tip = std::fabs(heights[0]) <= std::fabs(heights[1]) ? 0 : 1;
  const double room = smallest_ + (work_.radius + other.radius) * (1 + kMargin);
  const double depth = std::fabs(heights[tip]) * (1 + kMargin) + room;
  const Vec by = normal * (heights[1 - tip] > 0 ? depth : -depth) * (self ? 0.5 : 1.0);
  if (self || !is_plane_own) shift(ends.vertices[tip], by);
  if (self || is_plane_own) {
    for (const uint32_t v : corners) shift(v, -by);
  }
}

template <int D>
double Depenetration<D>::displacement() const {
  double most = 0;
  for (uint32_t v = 0; v < first_.size(); ++v) {
    if (work_.has_vertex(v)) most = std::max(most, length(difference<D>(work_.position(v), first_[v].position)));
  }
  return most;
}

template <int D>
void Depenetration<D>::accept(double distance) {
  best_.clear();
  best_.push_back(work_);
  best_distance_ = distance;
}

template <int D>
bool Depenetration<D>::is_free() {
  const auto stop = [](uint32_t, uint32_t) { return false; };
  if (!probe_.is_free(work_, {})) return false;
  if (!scene_.features.contacts) return thick_.keep_at_rest(nullptr, work_);
  find_partners_at_rest(scene_, work_, 0, partners_);
  return is_body_apart(partners_, work_, work_.level, stop) && thick_.keep_at_rest(&partners_, work_);
}

/** Moves the whole body, as it began. The ways of vertices that are kept must be free. */
template <int D>
bool Depenetration<D>::is_free_at(const Vec& by) {
  Cell last;
  for (uint32_t pass = 0; pass < 2; ++pass) {
    for (uint32_t v = 0; v < first_.size(); ++v) {
      if (!first_[v].cell.valid() || side_.is_kept(v) != (pass == 0)) continue;
      const Vec to = to_vec<D>(first_[v].position) + by;
      if (!std::isfinite(largest(to))) return false;
      Cell cell;
      if (pass == 0) {
        const CastResult way = cast(env_, first_[v].position, to.data(), first_[v].cell);
        if (way.end != CastEnd::kReached) return false;
        cell = way.cell;
      } else {
        cell = locate(env_, to.data(), last, nullptr).cell;
        if (!cell.valid() || is_closed(env_, cell)) return false;
      }
      put_vertex(work_, v, to.data(), cell);
      last = cell;
    }
  }
  if (scene_.keeps_boxes()) tighten_bounds(work_);
  return is_free();
}

/** How far the body may have to go: to pass all that it crosses, as a whole. */
template <int D>
double Depenetration<D>::largest_step() {
  Box<D> box;
  for (const BodyVertex<D>& each : first_) {
    if (each.cell.valid()) box.add(each.position);
  }
  double most = length(difference<D>(box.upper, box.lower)) + 2 * work_.radius;
  if (scene_.features.contacts) {
    put_vertices(work_, first_.data());
    find_partners_at_rest(scene_, work_, 0, partners_);
    for (const Partner<D>& each : partners_.all) {
      const Box<D>& bounds = each.body->boxes[0].bounds;
      if (!bounds.empty()) most += length(difference<D>(bounds.upper, bounds.lower)) + 2 * each.body->radius;
    }
  }
  return std::min(most, limit_);
}

template <int D>
void Depenetration<D>::translate() {
  if (!side_.all_have_kept()) return;
  const double most = largest_step();
  bool found = false;
  for (int exponent = kFirstStep; exponent <= kLastStep && !found; exponent += 2) {
    const double step = std::ldexp(most, exponent);
    if (!best_.empty() && step / 4 >= best_distance_) return;
    for (int code = 0; code < (D == 3 ? 27 : 9); ++code) {
      const Vec direction = unit({code % 3 - 1.0, code / 3 % 3 - 1.0, D == 3 ? code / 9 - 1.0 : 0.0});
      if (is_zero(direction)) continue;
      double high = best_.empty() ? step : std::min(step, best_distance_ * (1 - 0x1p-7)), low = step / 4;
      if (!(high > 0) || !is_free_at(direction * high)) continue;
      accept(high);
      found = true;
      for (int i = 0; i < kBisections; ++i) {
        const double middle = low + (high - low) / 2;
        if (is_free_at(direction * middle)) {
          accept(high = middle);
        } else {
          low = middle;
        }
      }
    }
  }
}

}  // namespace

template <int D>
DepenetrationResult depenetrate(Scene<D>& scene, BodyRecord<D>& of, Cell inside, double limit) {
  DepenetrationResult result;
  scene.offending.clear();
  if (!of.is_penetrating()) {
    result.freed = true;
    return result;
  }
  Depenetration<D> tries(scene, of.penetrating[0], limit);
  result.freed = tries.run(inside);
  if (!result.freed) {
    scene.offending.assign(tries.left().begin(), tries.left().end());
    return result;
  }
  scene.offending.clear();
  result.distance = tries.distance();
  Body<D> freed(tries.body());
  freed.boxes.clear();
  std::swap(of.body, freed);
  try {
    prepare_body(scene, of);
  } catch (...) {
    std::swap(of.body, freed);
    throw;
  }
  of.penetrating.clear();
  note_body(scene, static_cast<uint32_t>(&of - scene.bodies.data()));
  return result;
}

DSW_INSTANTIATE(depenetrate);

}  // namespace dsw
