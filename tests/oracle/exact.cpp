#include "exact.h"

#include <algorithm>

namespace dsw::oracle {
namespace {

void take(const Vec& p, Vec& low, Vec& high) {
  for (size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

int need_of(const Vec& p) {
  int need = 0;
  for (double x : p) need = std::max(need, x == 0 ? 0 : -lowest_exponent(x));
  return need;
}

/// The standard part of a ratio of polynomials 0 <= n <= d, d > 0, is that of the coefficients where d begins.
void set_time(SweepEvent& e) {
  while (sgn(e.denominator.c[e.order]) == 0) ++e.order;
  e.time = std::min(1.0, floor_to_double(e.numerator.c[e.order], e.denominator.c[e.order]));
}

}  // namespace

int Shifted::sign() const {
  for (const Big& x : c) {
    if (sgn(x) != 0) return sgn(x);
  }
  return 0;
}

void Shifted::negate() {
  for (Big& x : c) x = -x;
}

int compare_times(const SweepEvent& a, const SweepEvent& b) {
  for (size_t degree = 0; degree <= 6; ++degree) {
    Big sum = 0;
    for (size_t i = degree < 3 ? 0 : degree - 3; i <= std::min<size_t>(degree, 3); ++i) {
      const size_t j = degree - i;
      sum += a.numerator.c[i] * b.denominator.c[j];
      sum -= b.numerator.c[i] * a.denominator.c[j];
    }
    if (sgn(sum) != 0) return sgn(sum);
  }
  return 0;
}

bool same_feature(const SweepEvent& x, const SweepEvent& y) {
  return x.triangle == y.triangle && x.a == y.a && x.b == y.b && x.vertex == y.vertex;
}

std::string name(const SweepEvent& e) {
  if (e.triangle >= 0) return "the path through triangle or side " + std::to_string(e.triangle);
  if (e.face >= 0) return "face " + std::to_string(e.face) + " on vertex " + std::to_string(e.vertex);
  const std::string on =
      e.vertex >= 0 ? "vertex " + std::to_string(e.vertex) : std::to_string(e.a) + "-" + std::to_string(e.b);
  return "edge " + std::to_string(e.edge) + " on " + on;
}

bool MoveTruth::inside_only() const {
  return !events.empty() && !path_hit && std::find(new_edge_hit.begin(), new_edge_hit.end(), 1) == new_edge_hit.end();
}

ExactSweeps::Box ExactSweeps::box_of(const std::vector<Vec>& all, std::initializer_list<int> vertices) {
  const Vec& first = all[static_cast<size_t>(*vertices.begin())];
  Box box = {first, first};
  for (int v : vertices) take(all[static_cast<size_t>(v)], box.low, box.high);
  return box;
}

void ExactSweeps::take_points(const std::vector<Vec>& all, const std::vector<int>& used) {
  // One unit is an integer too: the shift is measured in the coordinates' units.
  for (int v : used) need_ = std::max(need_, need_of(all[static_cast<size_t>(v)]));
  points_.resize(all.size());
  scaled_.resize(all.size());
  stamp_.assign(all.size(), 0);
  for (int v : used) {
    vertices_.push_back({v, box_of(all, {v})});
    for (size_t k = 0; k < 3; ++k) points_[static_cast<size_t>(v)][k] = to_big(all[static_cast<size_t>(v)][k], need_);
  }
}

void ExactSweeps::load(const std::vector<Vec>& points) {
  int need = need_;
  for (const Vec& p : points) need = std::max(need, need_of(p));
  raw_ = points;
  body_.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) body_[i][k] = to_big(points[i][k], need);
  }
  delta_ = static_cast<unsigned>(need - need_);
  unit_ = Big(1) << static_cast<unsigned>(need);
  ++now_;
  tie_ = false;
}

ExactSweeps::Box ExactSweeps::body_box(std::initializer_list<size_t> points) const {
  Box box = {raw_[*points.begin()], raw_[*points.begin()]};
  for (size_t i : points) take(raw_[i], box.low, box.high);
  return box;
}

bool ExactSweeps::apart(const Box& x, const Box& y) {
  for (size_t k = 0; k < 3; ++k) {
    if (x.high[k] < y.low[k] || y.high[k] < x.low[k]) return true;
  }
  return false;
}

const ExactSweeps::Point& ExactSweeps::at(int vertex) {
  const auto v = static_cast<size_t>(vertex);
  if (delta_ == 0) return points_[v];
  if (stamp_[v] != now_) {
    stamp_[v] = now_;
    for (size_t k = 0; k < 3; ++k) scaled_[v][k] = points_[v][k] << delta_;
  }
  return scaled_[v];
}

Shifted ExactSweeps::shifted(const Big& unshifted, const Point& coefficients) const {
  Shifted x;
  x.c[0] = unshifted;
  for (size_t k = 0; k < 3; ++k) x.c[k + 1] = coefficients[k] * unit_;
  return x;
}

int ExactSweeps::sign_with_ties(const Big& unshifted, const Point& coefficients) {
  if (sgn(unshifted) != 0) return sgn(unshifted);
  tie_ = true;
  for (const Big& c : coefficients) {
    if (sgn(c) != 0) return sgn(c);
  }
  return 0;
}

void ExactSweeps::add(SweepEvent e, std::vector<SweepEvent>& events) {
  if (e.denominator.sign() < 0) {
    e.numerator.negate();
    e.denominator.negate();
  }
  set_time(e);
  events.push_back(std::move(e));
}

bool ExactSweeps::blocked(const Vec& x, const Vec& y) {
  load({x, y});
  return any_pierced(0, 1);
}

/// Keeps the first and what has exactly its time. Whether several have its standard part: a tie too.
bool ExactSweeps::keep_first(std::vector<SweepEvent>& events) {
  std::vector<SweepEvent> first;
  for (const SweepEvent& e : events) {
    const int c = first.empty() ? 0 : compare_times(e, first[0]);
    if (c > 0) continue;
    if (c < 0) first.clear();
    first.push_back(e);
  }
  int at_once = 0;
  for (const SweepEvent& e : events) {
    if (first[0].order > 0 || e.order > 0) continue;
    at_once += first[0].numerator.c[0] * e.denominator.c[0] == e.numerator.c[0] * first[0].denominator.c[0];
  }
  events = std::move(first);
  return at_once > 1;
}

SweepTruth ExactSweeps::sweep(const Vec& from, const Vec& to, const Vec& fixed) {
  SweepTruth truth;
  truth.start = locate(from);
  load({from, to, fixed});
  truth.start_free = !any_pierced(kP, kQ);
  truth.new_edge_hit = any_pierced(kTo, kQ);
  add_path_events(truth.path);
  truth.path_hit = !truth.path.empty();
  truth.swept = truth.path;
  add_edge_events(0, truth.swept);
  keep_first(truth.path);
  const bool at_once = keep_first(truth.swept);
  truth.tie = tie_ || at_once;
  return truth;
}

MoveTruth ExactSweeps::move(const VertexMove& move, dsw_level level) {
  std::vector<Vec> points = {move.from, move.to};
  points.insert(points.end(), move.fixed.begin(), move.fixed.end());
  load(points);
  MoveTruth truth;
  add_path_events(truth.events);
  truth.path_hit = !truth.events.empty();
  if (level > DSW_LEVEL_POINTS) {
    truth.new_edge_hit.resize(move.fixed.size());
    for (size_t i = 0; i < move.fixed.size(); ++i) truth.new_edge_hit[i] = any_pierced(kTo, kQ + i) ? 1 : 0;
    for (size_t i = 0; i < move.fixed.size(); ++i) {
      if (level > DSW_LEVEL_EDGES || truth.path_hit || truth.new_edge_hit[i] != 0) add_edge_events(i, truth.events);
    }
  }
  if (level == DSW_LEVEL_FACES) {
    for (size_t i = 0; i < move.faces.size(); ++i) add_face_events(i, move.faces[i], truth.events);
  }
  const bool at_once = keep_first(truth.events);
  truth.tie = tie_ || at_once;
  return truth;
}

}  // namespace dsw::oracle
