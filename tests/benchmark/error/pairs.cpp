#include "pairs.h"

#include "predicates/touch.h"

#include <cmath>
#include <stdexcept>

namespace dsw::curves {

namespace {

using Rational = std::array<mpq_class, 3>;

Rational rational(const Vec& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }
Rational minus(const Rational& a, const Rational& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational cross(const Rational& a, const Rational& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Rational& a, const Rational& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec plus(const Vec& p, const Vec& d, double by = 1) { return {p[0] + by * d[0], p[1] + by * d[1], p[2] + by * d[2]}; }

std::optional<mpq_class> time_of_pair(PairKind kind, const Pair& pair) {
  return kind == PairKind::kVertexFace ? vertex_face_time(pair) : edge_edge_time(pair);
}

/** Whether everything lies in one plane, or what makes the plane is no triangle. */
bool is_flat(PairKind kind, const Pair& pair) {
  const bool face = kind == PairKind::kVertexFace;
  const Rational on = rational(face ? pair.corners[0] : pair.fixed);
  const Rational u = minus(rational(face ? pair.corners[1] : pair.from), on),
                 v = minus(rational(face ? pair.corners[2] : pair.to), on), normal = cross(u, v);
  const Rational x = rational(face ? pair.from : pair.corners[0]), y = rational(face ? pair.to : pair.corners[1]);
  return sgn(dot(normal, minus(x, on))) == 0 && sgn(dot(normal, minus(y, on))) == 0;
}

Vec whole(Rng& rng, int most) {
  return {static_cast<double>(rng.between(-most, most)), static_cast<double>(rng.between(-most, most)),
          static_cast<double>(rng.between(-most, most))};
}

}  // namespace

std::size_t Pairs::hits() const {
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [](const Pair& pair) { return pair.time.has_value(); }));
}

std::optional<mpq_class> vertex_face_time(const Pair& pair) {
  const Rational p = rational(pair.from), to = rational(pair.to), a = rational(pair.corners[0]),
                 b = rational(pair.corners[1]), c = rational(pair.corners[2]);
  const Rational normal = cross(minus(b, a), minus(c, a));
  const mpq_class start = dot(normal, minus(p, a)), end = dot(normal, minus(to, a));
  if (sgn(start) == sgn(end) || sgn(start) * sgn(end) > 0) return std::nullopt;
  const Rational way = minus(to, p);
  const int ab = sgn(dot(way, cross(minus(a, p), minus(b, p)))), bc = sgn(dot(way, cross(minus(b, p), minus(c, p)))),
            ca = sgn(dot(way, cross(minus(c, p), minus(a, p))));
  if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return std::nullopt;
  return mpq_class(start / (start - end));
}

std::optional<mpq_class> edge_edge_time(const Pair& pair) {
  const Rational p = rational(pair.from), to = rational(pair.to), q = rational(pair.fixed),
                 a = rational(pair.corners[0]), b = rational(pair.corners[1]);
  const Rational u = minus(p, q), v = minus(to, q), normal = cross(u, v);
  const mpq_class start = dot(normal, minus(a, q)), end = dot(normal, minus(b, q));
  if (sgn(start) == sgn(end) || sgn(start) * sgn(end) > 0) return std::nullopt;
  // Where a b passes the plane: q + alpha u + beta v, which the edge reaches at beta / (alpha + beta).
  const mpq_class at = start / (start - end);
  Rational x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = a[k] + at * (b[k] - a[k]) - q[k];
  const mpq_class square = dot(normal, normal);
  const mpq_class alpha = dot(normal, cross(x, v)) / square, beta = dot(normal, cross(u, x)) / square;
  const mpq_class sum = alpha + beta;
  if (sgn(alpha) < 0 || sgn(beta) < 0 || sum > 1 || sgn(sum) == 0) return std::nullopt;
  return mpq_class(beta / sum);
}

Pairs random_pairs(Place& place, Rng& rng, PairKind kind, std::size_t count) {
  Pairs pairs{kind, {}};
  const bool faces = kind == PairKind::kVertexFace;
  const dsw_level level = faces ? DSW_LEVEL_POINTS : DSW_LEVEL_EDGES_SWEPT;
  while (pairs.list.size() < count) {
    const Move move = random_move(place, rng, faces ? 1 : 2, 1.0, 1.0, level);
    if (move.truth.events.empty()) continue;
    const oracle::SweepEvent& event = move.truth.events[0];
    if ((event.triangle >= 0) != faces || event.order != 0) continue;
    Pair pair{move.body.at[0], move.targets[0], move.body.at.back(), {}, {}};
    const auto& points = place.world().mesh.points;
    if (faces) {
      const int* v = place.world().triangles[static_cast<std::size_t>(event.triangle)].v;
      for (std::size_t k = 0; k < 3; ++k) pair.corners[k] = points[static_cast<std::size_t>(v[k])];
    } else {
      pair.corners = {points[static_cast<std::size_t>(event.a)], points[static_cast<std::size_t>(event.b)], {}};
    }
    pair.time = time_of_pair(kind, pair);
    if (!pair.time || *pair.time != time_of(move.truth)) throw std::logic_error("two exact times differ");
    pairs.list.push_back(pair);
    const Vec aside = Place::direction(rng, 0.5);
    for (Vec& corner : pair.corners) corner = plus(corner, aside);
    pair.time = time_of_pair(kind, pair);
    pairs.list.push_back(pair);
  }
  return pairs;
}

Pairs degenerate_pairs(Rng& rng, PairKind kind, std::size_t count) {
  Pairs pairs{kind, {}};
  while (pairs.list.size() < count) {
    Pair pair{{}, {}, whole(rng, 8), {whole(rng, 8), whole(rng, 8), whole(rng, 8)}, {}};
    // A place on a corner or in the middle of a side, and a way that goes through it or ends there.
    Vec x = pair.corners[0];
    if (rng.chance(0.5)) x = plus(plus({}, pair.corners[0], 0.5), pair.corners[1], 0.5);
    const Vec d = whole(rng, 4);
    if (kind == PairKind::kEdgeEdge) {
      // The edge's middle or end passes it.
      const double reach = rng.chance(0.5) ? 1 : 2;
      x = plus(plus({}, x, reach), pair.fixed, 1 - reach);
    }
    pair.from = plus(x, d, -1);
    pair.to = plus(x, d, rng.below(3));
    if (rng.chance(0.5)) {
      double& moved = pair.to[rng.below(3)];
      moved = std::nextafter(moved, rng.chance(0.5) ? 1e9 : -1e9);
    }
    pair.time = time_of_pair(kind, pair);
    // Who starts in touch is no question of continuous detection, and what stays in one plane another one.
    if ((pair.time && sgn(*pair.time) == 0) || is_flat(kind, pair)) continue;
    pairs.list.push_back(pair);
  }
  return pairs;
}

void add_dartsweep(PairMethods& methods) {
  if (methods.pairs().kind == PairKind::kVertexFace) {
    methods.add("dartsweep exact", "", "", [](const Pair& pair) {
      const double* corners[3] = {pair.corners[0].data(), pair.corners[1].data(), pair.corners[2].data()};
      const double time = vertex_touch(pair.from.data(), pair.to.data(), corners);
      return PairAnswer{time < kNever ? time : -1, false, {}, {}};
    });
  } else {
    methods.add("dartsweep exact", "", "", [](const Pair& pair) {
      const double time = edge_touch({pair.from.data(), pair.to.data(), pair.fixed.data()}, pair.corners[0].data(),
                                     pair.corners[1].data())
                              .time;
      return PairAnswer{time < kNever ? time : -1, false, {}, {}};
    });
  }
}

}  // namespace dsw::curves
