#include "judge.h"

#include <limits>

#include "gmp_numbers.h"
#include "moving_pair_truth.h"

namespace dsw::rigid {

namespace {

using Long = std::array<long double, 3>;

constexpr std::size_t kPieces = 64;

/** A body on its way: where its points are at the ends of pieces, and how far they are beside the chords of these at most. */
class Course {
 public:
  Course(const Figure& body, const TurningWay& way) : count_(body.points.size()) {
    for (std::size_t piece = 0; piece <= kPieces; ++piece) {
      for (const Point& point : body.points) {
        const Long at = place_at(way, point, static_cast<long double>(piece) / kPieces);
        places_.push_back({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
      }
    }
    // With half the angle h it turns by w = 2 sin h / n, where n, the square of the quaternion, goes down to (1 + cos h) / 2, and
    // n' is at most 2 (1 - cos h). The second derivative at a distance of 1 is at most w^2 + |w'|.
    const double* const q = way.turn[1];
    const double sine = length({q[0], q[1], q[2]}), least = 0.5 * (1 + q[3]);
    const double speed = 2 * sine / least, change = 4 * sine * (1 - q[3]) / (least * least);
    const Point centre{way.centre[0], way.centre[1], way.centre[2]};
    for (const Point& point : body.points) {
      const double radius = length(point - centre);
      rooms_.push_back(0.125 * 1.001 * (speed * speed + change) * radius / (kPieces * kPieces) + 1e-12 * (9 + radius));
    }
  }

  const Point& place(std::size_t piece, std::size_t point) const { return places_[piece * count_ + point]; }

  /** The first piece in which parts are not clearly apart, or kPieces. */
  std::size_t first_piece(int dimension, const Part& part, const Figure& standing, const Part& other) const {
    std::size_t piece = 0;
    while (piece < kPieces && is_apart(dimension, piece, part, standing, other)) ++piece;
    return piece;
  }

 private:
  bool is_apart(int dimension, std::size_t piece, const Part& part, const Figure& standing, const Part& other) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      Point axis{};
      axis[k] = 1;
      if (separates(axis, piece, part, standing, other)) return true;
    }
    const auto corner = [&](std::size_t i) { return standing.points[other.at[i]]; };
    const auto mine = [&](std::size_t at, std::size_t i) { return place(at, part.at[i]); };
    std::array<Point, 2> axes{};
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t at = piece + end;
      if (dimension == 2) {
        const Point along = other.count == 2 ? corner(1) - corner(0) : mine(at, 1) - mine(at, 0);
        axes[end] = {along[1], -along[0], 0};
      } else if (other.count == 3) {
        axes[end] = cross(corner(1) - corner(0), corner(2) - corner(0));
      } else if (part.count == 3) {
        axes[end] = cross(mine(at, 1) - mine(at, 0), mine(at, 2) - mine(at, 0));
      } else {
        axes[end] = cross(corner(1) - corner(0), mine(at, 1) - mine(at, 0));
      }
    }
    return std::any_of(axes.begin(), axes.end(), [&](const Point& axis) {
      return length(axis) > 0 && separates(unit(axis), piece, part, standing, other);
    });
  }

  bool separates(const Point& axis, std::size_t piece, const Part& part, const Figure& standing,
                 const Part& other) const {
    double low = std::numeric_limits<double>::infinity(), high = -low, other_low = low, other_high = high, room = 0;
    for (std::size_t i = 0; i < part.count; ++i) {
      room = std::max(room, rooms_[part.at[i]]);
      for (std::size_t end = 0; end < 2; ++end) {
        const double at = dot(axis, place(piece + end, part.at[i]));
        low = std::min(low, at);
        high = std::max(high, at);
      }
    }
    for (std::size_t i = 0; i < other.count; ++i) {
      const double at = dot(axis, standing.points[other.at[i]]);
      other_low = std::min(other_low, at);
      other_high = std::max(other_high, at);
    }
    return high + room < other_low || other_high + room < low;
  }

