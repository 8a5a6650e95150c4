#include "plane_shift.h"

#include <algorithm>
#include <cfloat>

namespace dsw::oracle {
namespace {

using Rational = mpq_class;
using Point = std::array<Rational, 2>;

constexpr int kMostBits = 3000;

Rational cross(const Point& x, const Point& y) { return x[0] * y[1] - x[1] * y[0]; }
Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1]}; }
bool inside(const Rational& t) { return sgn(t) > 0 && t < 1; }
Rational power_of_two(int exponent) {
  const Big power = Big(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(Big(1), power) : Rational(power);
}

/// Highest and lowest bits of coordinates, and of 1.
struct Range {
  int high = 0, low = 0;
  void see(double x) {
    if (x == 0) return;
    high = std::max(high, std::ilogb(x));
    low = std::min(low, lowest_exponent(x));
  }
};

struct Meeting {
  int side = -1, vertex = -1;
  Rational time;
};

class Shift {
 public:
  Shift(const plane::World& world, const std::vector<int>& obstacles, const Sweep& sweep)
      : world_(world), obstacles_(obstacles) {
    Range range;
    for (const plane::Vec& p : world.points) range.see(p[0]), range.see(p[1]);
    for (const Vec* p : {&sweep.from, &sweep.to, &sweep.fixed}) range.see((*p)[0]), range.see((*p)[1]);
    bits_ = 100 + 8 * (range.high - range.low + 2) + 4 * (range.high - range.low);
    if (bits_ > kMostBits) return;
    const Rational e = power_of_two(-bits_);
    const auto moved = [&](const Vec& p) { return Point{Rational(p[0]) + e, Rational(p[1]) + e * e}; };
    p_ = moved(sweep.from);
    to_ = moved(sweep.to);
    q_ = moved(sweep.fixed);
  }
  bool too_long() const { return bits_ > kMostBits; }
  Rational precision() const { return power_of_two(-bits_ / 2); }

  bool start_free() const { return met(p_, q_, false).empty(); }
  bool new_edge_hit() const { return !met(to_, q_, false).empty(); }
  std::vector<Meeting> path() const { return met(p_, to_, true); }
  /// What the inside of the edge meets.
  std::vector<Meeting> inside_met() const {
    std::vector<Meeting> list;
    const Point u = minus(to_, p_), back = minus(p_, q_);
    for (int v : obstacles_) {
      const Point d = minus(at(v), q_);
      const Rational across = cross(d, u);
      if (sgn(across) == 0) continue;
      // Where the line from q through the vertex crosses the path: beyond the vertex.
      const Rational reach = cross(back, u) / across, time = cross(back, d) / across;
      if (reach > 1 && inside(time)) list.push_back({-1, v, time});
    }
    return list;
  }

 private:
  Point at(int v) const {
    const plane::Vec& p = world_.points[static_cast<size_t>(v)];
    return {Rational(p[0]), Rational(p[1])};
  }
  std::vector<Meeting> met(const Point& x, const Point& y, bool from_inside) const {
    std::vector<Meeting> list;
    const Point u = minus(y, x);
    for (size_t s = 0; s < world_.sides.size(); ++s) {
      const plane::Side& side = world_.sides[s];
      if (!world_.impassable(side)) continue;
      const Point w = minus(at(side.b), at(side.a)), a = minus(at(side.a), x);
      const Rational across = cross(u, w);
      if (sgn(across) == 0 || (from_inside && side.cell[sgn(across) > 0 ? 0 : 1] < 0)) continue;
      const Rational time = cross(a, w) / across;
      if (inside(time) && inside(cross(a, u) / across)) list.push_back({static_cast<int>(s), -1, time});
    }
    return list;
  }

  const plane::World& world_;
  const std::vector<int>& obstacles_;
  int bits_ = 0;
  Point p_, to_, q_;
};

}  // namespace

std::string differs_by_small_shift(const plane::World& world, const std::vector<int>& obstacles, const Sweep& sweep) {
  const Shift shift(world, obstacles, sweep);
  if (shift.too_long()) return "";
  const SweepTruth& truth = sweep.truth;
  std::vector<Meeting> all = shift.path();
  if (shift.start_free() != truth.start_free) return " the edge is free by one means";
  if (all.empty() == truth.path_hit) return " the path is met by one means";
  if (shift.new_edge_hit() != truth.new_edge_hit) return " the new edge is met by one means";
  const std::vector<Meeting> more = shift.inside_met();
  all.insert(all.end(), more.begin(), more.end());
  if (all.empty() != truth.swept.empty()) return " something is met by one means";
  if (all.empty()) return "";
  const Meeting& first =
      *std::min_element(all.begin(), all.end(), [](const Meeting& x, const Meeting& y) { return x.time < y.time; });
  const SweepEvent& event = truth.swept[0];
  if (first.side != event.triangle || first.vertex != event.vertex) return " something else is met first";
  const bool early = first.time < Rational(event.time) - shift.precision();
  const bool late = event.time < 1 && first.time > Rational(std::nextafter(event.time, 2)) + shift.precision();
  return early || late ? " it is met at another time" : "";
}

}  // namespace dsw::oracle
