#include "world.h"

#include <algorithm>
#include <cfloat>

namespace dsw::oracle {
namespace {

// The filters bound the error of n.(q - a) by 8 and of det[u, a - p, b - p] by 9 rounding units of the sum of
// magnitudes; these factors are more than twice that. The absolute term covers underflow of normalised coordinates.
constexpr double kPlaneFactor = 2.5e-15, kLineFactor = 2.5e-15, kUnderflow = 1e-250, kFilterLimit = 0x1p60;
constexpr int64_t kLatticeBody = 1 << 18;

int sign_of(int64_t x) { return (x > 0) - (x < 0); }

}  // namespace

BodyPoint World::body(const double* xyz) const {
  BodyPoint b;
  b.filter = true;
  b.lattice = lattice;
  int lowest = INT_MAX;
  for (size_t k = 0; k < 3; ++k) {
    b.raw[k] = xyz[k];
    b.norm[k] = std::ldexp(xyz[k], exponent_);
    if (!(std::fabs(b.norm[k]) < kFilterLimit) || (b.norm[k] != 0 && std::fabs(b.norm[k]) < DBL_MIN)) b.filter = false;
    if (b.norm[k] == 0 && xyz[k] != 0) b.filter = false;
    const int e = lowest_exponent(xyz[k]);
    lowest = std::min(lowest, e);
    if (b.lattice) {
      const double t = e == INT_MAX || e >= -fine_ ? std::ldexp(xyz[k], fine_) - origin_[k] : HUGE_VAL;
      b.lattice = std::fabs(t) <= kLatticeBody && t + origin_[k] == std::ldexp(xyz[k], fine_);
      b.at[k] = b.lattice ? static_cast<int64_t>(t) : 0;
    }
  }
  b.need = lowest == INT_MAX ? 0 : -lowest;
  return b;
}

World::Query World::query(const BodyPoint& p, const BodyPoint& q) const {
  Query s;
  s.p = &p;
  s.q = &q;
  s.lattice = lattice && p.lattice && q.lattice;
  for (size_t k = 0; k < 3; ++k) {
    s.u[k] = q.norm[k] - p.norm[k];
    s.lu[k] = s.lattice ? q.at[k] - p.at[k] : 0;
  }
  return s;
}

void World::need_big(Query& s) const {
  if (s.big_ready) return;
  s.big_ready = true;
  const int need = std::max({need_, s.p->need, s.q->need});
  s.delta = need - need_;
  for (size_t k = 0; k < 3; ++k) {
    s.bp[k] = to_big(s.p->raw[k], need);
    s.bq[k] = to_big(s.q->raw[k], need);
    s.bu[k] = s.bq[k] - s.bp[k];
  }
}

int World::plane_sign(Query& s, bool end, int ti, bool* tie) const {
  const Triangle& t = triangles[static_cast<size_t>(ti)];
  const BodyPoint& b = end ? *s.q : *s.p;
  const auto a = static_cast<size_t>(t.v[0]);
  if (b.filter) {
    double d = 0, m = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double x = b.norm[k] - norm_[a][k];
      d += t.n[k] * x;
      m += t.p[k] * std::fabs(x);
    }
    const double bound = kPlaneFactor * m + kUnderflow;
    if (d > bound) return 1;
    if (d < -bound) return -1;
  }
  int sign = 0;
  if (s.lattice) {
    int64_t d = 0;
    for (size_t k = 0; k < 3; ++k) d += t.ln[k] * (b.at[k] - at_[a][k]);
    sign = sign_of(d);
  } else {
    need_big(s);
    Big d = 0, x;
    for (size_t k = 0; k < 3; ++k) {
      x = big_[a][k];
      if (s.delta != 0) x <<= static_cast<unsigned>(s.delta);
      x = (end ? s.bq[k] : s.bp[k]) - x;
      d += t.bn[k] * x;
    }
    sign = sgn(d);
  }
  if (sign != 0) return sign;
  *tie = true;
  for (const Big& n : t.bn) {
    if (sgn(n) != 0) return sgn(n);
  }
  return 0;
}