  std::size_t count_;
  std::vector<Point> places_;
  std::vector<double> rooms_;
};

/** The shift decides about a wall that is touched at time 0. A body may be created there, on the side to which the shift takes it. Take a
 * vertex in the wall x = 0 of a room where x > 0, with x = s (1 - 2 s) / 2^53 at time s. It is in the room until the time 1/2, when it enters the
 * wall. Its touch at time 0 is none, and the first touch without a shift is not the first entry. */
template <int D>
FirstTouch touch_of(const TurningPair<D>& pair, bool is_wall) {
  constexpr double kBegin = 0x1p-100;  // the shift moves the time 0 by less
  FirstTouch touch = true_first_touch(pair);
  if (!is_wall || !touch.touches || touch.time > 0) return touch;
  touch = true_first_entry(pair);
  if (touch.time < kBegin) touch.time = 0;
  return touch;
}

template <int D>
FirstTouch ask(const Figure& body, const TurningWay& way, const Figure& standing, const Touching& touching,
               bool is_wall) {
  const bool is_first = touching.body.count == 1 || (D == 3 && touching.body.count == 2);
  TurningPair<D> pair{};
  pair.kind = D == 2 ? PairKind::kVertexEdge : touching.body.count == 2 ? PairKind::kEdgeEdge : PairKind::kVertexFace;
  std::size_t at = 0;
  const auto put = [&](const Figure& figure, const Part& part) {
    for (std::size_t i = 0; i < part.count; ++i, ++at) {
      pair.start[at] = pair.end[at] = figure.points[part.at[i]].data();
    }
  };
  if (is_first) {
    put(body, touching.body);
    put(standing, touching.standing);
  } else {
    put(standing, touching.standing);
    put(body, touching.body);
  }
  pair.way[is_first ? 0 : 1] = &way;
  return touch_of(pair, is_wall);
}

/** Number is long double or mpq_class. */
template <class Number>
struct Vector {
  Number x, y, z;
};
template <class Number>
Vector<Number> between(const Point& a, const Point& b) {
  return {Number(Number(b[0]) - Number(a[0])), Number(Number(b[1]) - Number(a[1])),
          Number(Number(b[2]) - Number(a[2]))};
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a.y * b.z - a.z * b.y), Number(a.z * b.x - a.x * b.z), Number(a.x * b.y - a.y * b.x)};
}
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return Number(a.x * b.x + a.y * b.y + a.z * b.z);
}

long double largest(const Vector<long double>& a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }

int sign_of_first(const Vector<mpq_class>& a) { return sgn(a.x) != 0 ? sgn(a.x) : sgn(a.y) != 0 ? sgn(a.y) : sgn(a.z); }

/** The sign of n (p - a), where n is the first times the second. If it is 0: that of the shift, a small vector whose first
 * component is much larger than the second, times n or its opposite. */
template <class Normal>
int sign(const Point& a, const Point& p, Normal normal, int shifted) {
  const Vector<long double> n = normal(0.0L), d = between<long double>(a, p);
  const long double value = dot(n, d);
  if (std::fabs(value) > 1e-15L * largest(n) * largest(d) && std::fabs(value) > 1e-15L * largest(d)) {
    return value > 0 ? 1 : -1;
  }
  const Vector<mpq_class> exact = normal(mpq_class());
  const int exact_sign = sgn(dot(exact, between<mpq_class>(a, p)));
  return exact_sign != 0 ? exact_sign : shifted * sign_of_first(exact);
}

/** On which side of a triangle a point is; `shifted`: the point 1, the triangle -1, or nothing 0. */
int side(const Point& a, const Point& b, const Point& c, const Point& p, int shifted) {
  const auto normal = [&](auto zero) {
    using Number = decltype(zero);
    return cross(between<Number>(a, b), between<Number>(a, c));
  };
  return sign(a, p, normal, shifted);
}
/** How the line from p to q, which is shifted if that is 1, goes past that from a to b. */
int line_side(const Point& p, const Point& q, const Point& a, const Point& b, int shifted) {
  // det(q - p, a - p, b - p) = ((q - p) x (b - a)) (p - a).
  const auto normal = [&](auto zero) {
    using Number = decltype(zero);
    return cross(between<Number>(p, q), between<Number>(a, b));
  };
  return sign(a, p, normal, shifted);
}
/** In the plane. */
int plane_side(const Point& a, const Point& b, const Point& p, int shifted) {
  const auto normal = [&](auto zero) {
    using Number = decltype(zero);
    const Vector<Number> along = between<Number>(a, b);
    return Vector<Number>{Number(-along.y), along.x, Number(0)};
  };
  return sign(a, p, normal, shifted);
}

