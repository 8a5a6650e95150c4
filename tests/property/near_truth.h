// Near rows by their definition (dartsweep/near.h), in exact integer arithmetic and by brute force.
#pragma once

#include "mesh.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace dsw::oracle {

class NearTruth {
 public:
  using Ids = std::vector<int>;  // of points, ascending

  /// What is near, and what hides it: triangles are walls, in the plane segments are.
  struct Scene {
    int dimension = 3;
    std::vector<Vec> points;
    std::vector<Ids> obstacles;
    std::vector<Vec> wall_points;
    std::vector<Ids> walls;
    double tolerance = 0;    // of what hides what
    bool is_shifted = true;  // by Simulation of Simplicity: of the environment
  };
  enum class Sight { kClear, kDoubtful, kHidden };
  struct Row {
    double distance;
    std::array<double, 3> point, obstacle_point;
    std::vector<double> weights, obstacle_weights;
    Sight sight;
  };
  /// By the obstacle's vertices.
  using Rows = std::map<Ids, Row>;

  explicit NearTruth(const Scene& scene) : scene_(scene) {
    for (const Ids& each : scene.obstacles) {
      for (uint32_t bits = 1; bits < 1u << each.size(); ++bits) {
        Ids chosen;
        for (size_t i = 0; i < each.size(); ++i) {
          if ((bits >> i & 1) != 0) chosen.push_back(each[i]);
        }
        std::sort(chosen.begin(), chosen.end());
        Feature& feature = features_[chosen];
        feature.box = box_of(scene.points, chosen);
        std::copy_if(each.begin(), each.end(), std::back_inserter(feature.neighbours),
                     [&](int v) { return !has(chosen, v); });
      }
    }
    for (const Ids& wall : scene.walls) wall_boxes_.push_back(box_of(scene.wall_points, wall));
    power_ = power_of(scene.wall_points, power_of(scene.points, 0));
  }

  /// All pairs of a part with obstacles not farther than `limit`, and a little more.
  Rows rows_of(const std::vector<Vec>& part, double limit) const {
    const Asked asked{part, 1.001 * limit + 1e-300, power_of(part, power_)};
    const Box box = box_of(part);
    Rows rows;
    for (const auto& [ids, feature] : features_) {
      if (part.size() + ids.size() > static_cast<size_t>(scene_.dimension) + 1) continue;
      if (apart(box, feature.box) > asked.limit) continue;
      Row row;
      if (measure(asked, ids, feature.neighbours, row)) rows[ids] = row;
    }
    return rows;
  }