int World::line_sign(Query& s, int ai, int bi, bool* tie) const {
  const auto a = static_cast<size_t>(ai), b = static_cast<size_t>(bi);
  if (s.p->filter && s.q->filter) {
    double x[3], y[3], d = 0, m = 0;
    for (size_t k = 0; k < 3; ++k) {
      x[k] = norm_[a][k] - s.p->norm[k];
      y[k] = norm_[b][k] - s.p->norm[k];
    }
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const double l = x[i] * y[j], r = x[j] * y[i];
      d += s.u[k] * (l - r);
      m += std::fabs(s.u[k]) * (std::fabs(l) + std::fabs(r));
    }
    const double bound = kLineFactor * m + kUnderflow;
    if (d > bound) return 1;
    if (d < -bound) return -1;
  }
  if (s.lattice) {
    int64_t d = 0, w[3];
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const int64_t xi = at_[a][i] - s.p->at[i], xj = at_[a][j] - s.p->at[j];
      const int64_t yi = at_[b][i] - s.p->at[i], yj = at_[b][j] - s.p->at[j];
      d += s.lu[k] * (xi * yj - xj * yi);
      w[k] = s.lu[i] * (at_[b][j] - at_[a][j]) - s.lu[j] * (at_[b][i] - at_[a][i]);
    }
    if (d != 0) return sign_of(d);
    *tie = true;
    for (int64_t c : w) {
      if (c != 0) return sign_of(c);
    }
    return 0;
  }
  need_big(s);
  Big x[3], y[3], d = 0;
  for (size_t k = 0; k < 3; ++k) {
    x[k] = big_[a][k] << static_cast<unsigned>(s.delta);
    y[k] = big_[b][k] << static_cast<unsigned>(s.delta);
    x[k] -= s.bp[k];
    y[k] -= s.bp[k];
  }
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    d += s.bu[k] * (x[i] * y[j] - x[j] * y[i]);
  }
  if (sgn(d) != 0) return sgn(d);
  *tie = true;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Big w = s.bu[i] * (y[j] - x[j]) - s.bu[j] * (y[i] - x[i]);
    if (sgn(w) != 0) return sgn(w);
  }
  return 0;
}

bool World::outer_boundary_crosses() const {
  std::vector<int> outer;
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (triangles[t].cell[1] < 0) outer.push_back(static_cast<int>(t));
  }
  const auto at = [&](int v) -> const Vec& { return mesh.points[static_cast<size_t>(v)]; };
  for (const int edges_of : outer) {
    for (size_t k = 0; k < 3; ++k) {
      const int* const v = triangles[static_cast<size_t>(edges_of)].v;
      const int a = v[k], b = v[(k + 1) % 3];
      const BodyPoint p = body(at(a).data()), q = body(at(b).data());
      Query s = query(p, q);
      for (const int other : outer) {
        const int* const w = triangles[static_cast<size_t>(other)].v;
        bool tie = false;
        if (std::find(w, w + 3, a) != w + 3 || std::find(w, w + 3, b) != w + 3) continue;
        if (pierce(s, other, &tie) != 0) return true;
      }
    }
  }
  return false;
}

int World::pierce(Query& s, int ti, bool* tie) const {
  const int from = plane_sign(s, false, ti, tie);
  const int to = plane_sign(s, true, ti, tie);
  if (from == to) return 0;
  const Triangle& t = triangles[static_cast<size_t>(ti)];
  for (int k = 0; k < 3; ++k) {
    if (line_sign(s, t.v[k], t.v[(k + 1) % 3], tie) != to) return 0;
  }
  return to;
}

World::Hit World::make_hit(Query& s, int ti, int side) const {
  const Triangle& t = triangles[static_cast<size_t>(ti)];
  const auto a = static_cast<size_t>(t.v[0]);
  Hit h;
  h.triangle = ti;
  h.side = side;
  if (s.lattice) {
    int64_t d = 0, nu = 0;
    for (size_t k = 0; k < 3; ++k) {
      d += t.ln[k] * (s.p->at[k] - at_[a][k]);
      nu += t.ln[k] * s.lu[k];
      h.shift[k] = to_big(-side * t.ln[k]);
    }
    h.numerator = to_big(-side * d);
    h.denominator = to_big(side * nu);
    return h;
  }
  need_big(s);
  for (size_t k = 0; k < 3; ++k) {
    h.numerator -= t.bn[k] * Big(s.bp[k] - Big(big_[a][k] << static_cast<unsigned>(s.delta)));
    h.denominator += t.bn[k] * s.bu[k];
    h.shift[k] = -t.bn[k];
  }
  if (side < 0) {
    h.numerator = -h.numerator;
    h.denominator = -h.denominator;
    for (Big& x : h.shift) x = -x;
  }
  return h;
}

bool World::earlier(const Hit& a, const Hit& b) {
  int c = cmp(a.numerator * b.denominator, b.numerator * a.denominator);
  for (size_t k = 0; c == 0 && k < 3; ++k) c = cmp(a.shift[k] * b.denominator, b.shift[k] * a.denominator);
  return c < 0;
}

int World::locate(const BodyPoint& p) {
  // The far end must be outside of everything; a lattice one keeps the arithmetic small.
  const BodyPoint& far = far_[p.lattice ? 0 : 1];
  Query s = query(p, far);
  winding_.assign(ids.size(), 0);
  bool tie = false;
  for (size_t t = 0; t < triangles.size(); ++t) {
    const int side = pierce(s, static_cast<int>(t), &tie);
    if (side == 0) continue;
    winding_[static_cast<size_t>(triangles[t].cell[0])] += side;
    if (triangles[t].cell[1] >= 0) winding_[static_cast<size_t>(triangles[t].cell[1])] -= side;
  }
  int found = -1;
  for (size_t c = 0; c < ids.size(); ++c) {
    if (winding_[c] == 0) continue;
    if (winding_[c] != 1 || found >= 0) return -2;
    found = static_cast<int>(c);
  }
  return found;
}