bool boxes_overlap(const std::vector<Point>& x, const Part& a, const std::vector<Point>& y, const Part& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    double low[2] = {x[a.at[0]][k], y[b.at[0]][k]}, high[2] = {low[0], low[1]};
    for (std::size_t i = 1; i < a.count; ++i) {
      low[0] = std::min(low[0], x[a.at[i]][k]);
      high[0] = std::max(high[0], x[a.at[i]][k]);
    }
    for (std::size_t i = 1; i < b.count; ++i) {
      low[1] = std::min(low[1], y[b.at[i]][k]);
      high[1] = std::max(high[1], y[b.at[i]][k]);
    }
    if (high[0] < low[1] || high[1] < low[0]) return false;
  }
  return true;
}

/** Whether a segment goes through a triangle. `shifted`: what of them is, the segment 1 or the triangle -1. */
bool goes_through(const Point& p, const Point& q, const Point* t, int shifted) {
  if (side(t[0], t[1], t[2], p, shifted) * side(t[0], t[1], t[2], q, shifted) >= 0) return false;
  const int first = line_side(p, q, t[0], t[1], shifted);
  return first != 0 && line_side(p, q, t[1], t[2], shifted) == first && line_side(p, q, t[2], t[0], shifted) == first;
}

Long minus(const Long& a, const Long& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double dot(const Long& a, const Long& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Long cross(const Long& a, const Long& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

long double to_segment(const Long& p, const Long& a, const Long& b) {
  const Long along = minus(b, a);
  const long double square = dot(along, along);
  const long double t = square > 0 ? std::clamp(dot(minus(p, a), along) / square, 0.0L, 1.0L) : 0.0L;
  Long d = minus(p, a);
  for (std::size_t k = 0; k < 3; ++k) d[k] -= t * along[k];
  return std::sqrt(dot(d, d));
}

/** Between the lines of two segments, if they are nearest inside of both. */
long double between_lines(const Long& a, const Long& b, const Long& c, const Long& d) {
  const Long u = minus(b, a), v = minus(d, c), w = minus(c, a), n = cross(u, v);
  const long double square = dot(n, n);
  if (!(square > 0)) return std::numeric_limits<long double>::infinity();
  const long double s = dot(cross(w, v), n) / square, t = dot(cross(w, u), n) / square;
  if (s < 0 || s > 1 || t < 0 || t > 1) return std::numeric_limits<long double>::infinity();
  return std::fabs(dot(w, n)) / std::sqrt(square);
}

/** To the plane of a triangle, if a point is over it. */
long double to_inside(const Long& p, const Long* t) {
  const Long n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const long double square = dot(n, n);
  if (!(square > 0)) return std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Long &a = t[i], &b = t[(i + 1) % 3];
    if (dot(cross(minus(b, a), minus(p, a)), n) < 0) return std::numeric_limits<long double>::infinity();
  }
  return std::fabs(dot(minus(p, t[0]), n)) / std::sqrt(square);
}

/** A segment through a triangle has the distance 0. */
bool meets(const Long& p, const Long& q, const Long* t) {
  const Long n = cross(minus(t[1], t[0]), minus(t[2], t[0])), along = minus(q, p);
  const long double at = dot(minus(t[0], p), n), all = dot(along, n);
  if (all == 0 || at / all < 0 || at / all > 1) return false;
  Long hit = p;
  for (std::size_t k = 0; k < 3; ++k) hit[k] += at / all * along[k];
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(minus(t[(i + 1) % 3], t[i]), minus(hit, t[i])), n) < 0) return false;
  }
  return true;
}

}  // namespace

std::array<long double, 3> place_at(const TurningWay& way, const Point& point, long double time) {
  Long q{}, x{};
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = (1 - time) * way.turn[0][k] + time * way.turn[1][k];
    x[k] = static_cast<long double>(point[k]) - way.centre[k];
  }
  const long double w = (1 - time) * way.turn[0][3] + time * way.turn[1][3], n = dot(q, q) + w * w;
  const Long c = cross(q, x);
  const long double d = dot(q, x);
  Long r{};
  for (std::size_t k = 0; k < 3; ++k) {
    r[k] = ((w * w - dot(q, q)) * x[k] + 2 * d * q[k] + 2 * w * c[k]) / n;
    r[k] += (1 - time) * way.place[0][k] + time * way.place[1][k];
  }
  return r;
}

