#include "swept_truth.h"

#include <algorithm>
#include <climits>
#include <cmath>

namespace dsw::swept {

using oracle::lowest_exponent;
using oracle::to_big;

namespace {

using Point = std::array<Big, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Big dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// value + shift.s, where s is (e, e^2, e^3) of length `unit`.
Poly linear(const Big& value, const Point& shift, const Big& unit) {
  Poly r;
  r.c[0] = value;
  for (size_t k = 0; k < 3; ++k) r.c[k + 1] = shift[k] * unit;
  return r;
}

}  // namespace

int Poly::sign() const {
  for (const Big& each : c) {
    if (sgn(each) != 0) return sgn(each);
  }
  return 0;
}

Poly operator-(const Poly& a, const Poly& b) {
  Poly r;
  for (size_t i = 0; i < r.c.size(); ++i) r.c[i] = a.c[i] - b.c[i];
  return r;
}

Poly operator*(const Poly& a, const Poly& b) {
  Poly r;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) r.c[i + j] += a.c[i] * b.c[j];
  }
  return r;
}

int compare(const Moment& a, const Moment& b) {
  return (a.numerator * b.denominator - b.numerator * a.denominator).sign();
}

SweptTruth::SweptTruth(const Environment<3>& env) : env_(env) {
  const Map<3>& map = env.map;
  std::set<std::array<uint32_t, 3>> seen;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      if (!is_impassable(map, map.half_facet(c, f))) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        std::array<uint32_t, 3> v{};
        for (uint32_t k = 0; k < 3; ++k) v[k] = map.vertex(c, shape.simplices()[3 * s + k]);
        std::array<uint32_t, 3> name = v;
        std::sort(name.begin(), name.end());
        if (!seen.insert(name).second) continue;
        triangles.push_back(v);
        vertices.insert(v.begin(), v.end());
        for (size_t k = 0; k < 3; ++k) lines.insert({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])});
      }
    }
  }
  Array<uint64_t> keys;
  env.edge_marks.copy_sorted(keys);
  for (const uint64_t key : keys) {
    const Line line{static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key)};
    lines.insert(line);
    vertices.insert(line.begin(), line.end());
  }
  for (uint32_t v = 0; v < map.vertex_count; ++v) {
    if (!env.vertex_marks.empty() && (env.vertex_marks[v / 64] >> (v % 64) & 1u) != 0) vertices.insert(v);
    for (int k = 0; k < 3; ++k) {
      const int low = lowest_exponent(env.point(v)[k]);
      if (low != INT_MAX) need_ = std::max(need_, -low);
    }
  }
  for (uint32_t v = 0; v < map.vertex_count; ++v) {
    fixed_.push_back({});
    for (size_t k = 0; k < 3; ++k) fixed_.back()[k] = to_big(env.point(v)[k], need_);
  }
}

void SweptTruth::load(const double* const* at, int count) {
  raw_.assign(at, at + count);
  shift_ = need_;
  for (const double* x : raw_) {
    for (size_t k = 0; k < 3; ++k) {
      const int low = lowest_exponent(x[k]);
      if (low != INT_MAX) shift_ = std::max(shift_, -low);
    }
  }
  unit_ = to_big(1.0, shift_);
  body_.clear();
  for (const double* x : raw_) body_.push_back({to_big(x[0], shift_), to_big(x[1], shift_), to_big(x[2], shift_)});
}

SweptTruth::Point SweptTruth::at(uint32_t vertex) const {
  Point p = fixed_[vertex];
  for (Big& x : p) x <<= static_cast<unsigned>(shift_ - need_);
  return p;
}

/// Whether the boxes of some body points and of some vertices have no point in common.
bool SweptTruth::apart(std::initializer_list<int> body, const uint32_t* vertices_of, int count) const {
  for (int k = 0; k < 3; ++k) {
    double low = HUGE_VAL, high = -HUGE_VAL, least = HUGE_VAL, most = -HUGE_VAL;
    for (const int b : body) {
      low = std::min(low, raw_[static_cast<size_t>(b)][k]);
      high = std::max(high, raw_[static_cast<size_t>(b)][k]);
    }
    for (int i = 0; i < count; ++i) {
      least = std::min(least, env_.point(vertices_of[i])[k]);
      most = std::max(most, env_.point(vertices_of[i])[k]);
    }
    if (most < low || high < least) return true;
  }
  return false;
}

