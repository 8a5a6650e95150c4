// Near rows by their definition (dartsweep/near.h), in exact rational arithmetic and by brute force.
#pragma once

#include "mesh.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
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
        features_[chosen];
      }
    }
    for (auto& feature : features_) {
      const Ids& ids = feature.first;
      Ids& neighbours = feature.second;
      for (const Ids& each : scene.obstacles) {
        if (!std::all_of(ids.begin(), ids.end(), [&](int v) { return has(each, v); })) continue;
        std::copy_if(each.begin(), each.end(), std::back_inserter(neighbours), [&](int v) { return !has(ids, v); });
      }
    }
  }

  /// All pairs of a part with obstacles not farther than `limit`, and a little more.
  Rows rows_of(const std::vector<Vec>& part, double limit) const {
    Rows rows;
    for (const auto& [ids, neighbours] : features_) {
      std::vector<Vec> corners;
      for (const int v : ids) corners.push_back(scene_.points[static_cast<size_t>(v)]);
      if (part.size() + corners.size() > static_cast<size_t>(scene_.dimension) + 1) continue;
      if (apart(part, corners) > 1.001 * limit + 1e-300) continue;
      Row row;
      if (measure(part, corners, neighbours, row)) rows[ids] = row;
    }
    return rows;
  }

 private:
  using Q = mpq_class;
  using Q3 = std::array<Q, 3>;
  static Q3 exact(const Vec& a) { return {Q(a[0]), Q(a[1]), Q(a[2])}; }
  static Q3 minus(const Q3& a, const Q3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Q dot(const Q3& a, const Q3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Q3 cross(const Q3& a, const Q3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static bool has(const Ids& ids, int v) { return std::find(ids.begin(), ids.end(), v) != ids.end(); }

  static double apart(const std::vector<Vec>& a, const std::vector<Vec>& b) {
    double most = 0;
    for (size_t k = 0; k < 3; ++k) {
      const auto less = [k](const Vec& p, const Vec& q) { return p[k] < q[k]; };
      const auto [a0, a1] = std::minmax_element(a.begin(), a.end(), less);
      const auto [b0, b1] = std::minmax_element(b.begin(), b.end(), less);
      most = std::max({most, (*b0)[k] - (*a1)[k], (*a0)[k] - (*b1)[k]});
    }
    return most;
  }

  /// Weights by the normal equations of the least distance; false unless they are unique and positive.
  static bool solve(const std::vector<Q3>& p, const std::vector<Q3>& a, std::vector<Q>& s, std::vector<Q>& t) {
    std::vector<Q3> ways;
    for (size_t i = 1; i < p.size(); ++i) ways.push_back(minus(p[i], p[0]));
    for (size_t i = 1; i < a.size(); ++i) ways.push_back(minus(a[0], a[i]));
    const Q3 rest = minus(a[0], p[0]);
    std::vector<Q> z;
    if (ways.size() == 1) {
      const Q square = dot(ways[0], ways[0]);
      if (square == 0) return false;
      z = {dot(ways[0], rest) / square};
    } else if (ways.size() == 2) {
      const Q m00 = dot(ways[0], ways[0]), m01 = dot(ways[0], ways[1]), m11 = dot(ways[1], ways[1]);
      const Q r0 = dot(ways[0], rest), r1 = dot(ways[1], rest), det = m00 * m11 - m01 * m01;
      if (det == 0) return false;
      z = {(r0 * m11 - r1 * m01) / det, (m00 * r1 - m01 * r0) / det};
    }
    const auto take = [&](size_t from, size_t count, std::vector<Q>& weights) {
      weights.assign(1, Q(1));
      for (size_t i = 0; i < count; ++i) {
        weights.push_back(z[from + i]);
        weights[0] -= z[from + i];
      }
      return std::all_of(weights.begin(), weights.end(), [](const Q& w) { return w > 0; });
    };
    return take(0, p.size() - 1, s) && take(p.size() - 1, a.size() - 1, t);
  }
  static Q3 sum(const std::vector<Q3>& points, const std::vector<Q>& weights) {
    Q3 all{};
    for (size_t i = 0; i < points.size(); ++i) {
      for (size_t k = 0; k < 3; ++k) all[k] += weights[i] * points[i][k];
    }
    return all;
  }

  bool measure(const std::vector<Vec>& part, const std::vector<Vec>& corners, const Ids& neighbours, Row& row) const {
    std::vector<Q3> p, a;
    for (const Vec& v : part) p.push_back(exact(v));
    // Simulation of Simplicity: a vertex is shifted, by less than any sign needs.
    const Q3 unshifted = p[0];
    const size_t axes = scene_.is_shifted && part.size() == 1 ? static_cast<size_t>(scene_.dimension) : 0;
    for (size_t k = 0; k < axes; ++k) {
      p[0][k] += Q(mpz_class(1), mpz_class(1) << static_cast<unsigned>(2400 * (k + 1)));
    }
    for (const Vec& v : corners) a.push_back(exact(v));
    std::vector<Q> s, t;
    if (!solve(p, a, s, t)) return false;
    Q3 x = sum(p, s), y = sum(a, t), way = minus(x, y);
    bool before = false, behind = false;
    bool is_minimum = std::all_of(neighbours.begin(), neighbours.end(), [&](int v) {
      const Q3 z = minus(exact(scene_.points[static_cast<size_t>(v)]), y);
      const Q closer = dot(z, way);
      if (closer == 0 && part.size() == 2 && corners.size() == 2 && dot(way, way) != 0) {
        const Q3 u = minus(a[1], a[0]);
        const Q share = dot(z, u) / dot(u, u);
        Q3 across = z;
        for (size_t k = 0; k < 3; ++k) across[k] -= share * u[k];
        (dot(across, minus(p[1], p[0])) > 0 ? before : behind) = true;
      }
      return closer <= 0;
    });
    is_minimum = is_minimum && !(before && behind);  // it runs along two faces there
    if (part.size() == 1) {
      x = unshifted;
      y = sum(a, t);
      way = minus(x, y);
    }
    row.distance = root(dot(way, way));
    for (size_t k = 0; k < 3; ++k) {
      row.point[k] = x[k].get_d();
      row.obstacle_point[k] = y[k].get_d();
    }
    for (const Q& w : s) row.weights.push_back(w.get_d());
    for (const Q& w : t) row.obstacle_weights.push_back(w.get_d());
    const Walls walls = walls_at(row);
    row.sight = sight(x, y, row.distance, walls);
    if (is_minimum || part.size() == 1) return is_minimum;
    // What lies exactly on a wall is shifted to one side of it. It does not see what comes closer on the other side.
    row.sight = std::max(row.sight, Sight::kDoubtful);
    return std::any_of(walls.begin(), walls.end(), [&](const std::vector<Vec>& wall) { return is_on(x, wall); });
  }
  /// Where the square itself is out of the range of doubles, too.
  static double root(const Q& square) {
    if (square == 0) return 0;
    mpf_class wide(0, 256);
    wide = square;
    return mpf_class(sqrt(wide)).get_d();
  }

  using Walls = std::vector<std::vector<Vec>>;
  /// Those whose boxes the way of a row comes to.
  Walls walls_at(const Row& row) const {
    const std::vector<Vec> way = {{row.point[0], row.point[1], row.point[2]},
                                  {row.obstacle_point[0], row.obstacle_point[1], row.obstacle_point[2]}};
    Walls walls;
    for (const Ids& wall : scene_.walls) {
      std::vector<Vec> corners;
      for (const int v : wall) corners.push_back(scene_.wall_points[static_cast<size_t>(v)]);
      if (apart(way, corners) <= 1e-6 * row.distance + 2 * scene_.tolerance) walls.push_back(corners);
    }
    return walls;
  }
  Sight sight(const Q3& x, const Q3& y, double distance, const Walls& walls) const {
    Sight worst = Sight::kClear;
    for (const std::vector<Vec>& wall : walls) {
      worst = std::max(worst, past(x, y, distance, wall));
      if (worst == Sight::kHidden) break;
    }
    return worst;
  }
  /// A wall as a triangle; in the plane the third corner is above.
  std::vector<Q3> triangle_of(const std::vector<Vec>& wall) const {
    std::vector<Q3> a;
    for (const Vec& v : wall) a.push_back(exact(v));
    if (scene_.dimension == 2) a.push_back({a[0][0], a[0][1], 1});
    return a;
  }
  bool is_on(const Q3& x, const std::vector<Vec>& wall) const {
    const std::vector<Q3> a = triangle_of(wall);
    if (scene_.dimension == 2) {
      const Q3 u = minus(a[1], a[0]), w = minus(x, a[0]);
      return cross(u, w)[2] == 0 && dot(u, w) >= 0 && dot(u, w) <= dot(u, u);
    }
    const Q3 n = cross(minus(a[1], a[0]), minus(a[2], a[0]));
    bool inside = dot(n, minus(x, a[0])) == 0;
    for (size_t i = 0; inside && i < 3; ++i) {
      inside = dot(n, cross(minus(a[(i + 1) % 3], a[i]), minus(x, a[i]))) >= 0;
    }
    return inside;
  }
  /// Whether one wall hides y from x. What passes its rim within the tolerance, or begins or ends at it, is in doubt.
  Sight past(const Q3& x, const Q3& y, double distance, const std::vector<Vec>& wall) const {
    const std::vector<Q3> a = triangle_of(wall);
    const Q3 n = cross(minus(a[1], a[0]), minus(a[2], a[0]));
    const Q at_x = dot(n, minus(x, a[0])), at_y = dot(n, minus(y, a[0]));
    if (at_x == 0 && at_y == 0) return Sight::kDoubtful;
    if (sgn(at_x) * sgn(at_y) > 0) return Sight::kClear;
    const Q time = at_x / (at_x - at_y);
    Q3 m = x;
    for (size_t k = 0; k < 3; ++k) m[k] += time * (y[k] - x[k]);
    // How far inside of each side the wall's plane is met.
    double inside = HUGE_VAL;
    if (scene_.dimension == 2) {
      const Q3 u = minus(a[1], a[0]);
      const double length = root(dot(u, u));
      const Q along = dot(minus(m, a[0]), u) / dot(u, u);
      inside = length * std::min(along.get_d(), Q(1 - along).get_d());
    } else {
      const double area = root(dot(n, n));
      for (size_t i = 0; i < 3; ++i) {
        const Q3 side = minus(a[(i + 2) % 3], a[(i + 1) % 3]);
        const Q share = dot(n, cross(side, minus(m, a[(i + 1) % 3]))) / dot(n, n);
        inside = std::min(inside, share.get_d() * (area / root(dot(side, side))));
      }
    }
    if (inside < -scene_.tolerance) return Sight::kClear;
    if (at_y == 0) return Sight::kClear;  // it ends there
    const double from_x = time.get_d() * distance, from_y = Q(1 - time).get_d() * distance;
    return std::min({inside, from_x, from_y}) < scene_.tolerance ? Sight::kDoubtful : Sight::kHidden;
  }

  const Scene& scene_;
  std::map<Ids, Ids> features_;  // with the other vertices of obstacles that hold them
};

}  // namespace dsw::oracle