Truth first_touch_of(int dimension, const Figure& body, const TurningWay& way, const Figure& standing,
                     std::size_t wall_points) {
  struct Candidate {
    std::size_t piece;
    Touching touching;
  };
  const Course course(body, way);
  std::vector<Candidate> candidates;
  const auto find = [&](const std::vector<Part>& mine, const std::vector<Part>& others) {
    for (const Part& part : mine) {
      for (const Part& other : others) {
        const std::size_t piece = course.first_piece(dimension, part, standing, other);
        if (piece < kPieces) candidates.push_back({piece, {part, other}});
      }
    }
  };
  if (dimension == 2) {
    find(body.vertices, standing.edges);
    find(body.edges, standing.vertices);
  } else {
    find(body.vertices, standing.faces);
    find(body.faces, standing.vertices);
    find(body.edges, standing.edges);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.piece < b.piece; });
  Truth truth;
  for (const Candidate& each : candidates) {
    if (truth.touches && static_cast<double>(each.piece) / kPieces > truth.time) break;
    const bool is_wall = each.touching.standing.at[0] < wall_points;
    const FirstTouch touch = dimension == 2 ? ask<2>(body, way, standing, each.touching, is_wall)
                                            : ask<3>(body, way, standing, each.touching, is_wall);
    ++truth.asked;
    if (!touch.touches || (truth.touches && touch.time > truth.time)) continue;
    if (!truth.touches || touch.time < truth.time) truth.pairs.clear();
    truth.touches = true;
    truth.time = touch.time;
    truth.pairs.push_back(each.touching);
  }
  return truth;
}

bool is_free(int dimension, const Figure& body, const std::vector<Point>& places, const Figure& walls,
             bool is_shifted) {
  const int shifted = is_shifted ? 1 : 0;
  const auto triangle = [](const std::vector<Point>& points, const Part& face) {
    return std::array<Point, 3>{points[face.at[0]], points[face.at[1]], points[face.at[2]]};
  };
  for (const Part& edge : body.edges) {
    const Point &p = places[edge.at[0]], &q = places[edge.at[1]];
    for (const Part& face : walls.faces) {
      if (!boxes_overlap(places, edge, walls.points, face)) continue;
      if (goes_through(p, q, triangle(walls.points, face).data(), shifted)) return false;
    }
    for (const Part& wall : walls.edges) {
      if (dimension == 3 || !boxes_overlap(places, edge, walls.points, wall)) continue;
      const Point &a = walls.points[wall.at[0]], &b = walls.points[wall.at[1]];
      if (plane_side(a, b, p, shifted) * plane_side(a, b, q, shifted) < 0 &&
          plane_side(p, q, a, -shifted) * plane_side(p, q, b, -shifted) < 0) {
        return false;
      }
    }
  }
  for (const Part& face : body.faces) {
    for (const Part& wall : walls.edges) {
      if (!boxes_overlap(places, face, walls.points, wall)) continue;
      const Point &a = walls.points[wall.at[0]], &b = walls.points[wall.at[1]];
      if (goes_through(a, b, triangle(places, face).data(), -shifted)) return false;
    }
  }
  return true;
}

long double distance(const Long* a, std::size_t a_count, const Long* b, std::size_t b_count) {
  long double least = std::numeric_limits<long double>::infinity();
  const auto sides = [](std::size_t count) { return count == 3 ? 3 : count - 1; };
  const auto points_to = [&](const Long* x, std::size_t x_count, const Long* y, std::size_t y_count) {
    for (std::size_t i = 0; i < x_count; ++i) {
      if (y_count == 3) least = std::min(least, to_inside(x[i], y));
      for (std::size_t j = 0; j < std::max<std::size_t>(sides(y_count), 1); ++j) {
        least = std::min(least, to_segment(x[i], y[j], y[(j + 1) % y_count]));
      }
    }
    for (std::size_t i = 0; i < sides(x_count) && y_count == 3; ++i) {
      if (meets(x[i], x[(i + 1) % x_count], y)) least = 0;
    }
  };
  points_to(a, a_count, b, b_count);
  points_to(b, b_count, a, a_count);
  for (std::size_t i = 0; i < sides(a_count); ++i) {
    for (std::size_t j = 0; j < sides(b_count); ++j) {
      least = std::min(least, between_lines(a[i], a[(i + 1) % a_count], b[j], b[(j + 1) % b_count]));
    }
  }
  return least;
}

