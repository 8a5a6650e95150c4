// Near rows by their definition (dartsweep/near.h), in exact integer arithmetic and by brute force.
#pragma once

#include "mesh.h"

#include "../gmp_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace dsw::oracle {

class NearTruth {
 public:
  using Ids = std::vector<int>;  // of points, ascending

  /// Passable volumes at an obstacle that can be reached from each other through passable triangles there.
  struct Fan {
    std::vector<size_t> volumes;
    Ids neighbours;  // the other vertices of obstacles at these volumes that hold the obstacle
  };
  /// What is near, and what hides it: triangles are walls, in the plane segments are.
  struct Scene {
    int dimension = 3;
    std::vector<Vec> points;
    std::vector<Ids> obstacles;
    std::vector<Vec> wall_points;
    std::vector<Ids> walls;
    bool is_shifted = true;  // by Simulation of Simplicity: of the environment
    /// The triangles of each passable volume. Only needed if walls with other points lie in one place, or with `fans`.
    std::vector<std::vector<Ids>> volumes;
    /// The fans of each obstacle. Only needed where volumes overlap: elsewhere what is nearest in the fan in which a way
    /// ends is nearest of all.
    std::map<Ids, std::vector<Fan>> fans;
  };
  enum class Sight { kClear, kHidden };
  struct Row {
    double distance;
    std::array<double, 3> point, obstacle_point;
    std::vector<double> weights, obstacle_weights;
    Sight sight;
    bool is_in_all = true;  // of several fans in which the way ends, it is nearest in each
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
    size_ = bits_of(scene.wall_points, bits_of(scene.points, 0));
  }