 private:
  using Z = mpz_class;
  using Z3 = std::array<Z, 3>;
  using Points = std::vector<Z3>;
  static Z3 minus(const Z3& a, const Z3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Z3 times(const Z& s, const Z3& a) { return {s * a[0], s * a[1], s * a[2]}; }
  static Z dot(const Z3& a, const Z3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Z3 cross(const Z3& a, const Z3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static mpq_class quotient(const Z& a, const Z& b) {
    mpq_class q(a, b);
    q.canonicalize();
    return q;
  }
  static double ratio(const Z& a, const Z& b) { return quotient(a, b).get_d(); }
  /// Of a quotient. Its own square may be out of the range of doubles.
  static double root(const Z& a, const Z& b) {
    if (a == 0) return 0;
    mpf_class wide(0, 256);
    wide = quotient(a, b);
    return mpf_class(sqrt(wide)).get_d();
  }
  static bool has(const Ids& ids, int v) { return std::find(ids.begin(), ids.end(), v) != ids.end(); }

  struct Box {
    Vec least, most;
  };
  static Box box_of(const std::vector<Vec>& points) {
    Box box{points[0], points[0]};
    for (const Vec& p : points) {
      for (size_t k = 0; k < 3; ++k) {
        box.least[k] = std::min(box.least[k], p[k]);
        box.most[k] = std::max(box.most[k], p[k]);
      }
    }
    return box;
  }
  static std::vector<Vec> chosen_of(const std::vector<Vec>& points, const Ids& ids) {
    std::vector<Vec> chosen;
    for (const int v : ids) chosen.push_back(points[static_cast<size_t>(v)]);
    return chosen;
  }
  static Box box_of(const std::vector<Vec>& points, const Ids& ids) { return box_of(chosen_of(points, ids)); }
  static double apart(const Box& a, const Box& b) {
    double most = 0;
    for (size_t k = 0; k < 3; ++k) most = std::max({most, b.least[k] - a.most[k], a.least[k] - b.most[k]});
    return most;
  }

  /// The least n not below `least` so that all coordinates times 2^n are integers.
  static int power_of(const std::vector<Vec>& points, int least) {
    for (const Vec& p : points) {
      for (const double x : p) {
        while (std::floor(std::ldexp(x, least)) != std::ldexp(x, least)) ++least;
      }
    }
    return least;
  }
  /// Times 2^power, which makes integers.
  static Z exact(double x, int power) {
    int exponent = 0;
    const Z mantissa(std::ldexp(std::frexp(x, &exponent), 53));
    const int shift = exponent - 53 + power;
    return shift < 0 ? Z(mantissa >> static_cast<unsigned>(-shift)) : Z(mantissa << static_cast<unsigned>(shift));
  }
  static Z3 exact(const Vec& a, int power) { return {exact(a[0], power), exact(a[1], power), exact(a[2], power)}; }
  static Points exact(const std::vector<Vec>& a, int power) {
    Points points;
    for (const Vec& v : a) points.push_back(exact(v, power));
    return points;
  }

  /// A part, and the power for it and the scene.
  struct Asked {
    const std::vector<Vec>& part;
    double limit;
    int power;
  };
  /// Where a part and an obstacle are nearest. Weights have the sum `over`; points are multiplied by it.
  struct Nearest {
    std::vector<Z> s, t;
    Z over;
    Z3 x, y;
  };

  /// By the normal equations of the least distance. False if the weights aren't unique and positive.
  /// `tie` becomes true if one is 0 and none is negative.
  static bool solve(const Points& p, const Points& a, Nearest& nearest, bool& tie) {
    Points ways;
    for (size_t i = 1; i < p.size(); ++i) ways.push_back(minus(p[i], p[0]));
    for (size_t i = 1; i < a.size(); ++i) ways.push_back(minus(a[0], a[i]));
    const Z3 rest = minus(a[0], p[0]);
    std::vector<Z> z;
    nearest.over = 1;
    if (ways.size() == 1) {
      nearest.over = dot(ways[0], ways[0]);
      z = {dot(ways[0], rest)};
    } else if (ways.size() == 2) {
      const Z m00 = dot(ways[0], ways[0]), m01 = dot(ways[0], ways[1]), m11 = dot(ways[1], ways[1]);
      const Z r0 = dot(ways[0], rest), r1 = dot(ways[1], rest);
      nearest.over = m00 * m11 - m01 * m01;
      z = {r0 * m11 - r1 * m01, m00 * r1 - m01 * r0};
    }
    if (nearest.over == 0) return false;
    int least = 1;
    const auto take = [&](size_t from, const Points& points, std::vector<Z>& weights, Z3& sum) {
      weights.assign(1, nearest.over);
      for (size_t i = 0; i + 1 < points.size(); ++i) {
        weights.push_back(z[from + i]);
        weights[0] -= z[from + i];
      }
      sum = {0, 0, 0};
      for (size_t i = 0; i < points.size(); ++i) {
        least = std::min(least, sgn(weights[i]));
        for (size_t k = 0; k < 3; ++k) sum[k] += weights[i] * points[i][k];
      }
    };
    take(0, p, nearest.s, nearest.x);
    take(p.size() - 1, a, nearest.t, nearest.y);
    tie = tie || least == 0;
    return least > 0;
  }

  /// Whether nothing of the obstacles comes closer beside `nearest`. `tie` becomes true if something is as near.
  static bool is_minimum(const Nearest& nearest, const Points& p, const Points& a, const Points& beside, bool& tie) {
    const Z3 way = minus(nearest.x, nearest.y);
    bool before = false, behind = false;
    for (const Z3& v : beside) {
      const Z3 z = minus(times(nearest.over, v), nearest.y);
      const int closer = sgn(dot(z, way));
      if (closer > 0) return false;
      if (closer < 0) continue;
      tie = true;
      if (p.size() == 2 && a.size() == 2 && dot(way, way) != 0) {
        // What of z is across the obstacle, times the square of the obstacle's length.
        const Z3 u = minus(a[1], a[0]), across = minus(times(dot(u, u), z), times(dot(z, u), u));
        (dot(across, minus(p[1], p[0])) > 0 ? before : behind) = true;
      }
    }
    return !(before && behind);  // else it runs along two faces there
  }

  bool measure(const Asked& asked, const Ids& ids, const Ids& neighbours, Row& row) const {
    Points p = exact(asked.part, asked.power), a = exact(chosen_of(scene_.points, ids), asked.power);
    Points beside = exact(chosen_of(scene_.points, neighbours), asked.power);
    Nearest nearest;
    bool tie = false, is_inside = solve(p, a, nearest, tie);
    bool is_least = is_inside && is_minimum(nearest, p, a, beside, tie);
    if (tie && (is_least || !is_inside) && asked.part.size() == 1 && scene_.is_shifted) {
      // Simulation of Simplicity: a vertex is shifted, by less than any sign needs that is not 0.
      constexpr unsigned kFiner = 2400 * 3;
      for (Points* each : {&p, &a, &beside}) {
        for (Z3& v : *each) v = times(Z(1) << kFiner, v);
      }
      const Z3 unshifted = p[0];
      for (size_t k = 0; k < static_cast<size_t>(scene_.dimension); ++k) {
        p[0][k] += Z(1) << static_cast<unsigned>(kFiner - 2400 * (k + 1));
      }
      is_inside = solve(p, a, nearest, tie);
      is_least = is_inside && is_minimum(nearest, p, a, beside, tie);
      nearest.x = times(nearest.over, unshifted);
      nearest.over <<= kFiner;
      for (Z& w : nearest.s) w <<= kFiner;
      for (Z& w : nearest.t) w <<= kFiner;
    }
    if (!is_inside || (!is_least && asked.part.size() == 1)) return false;
    const Z3 way = minus(nearest.x, nearest.y);
    const Z over = nearest.over << static_cast<unsigned>(asked.power);
    row.distance = root(dot(way, way), over * over);
    if (row.distance > asked.limit) return false;
    for (size_t k = 0; k < 3; ++k) {
      row.point[k] = ratio(nearest.x[k], over);
      row.obstacle_point[k] = ratio(nearest.y[k], over);
    }
    for (const Z& w : nearest.s) row.weights.push_back(ratio(w, nearest.over));
    for (const Z& w : nearest.t) row.obstacle_weights.push_back(ratio(w, nearest.over));
    const std::vector<Points> walls = walls_at(row, asked.power);
    row.sight = Sight::kClear;
    for (const Points& wall : walls) row.sight = std::max(row.sight, past(nearest, row.distance, wall, asked.power));
    if (is_least) return true;
    // What lies exactly on a wall is shifted to one side of it. It does not see what comes closer on the other side.
    row.sight = std::max(row.sight, Sight::kDoubtful);
    return std::any_of(walls.begin(), walls.end(), [&](const Points& wall) { return is_on(nearest, wall); });
  }

  /// Those whose boxes the way of a row comes to, as triangles: in the plane the third corner is above.
  std::vector<Points> walls_at(const Row& row, int power) const {
    const Box way = box_of({row.point, row.obstacle_point});
    std::vector<Points> walls;
    for (size_t i = 0; i < scene_.walls.size(); ++i) {
      if (apart(way, wall_boxes_[i]) > 1e-6 * row.distance + 2 * scene_.tolerance) continue;
      Points wall = exact(chosen_of(scene_.wall_points, scene_.walls[i]), power);
      if (scene_.dimension == 2) wall.push_back({wall[0][0], wall[0][1], 1});
      walls.push_back(wall);
    }
    return walls;
  }
  /// Whether the part's point is on a wall.
  bool is_on(const Nearest& nearest, const Points& a) const {
    const Z3 x = minus(nearest.x, times(nearest.over, a[0])), u = minus(a[1], a[0]);
    if (scene_.dimension == 2) {
      const Z along = dot(u, x);
      return cross(u, x)[2] == 0 && along >= 0 && along <= nearest.over * dot(u, u);
    }
    const Z3 n = cross(u, minus(a[2], a[0]));
    bool inside = dot(n, x) == 0;
    for (size_t i = 0; inside && i < 3; ++i) {
      const Z3 from = minus(nearest.x, times(nearest.over, a[i]));
      inside = dot(n, cross(minus(a[(i + 1) % 3], a[i]), from)) >= 0;
    }
    return inside;
  }
  /// Whether one wall hides y from x. What passes its rim within the tolerance, or begins or ends at it, is in doubt.
  Sight past(const Nearest& nearest, double distance, const Points& a, int power) const {
    const auto& [s, t, over, x, y] = nearest;
    const Z3 n = cross(minus(a[1], a[0]), minus(a[2], a[0]));
    Z at_x = dot(n, minus(x, times(over, a[0]))), at_y = dot(n, minus(y, times(over, a[0])));
    if (at_x == 0 && at_y == 0) return Sight::kDoubtful;
    if (sgn(at_x) * sgn(at_y) > 0) return Sight::kClear;
    if (at_x < 0 || at_y > 0) {
      at_x = -at_x;
      at_y = -at_y;
    }
    // Where the way meets the wall's plane, and how far inside of each side. `m` is multiplied by `by`.
    const Z whole = at_x - at_y, by = whole * over, unit = Z(1) << static_cast<unsigned>(2 * power);
    const Z3 m = minus(times(at_x, y), times(at_y, x));
    double inside = HUGE_VAL;
    if (scene_.dimension == 2) {
      const Z3 u = minus(a[1], a[0]);
      const Z square = dot(u, u), along = dot(minus(m, times(by, a[0])), u);
      inside = root(square, unit) * std::min(ratio(along, by * square), ratio(by * square - along, by * square));
    } else {
      const Z square = dot(n, n);
      for (size_t i = 0; i < 3; ++i) {
        const Z3 &from = a[(i + 1) % 3], side = minus(a[(i + 2) % 3], from);
        const Z share = dot(n, cross(side, minus(m, times(by, from))));
        inside = std::min(inside, ratio(share, by * square) * root(square, dot(side, side) * unit));
      }
    }
    if (inside < -scene_.tolerance) return Sight::kClear;
    if (at_y == 0) return Sight::kClear;  // it ends there
    const double from_x = ratio(at_x, whole) * distance, from_y = ratio(-at_y, whole) * distance;
    return std::min({inside, from_x, from_y}) < scene_.tolerance ? Sight::kDoubtful : Sight::kHidden;
  }

  /// A vertex, edge or triangle of obstacles.
  struct Feature {
    Box box;
    Ids neighbours;  // the other vertices of obstacles that hold it
  };

  const Scene& scene_;
  std::map<Ids, Feature> features_;
  std::vector<Box> wall_boxes_;
  int power_;
};

}  // namespace dsw::oracle
