#pragma once
// Points of an environment on their way, some of which go a part of it only.

#include "dartsweep/deform.h"
#include "map/cell_queue.h"
#include "motion/points_way.h"
#include "together/trajectory.h"

namespace dsw {

/** Points of cells that a call meets, by numbers from 0: those that were touched, or held. Cells come first: they stay valid.
 * Throws std::bad_alloc. */
template <int D>
class HeldPoints {
 public:
  explicit HeldPoints(const Environment<D>& env)
      : env_(env), points_(env.memory), order_(env.memory), parts_(env.memory) {}

  /** Nothing is held on a way. */
  void begin(PointsWay<D>& way) noexcept {
    way_ = &way;
    points_.clear();
    order_.clear();
    any_held_ = false;
    look_at_all();
  }
  /** The ways of all points have to be looked at. */
  void look_at_all() noexcept { knows_new_ = false; }
  /** No way has to be looked at from now on. */
  void start_round() noexcept;
  uint32_t count() const noexcept { return static_cast<uint32_t>(points_.size()); }
  /** Calls visit(number) for those points of a touch that go. */
  template <class Touch, class Visit>
  void for_each(const Touch& touch, Visit visit) {
    if (touch.other != nullptr) return;
    for (uint32_t i = 0; i < touch.wall.count; ++i) {
      if (moves(touch.wall.vertices[i])) visit(add(touch.wall.vertices[i]));
    }
  }
  bool is_new(uint32_t number) const noexcept { return points_[number].is_new; }
  void set_new(uint32_t number) noexcept { points_[number].is_new = true; }
  /** Whether the way of one of these vertices has to be looked at. */
  bool has_new(const uint32_t* vertices, uint32_t vertex_count) const noexcept;
  /** A point goes a part of the way that it goes now. The host's array is kept, and then written. */
  void shorten(uint32_t number, double part);
  /** Whether any way has been shortened. */
  bool any_held() const noexcept { return any_held_; }
  /** Shortens the ways of further points, such that all cells that are met stay valid. */
  void keep_valid(const CellQueue& cells);
  /** Appends the points that do not come to where the host wants them, by vertex. */
  void add_held(Array<dsw_vertex_id>& held) const;

 private:
  struct Point {
    uint32_t vertex;
    bool is_new;
    double part;       // of its way, to which it goes
    double target[D];  // of its whole way
  };
  /** Where the number of a vertex stands in order_, or would. */
  size_t find(uint32_t vertex) const noexcept;
  bool is_at(size_t at, uint32_t vertex) const noexcept {
    return at < order_.size() && points_[order_[at]].vertex == vertex;
  }
  uint32_t add(uint32_t vertex);
  void add_all(const CellQueue& cells);
  bool moves(uint32_t vertex) const noexcept;
  void set_part(Point& point, double part);

  const Environment<D>& env_;
  PointsWay<D>* way_ = nullptr;
  Array<Point> points_;
  Array<uint32_t> order_;  // their numbers, by vertex
  Array<double> parts_;    // scratch
  bool knows_new_ = false;
  bool any_held_ = false;
};

/** Stands for HeldPoints in an environment that stands still. */
struct NoPoints {
  void look_at_all() const noexcept {}
  uint32_t count() const noexcept { return 0; }
  template <class Touch, class Visit>
  void for_each(const Touch&, Visit) const noexcept {}
  static constexpr bool any_held() noexcept { return false; }
  bool is_new(uint32_t) const noexcept { return false; }
  bool has_new(const uint32_t*, uint32_t) const noexcept { return false; }
  void set_new(uint32_t) const noexcept {}
  void shorten(uint32_t, double) const noexcept {}
};

}  // namespace dsw