  /// All pairs of a part with obstacles not farther than `limit`, and a little more.
  Rows rows_of(const std::vector<Vec>& part, double limit) const {
    const Asked asked{part, 1.001 * limit + 1e-300, power_of(part, power_), bits_of(part, size_)};
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
  /// The root of a quotient. The root's own square may be out of the range of doubles.
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
  /// The least n not below `least` so that no coordinate reaches 2^n.
  static int bits_of(const std::vector<Vec>& points, int least) {
    for (const Vec& p : points) {
      for (const double x : p) {
        int exponent = 0;
        std::frexp(x, &exponent);
        least = std::max(least, exponent);
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
    int power, size;

    /// e is 2^-this: so small that no sign in here needs less that is not 0. Signs are those of sums of products of
    /// less than 12 coordinates.
    int tiny() const { return 12 * (power + size) + 400; }
    int fine_power() const { return 3 * tiny(); }
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

  /// What a part and an obstacle are at a power.
  struct Pair {
    Points p, a, beside;
    Nearest nearest;
  };
  Pair pair_of(const Asked& asked, const Ids& ids, const Ids& neighbours, int power) const {
    return {exact(asked.part, power),
            exact(chosen_of(scene_.points, ids), power),
            exact(chosen_of(scene_.points, neighbours), power),
            {}};
  }
  /// Adds (e, e^2, e^3) times `by` at the fine power.
  void shift(const Asked& asked, const Z& by, Z3& x) const {
    for (int k = 0; k < scene_.dimension; ++k) {
      x[static_cast<size_t>(k)] += by << static_cast<unsigned>(asked.fine_power() - (k + 1) * asked.tiny());
    }
  }
  /// With a shifted part: a vertex takes its nearest point along. Else the obstacle's point stands still, or is a
  /// body's.
  Pair shifted_pair(const Asked& asked, const Ids& ids, const Ids& neighbours) const {
    Pair pair = pair_of(asked, ids, neighbours, asked.fine_power());
    const bool takes_along = scene_.is_shifted && asked.part.size() == 1;
    bool tie = false;
    if (takes_along) shift(asked, 1, pair.p[0]);
    solve(pair.p, pair.a, pair.nearest, tie);
    if (takes_along) return pair;
    shift(asked, pair.nearest.over, pair.nearest.x);
    if (!scene_.is_shifted) shift(asked, pair.nearest.over, pair.nearest.y);
    return pair;
  }

  bool measure(const Asked& asked, const Ids& ids, const Ids& neighbours, Row& row) const {
    Pair pair = pair_of(asked, ids, neighbours, asked.power);
    bool tie = false, is_inside = solve(pair.p, pair.a, pair.nearest, tie);
    bool is_least = is_inside && is_minimum(pair.nearest, pair.p, pair.a, pair.beside, tie);
    int power = asked.power;
    if (tie && (is_least || !is_inside) && asked.part.size() == 1 && scene_.is_shifted) {
      pair = shifted_pair(asked, ids, neighbours);
      power = asked.fine_power();
      is_inside = solve(pair.p, pair.a, pair.nearest, tie);
      is_least = is_inside && is_minimum(pair.nearest, pair.p, pair.a, pair.beside, tie);
    }
    if (!is_inside) return false;
    const Nearest& nearest = pair.nearest;
    const Z3 way = minus(nearest.x, nearest.y);
    const Z over = nearest.over << static_cast<unsigned>(power);
    row.distance = root(dot(way, way), over * over);
    if (row.distance > asked.limit || !(is_least || is_least_in_fan(asked, ids, row))) return false;
    for (size_t k = 0; k < 3; ++k) {
      row.point[k] = ratio(nearest.x[k], over);
      row.obstacle_point[k] = ratio(nearest.y[k], over);
    }
    for (const Z& w : nearest.s) row.weights.push_back(ratio(w, nearest.over));
    for (const Z& w : nearest.t) row.obstacle_weights.push_back(ratio(w, nearest.over));
    row.sight = is_hidden(asked, ids, neighbours, pair, power, row) ? Sight::kHidden : Sight::kClear;
    return true;
  }

  /// Whether there is a fan in which the way ends, and nothing of it comes closer.
  bool is_least_in_fan(const Asked& asked, const Ids& ids, Row& row) const {
    const auto found = scene_.fans.find(ids);
    if (found == scene_.fans.end()) return false;
    const bool is_vertex = asked.part.size() == 1;
    std::vector<bool> is_least;
    for (const Fan& fan : found->second) {
      Pair pair =
          is_vertex ? shifted_pair(asked, ids, fan.neighbours) : pair_of(asked, ids, fan.neighbours, asked.power);
      bool tie = false;
      if (!is_vertex) solve(pair.p, pair.a, pair.nearest, tie);
      is_least.push_back(is_minimum(pair.nearest, pair.p, pair.a, pair.beside, tie));
    }
    if (std::count(is_least.begin(), is_least.end(), true) == 0) return false;
    const Nearest way = shifted_pair(asked, ids, {}).nearest;
    bool is_one = false;
    for (size_t i = 0; i < is_least.size(); ++i) {
      if (!arrives(asked, way, ids, &found->second[i].volumes)) continue;
      is_one = is_one || is_least[i];
      row.is_in_all = row.is_in_all && is_least[i];
    }
    return is_one;
  }

  /// Whether a wall stands between both points. Walls that have the whole obstacle end at it.
  bool is_hidden(const Asked& asked, const Ids& ids, const Ids& neighbours, const Pair& pair, int power,
                 const Row& row) const {
    const Box way = box_of({row.point, row.obstacle_point});
    std::vector<size_t> open;
    for (size_t i = 0; i < scene_.walls.size(); ++i) {
      const Ids& wall = scene_.walls[i];
      if (apart(way, wall_boxes_[i]) > 1e-6 * row.distance + std::ldexp(1, asked.size - 40)) continue;
      if (scene_.is_shifted && std::all_of(ids.begin(), ids.end(), [&](int v) { return has(wall, v); })) continue;
      const Past past = passes(pair.nearest, exact(chosen_of(scene_.wall_points, wall), power));
      if (past == Past::kThrough) return true;
      if (past == Past::kOpen) open.push_back(i);
    }
    if (open.empty()) return false;
    const Pair shifted = shifted_pair(asked, ids, neighbours);
    bool ends_at_other = false;
    for (const size_t i : open) {
      const Points wall = exact(chosen_of(scene_.wall_points, scene_.walls[i]), asked.fine_power());
      const Past past = passes(shifted.nearest, wall);
      if (past == Past::kThrough) return true;
      ends_at_other = ends_at_other || past == Past::kOpen;
    }
    return ends_at_other && scene_.fans.empty() && !scene_.volumes.empty() && !arrives(asked, shifted.nearest, ids);
  }

  /// Whether a segment passes a wall. Open: at least one of its ends or the wall's rim is touched.
  enum class Past { kClear, kOpen, kThrough };
  static int plane_sign(const Z3& x, const Z& over, const Points& a) {
    const Z3 from = minus(x, times(over, a[0])), u = minus(a[1], a[0]);
    return sgn(a.size() == 2 ? cross(u, from)[2] : dot(cross(u, minus(a[2], a[0])), from));
  }
  static Past passes(const Nearest& nearest, const Points& a) {
    const auto& [s, t, over, x, y] = nearest;
    const int at_x = plane_sign(x, over, a), at_y = plane_sign(y, over, a);
    if (at_x * at_y > 0) return Past::kClear;
    int least = 1, most = -1;
    for (size_t i = 0; i < a.size(); ++i) {
      const Z3 by = cross(minus(x, times(over, a[i])), minus(y, times(over, a[i])));
      // In the plane both ends of the wall, on sides that have to differ.
      const int side = a.size() == 2 ? (i == 0 ? 1 : -1) * sgn(by[2]) : sgn(dot(by, minus(a[(i + 1) % 3], a[i])));
      least = std::min(least, side);
      most = std::max(most, side);
    }
    if (least < 0 && most > 0) return Past::kClear;
    return at_x * at_y < 0 && least * most > 0 ? Past::kThrough : Past::kOpen;
  }

  /// Whether the segment comes to its end through a volume that has the obstacle; `only`: through one of these.
  bool arrives(const Asked& asked, const Nearest& nearest, const Ids& ids,
               const std::vector<size_t>* only = nullptr) const {
    const auto bits = static_cast<unsigned>(asked.tiny());
    Z3 before = times((Z(1) << bits) - 1, nearest.y);
    for (size_t k = 0; k < 3; ++k) before[k] += nearest.x[k];
    Nearest ray{{}, {}, nearest.over << bits, before, before};
    const Z far = ray.over << static_cast<unsigned>(asked.size + asked.fine_power() + 4);
    for (size_t k = 0; k < static_cast<size_t>(scene_.dimension); ++k) ray.y[k] += far * std::array{1009, 613, 389}[k];
    const auto is_in = [&](const std::vector<Ids>& triangles) {
      const auto is_there = [&](int v) {
        return std::any_of(triangles.begin(), triangles.end(), [&](const Ids& each) { return has(each, v); });
      };
      if (!std::all_of(ids.begin(), ids.end(), is_there)) return false;
      return std::count_if(triangles.begin(), triangles.end(),
                           [&](const Ids& each) {
                             const Points wall = exact(chosen_of(scene_.wall_points, each), asked.fine_power());
                             return passes(ray, wall) == Past::kThrough;
                           }) %
                 2 ==
             1;
    };
    if (only == nullptr) return std::any_of(scene_.volumes.begin(), scene_.volumes.end(), is_in);
    return std::any_of(only->begin(), only->end(), [&](size_t volume) { return is_in(scene_.volumes[volume]); });
  }

  /// A vertex, edge or triangle of obstacles.
  struct Feature {
    Box box;
    Ids neighbours;  // the other vertices of obstacles that hold it
  };

  const Scene& scene_;
  std::map<Ids, Feature> features_;
  std::vector<Box> wall_boxes_;
  int power_, size_;
};

}  // namespace dsw::oracle