int SweptTruth::side(int x, int y, int z, uint32_t vertex) const {
  const Point &a = body_[static_cast<size_t>(x)], &b = body_[static_cast<size_t>(y)],
              &c = body_[static_cast<size_t>(z)];
  const Point n = cross(b - a, c - a);
  return linear(dot(n, at(vertex) - a), Point{-n[0], -n[1], -n[2]}, unit_).sign();
}

Poly SweptTruth::line_value(int x, int y, const Line& line) const {
  const Point &p = body_[static_cast<size_t>(x)], &q = body_[static_cast<size_t>(y)];
  const Point a = at(line[0]), b = at(line[1]);
  return linear(dot(q - p, cross(a - p, b - p)), cross(q - p, b - a), unit_);
}

bool SweptTruth::line_pierces(int x, int y, int z, const Line& line) const {
  if (apart({x, y, z}, line.data(), 2) || side(x, y, z, line[0]) == side(x, y, z, line[1])) return false;
  const int first = line_value(x, y, line).sign();
  return line_value(y, z, line).sign() == first && line_value(z, x, line).sign() == first;
}

bool SweptTruth::segment_pierces(int x, int y, const std::array<uint32_t, 3>& t) const {
  if (apart({x, y}, t.data(), 3)) return false;
  const Point a = at(t[0]), n = cross(at(t[1]) - a, at(t[2]) - a);
  const int before = linear(dot(n, body_[static_cast<size_t>(x)] - a), n, unit_).sign();
  const int after = linear(dot(n, body_[static_cast<size_t>(y)] - a), n, unit_).sign();
  if (before == after) return false;
  for (size_t k = 0; k < 3; ++k) {
    if (line_value(x, y, {t[k], t[(k + 1) % 3]}).sign() != after) return false;
  }
  return true;
}

bool SweptTruth::is_free(int x, int y, int z) const {
  for (const Line& line : lines) {
    if (line_pierces(x, y, z, line)) return false;
  }
  for (const auto& t : triangles) {
    if (segment_pierces(x, y, t) || segment_pierces(y, z, t) || segment_pierces(z, x, t)) return false;
  }
  return true;
}

bool SweptTruth::is_flat(int x, int y, int z, int w) const {
  const Point& a = body_[static_cast<size_t>(x)];
  return sgn(dot(cross(body_[static_cast<size_t>(y)] - a, body_[static_cast<size_t>(z)] - a),
                 body_[static_cast<size_t>(w)] - a)) == 0;
}

bool SweptTruth::inside(uint32_t v) const {
  if (apart({0, 1, 2, 3}, &v, 1)) return false;
  const int first = side(1, 2, 3, v);
  return side(0, 3, 2, v) == first && side(0, 1, 3, v) == first && side(0, 2, 1, v) == first;
}

Moment SweptTruth::face_moment(uint32_t v) const {
  const Point w = at(v);
  const auto value = [&](const Point& x) {
    const Point n = cross(body_[2] - x, body_[3] - x);
    return linear(dot(n, w - x), Point{-n[0], -n[1], -n[2]}, unit_);
  };
  Moment m{value(body_[0]), value(body_[0]) - value(body_[1])};
  if (m.denominator.sign() < 0) m = {Poly{} - m.numerator, Poly{} - m.denominator};
  return m;
}

Moment SweptTruth::edge_moment(const Line& line) const {
  const Poly from = line_value(0, 2, line);
  Moment m{from, from - line_value(1, 2, line)};
  if (m.denominator.sign() < 0) m = {Poly{} - m.numerator, Poly{} - m.denominator};
  return m;
}

}  // namespace dsw::swept