bool World::contains(int cell, const BodyPoint& p) {
  Query s = query(p, far_[p.lattice ? 0 : 1]);
  bool tie = false;
  int winding = 0;
  for (int t : cell_triangles[static_cast<size_t>(cell)]) {
    const int side = pierce(s, t, &tie);
    winding += triangles[static_cast<size_t>(t)].cell[0] == cell ? side : -side;
  }
  return winding == 1;
}

bool World::impassable(int face) const {
  const Face& f = faces[static_cast<size_t>(face)];
  if (f.marked || f.cell[1] < 0) return true;
  return cell_marked[static_cast<size_t>(f.cell[0])] != 0 || cell_marked[static_cast<size_t>(f.cell[1])] != 0;
}

Walk World::cast(const BodyPoint& p, const BodyPoint& q, int start) {
  Walk walk;
  walk.cell = start >= 0 ? start : locate(p);
  if (walk.cell == -2) {
    walk.fault = "several cells contain the start";
    return walk;
  }
  if (walk.cell < 0) {
    walk.outcome = Walk::kOutside;
    return walk;
  }
  if (cell_marked[static_cast<size_t>(walk.cell)] != 0) {
    walk.outcome = Walk::kImpassable;
    return walk;
  }
  Query s = query(p, q);
  std::vector<Hit> hits;
  const std::vector<int>& set = subset_.empty() ? all_ : subset_;
  for (int t : set) {
    bool tie = false;
    const int side = pierce(s, t, &tie);
    tie_[static_cast<size_t>(t)] = tie;
    if (side != 0) hits.push_back(make_hit(s, t, side));
  }
  std::sort(hits.begin(), hits.end(), earlier);
  walk.steps.push_back({walk.cell, -1, 0});
  walk.outcome = Walk::kReached;
  const auto left_by = [&](const Hit& h) {
    return triangles[static_cast<size_t>(h.triangle)].cell[h.side > 0 ? 0 : 1];
  };
  for (size_t i = 0; i < hits.size(); ++i) {
    // Rounded corners of merged cells can fold the outer boundary upon itself: two triangles in one place.
    if (i + 1 < hits.size() && left_by(hits[i]) != walk.cell && !earlier(hits[i], hits[i + 1])) {
      std::swap(hits[i], hits[i + 1]);
    }
    const Hit& h = hits[i];
    const Triangle& t = triangles[static_cast<size_t>(h.triangle)];
    const int leave = left_by(h), enter = t.cell[h.side > 0 ? 1 : 0];
    if (leave != walk.cell) {
      walk.outcome = Walk::kBroken;
      walk.fault = "the crossed triangle " + std::to_string(h.triangle) + " is not one of the cell's";
      return walk;
    }
    const double time = floor_to_double(h.numerator, h.denominator);
    if (impassable(t.face)) {
      walk.outcome = Walk::kContact;
      walk.face = t.face;
      walk.triangle = h.triangle;
      walk.side = h.side;
      walk.time = time;
      break;
    }
    walk.cell = enter;
    walk.steps.push_back({enter, t.face, time});
  }
  for (const Step& step : walk.steps) {
    for (int t : cell_triangles[static_cast<size_t>(step.cell)]) walk.tie = walk.tie || tie_[static_cast<size_t>(t)];
  }
  return walk;
}

Vec World::unit_normal(int triangle, double* tolerance) const {
  const Triangle& t = triangles[static_cast<size_t>(triangle)];
  long e[3], most = LONG_MIN;
  double m[3];
  for (size_t k = 0; k < 3; ++k) {
    m[k] = mpz_get_d_2exp(&e[k], t.bn[k].get_mpz_t());
    if (m[k] != 0) most = std::max(most, e[k]);
  }
  Vec n;
  for (size_t k = 0; k < 3; ++k)
    n[k] = m[k] == 0 ? 0 : std::ldexp(m[k], static_cast<int>(std::max(e[k] - most, -1000l)));
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& x : n) x /= length;
  // What cancels in the cross product is lost to double arithmetic; nothing else may be.
  const double real = std::sqrt(t.n[0] * t.n[0] + t.n[1] * t.n[1] + t.n[2] * t.n[2]);
  *tolerance = 1e-14 + 4e-15 * std::max({t.p[0], t.p[1], t.p[2]}) / real;
  return n;
}

Big World::volume6(int cell) const {
  Big sum = 0;
  for (int ti : cell_triangles[static_cast<size_t>(cell)]) {
    const Triangle& t = triangles[static_cast<size_t>(ti)];
    Big d = 0;
    for (size_t k = 0; k < 3; ++k) d += t.bn[k] * big_[static_cast<size_t>(t.v[0])][k];
    if (t.cell[0] == cell) {
      sum += d;
    } else {
      sum -= d;
    }
  }
  return sum;
}

Big World::outer_volume6() const {
  Big sum = 0;
  for (const Triangle& t : triangles) {
    if (t.cell[1] >= 0) continue;
    for (size_t k = 0; k < 3; ++k) sum += t.bn[k] * big_[static_cast<size_t>(t.v[0])][k];
  }
  return sum;
}

}  // namespace dsw::oracle