template <int D>
long double height(const std::array<Long, 3>& a, std::size_t a_count, const std::array<Long, 3>& b,
                   std::size_t b_count) {
  if (a_count > b_count) return height<D>(b, b_count, a, a_count);
  Long n{};
  if (D == 2) {
    n = {b[0][1] - b[1][1], b[1][0] - b[0][0], 0};
  } else {
    n = b_count == 3 ? cross(minus(b[1], b[0]), minus(b[2], b[0])) : cross(minus(a[1], a[0]), minus(b[1], b[0]));
  }
  return dot(minus(a[0], b[0]), n) / std::sqrt(dot(n, n));
}
template long double height<2>(const std::array<Long, 3>&, std::size_t, const std::array<Long, 3>&, std::size_t);
template long double height<3>(const std::array<Long, 3>&, std::size_t, const std::array<Long, 3>&, std::size_t);

long double distance(const std::vector<Point>& places, const Part& part, const Figure& standing, const Part& other) {
  Long a[3], b[3];
  for (std::size_t i = 0; i < part.count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) a[i][k] = places[part.at[i]][k];
  }
  for (std::size_t i = 0; i < other.count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) b[i][k] = standing.points[other.at[i]][k];
  }
  return distance(a, part.count, b, other.count);
}

namespace {

/** Looks for the first time from `from` to `until`. */
class Search {
 public:
  Search(int dimension, const Figure& body, const PlacesAt& places_at, long double speed, const Figure& standing,
         long double keep)
      : mine_(dimension == 3 && !body.faces.empty() ? body.faces : body.edges),
        others_(dimension == 3 ? standing.faces : standing.edges),
        places_at_(places_at),
        speed_(speed),
        standing_(standing),
        keep_(keep) {}

  long double first(long double from, long double until) {
    std::vector<std::array<std::size_t, 2>> all;
    for (std::size_t i = 0; i < mine_.size(); ++i) {
      for (std::size_t j = 0; j < others_.size(); ++j) all.push_back({i, j});
    }
    return first(from, until, all);
  }

 private:
  /** Only these pairs of parts can be near then. */
  long double first(long double from, long double until, const std::vector<std::array<std::size_t, 2>>& pairs) {
    constexpr long double kNever = 2;
    const long double middle = 0.5L * (from + until), reach = keep_ + speed_ * 0.5L * (until - from);
    const std::vector<Long> places = places_at_(middle);
    std::vector<std::array<std::size_t, 2>> near;
    bool is_near = false;
    for (const auto& pair : pairs) {
      const Part &part = mine_[pair[0]], &other = others_[pair[1]];
      Long a[3], b[3];
      for (std::size_t i = 0; i < part.count; ++i) a[i] = places[part.at[i]];
      for (std::size_t i = 0; i < other.count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) b[i][k] = standing_.points[other.at[i]][k];
      }
      if (boxes_apart(a, part.count, b, other.count, reach)) continue;
      const long double d = distance(a, part.count, b, other.count);
      if (d >= reach) continue;
      near.push_back(pair);
      is_near = is_near || d < keep_;
    }
    if (near.empty()) return kNever;
    if (until - from < 0x1p-36L) return is_near ? from : kNever;
    const long double before = first(from, middle, near);
    return before <= 1 ? before : first(middle, until, near);
  }

  static bool boxes_apart(const Long* a, std::size_t a_count, const Long* b, std::size_t b_count, long double reach) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto by_k = [k](const Long& x, const Long& y) { return x[k] < y[k]; };
      const auto of_a = std::minmax_element(a, a + a_count, by_k), of_b = std::minmax_element(b, b + b_count, by_k);
      if ((*of_a.second)[k] + reach < (*of_b.first)[k] || (*of_b.second)[k] + reach < (*of_a.first)[k]) return true;
    }
    return false;
  }

  const std::vector<Part>&mine_, &others_;
  const PlacesAt& places_at_;
  long double speed_;
  const Figure& standing_;
  long double keep_;
};

}  // namespace

long double first_nearer(int dimension, const Figure& body, const PlacesAt& places_at, long double speed,
                         const Figure& standing, long double keep, long double until) {
  return Search(dimension, body, places_at, speed, standing, keep).first(0, until);
}

}  // namespace dsw::rigid
