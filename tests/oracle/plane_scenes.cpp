#include "plane_scenes.h"

#include <algorithm>
#include <map>
#include <set>

namespace dsw::oracle::plane {
namespace {

using Point = std::array<int64_t, 2>;
using Loop = std::vector<int>;

int64_t area2(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether d lies strictly inside the circle round the counter-clockwise triangle abc. Coordinates are small.
bool in_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
  __extension__ using Wide = __int128;
  Wide m[3][3];
  const Point* row[3] = {&a, &b, &c};
  for (size_t i = 0; i < 3; ++i) {
    const Wide x = (*row[i])[0] - d[0], y = (*row[i])[1] - d[1];
    m[i][0] = x, m[i][1] = y, m[i][2] = x * x + y * y;
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) >
         0;
}

/// Bowyer and Watson. False: the points gave a flat triangle.
bool delaunay(Rng& rng, int count, int size, std::vector<Point>& points, std::vector<Loop>& cells) {
  const int64_t far = 40ll * size;
  std::vector<Point> p = {{-far, -far}, {3 * far, -far}, {-far, 3 * far}};
  std::vector<Loop> triangles = {{0, 1, 2}};
  std::set<Point> used;
  while (static_cast<int>(p.size()) < count + 3) {
    const Point q = {rng.between(0, size), rng.between(0, size)};
    if (!used.insert(q).second) continue;
    const int index = static_cast<int>(p.size());
    p.push_back(q);
    const auto at = [&](int i) -> const Point& { return p[static_cast<size_t>(i)]; };
    std::vector<Loop> keep;
    std::set<std::pair<int, int>> rim;
    for (const Loop& t : triangles) {
      if (!in_circle(at(t[0]), at(t[1]), at(t[2]), q)) {
        keep.push_back(t);
        continue;
      }
      for (size_t k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        if (rim.erase({b, a}) == 0) rim.insert({a, b});
      }
    }
    for (const auto& [a, b] : rim) {
      if (area2(at(a), at(b), q) <= 0) return false;
      keep.push_back({a, b, index});
    }
    triangles = keep;
  }
  points.assign(p.begin() + 3, p.end());
  cells.clear();
  for (const Loop& t : triangles) {
    if (*std::min_element(t.begin(), t.end()) >= 3) cells.push_back({t[0] - 3, t[1] - 3, t[2] - 3});
  }
  return !cells.empty();
}

/// Quads over ascending coordinates.
void grid(const std::vector<double>& xs, const std::vector<double>& ys, World& world) {
  for (double y : ys) {
    for (double x : xs) world.points.push_back({x, y});
  }
  const int n = static_cast<int>(xs.size());
  for (int y = 0; y + 1 < static_cast<int>(ys.size()); ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const int a = x + n * y;
      world.cells.push_back({a, a + 1, a + 1 + n, a + n});
    }
  }
}

/// A quad that is no star becomes two triangles.
void split_bad_quads(World& world) {
  const std::vector<Loop> quads = world.cells;
  world.cells.clear();
  for (const Loop& q : quads) {
    const Loop one = {q[0], q[1], q[2]}, two = {q[0], q[2], q[3]};
    if (is_star(world.points, q)) {
      world.cells.push_back(q);
    } else if (is_star(world.points, one) && is_star(world.points, two)) {
      world.cells.insert(world.cells.end(), {one, two});
    } else {
      world.cells.insert(world.cells.end(), {{q[1], q[2], q[3]}, {q[1], q[3], q[0]}});
    }
  }
}

void jittered(Rng& rng, World& world, const std::vector<double>& x, const std::vector<double>& y, int jitter) {
  grid(x, y, world);
  for (Vec& p : world.points) {
    for (double& each : p) each += rng.between(-jitter, jitter);
  }
  split_bad_quads(world);
}

/// Joins cells over a side while the result is a star; some of them, so that neighbours differ.
void join(Rng& rng, World& world) {
  for (int tries = 0, most = static_cast<int>(world.cells.size()); tries < most; ++tries) {
    world.link();
    const Side side = world.sides[rng.below(world.sides.size())];
    if (side.cell[1] < 0) continue;
    const Loop &one = world.cells[static_cast<size_t>(side.cell[0])],
               &two = world.cells[static_cast<size_t>(side.cell[1])];
    Loop all;
    for (size_t i = 1; i <= one.size(); ++i) all.push_back(one[(static_cast<size_t>(side.local[0]) + i) % one.size()]);
    for (size_t i = 2; i < two.size(); ++i) all.push_back(two[(static_cast<size_t>(side.local[1]) + i) % two.size()]);
    std::set<int> distinct(all.begin(), all.end());
    if (distinct.size() != all.size() || all.size() > 9 || !is_star(world.points, all)) continue;
    world.cells[static_cast<size_t>(side.cell[0])] = all;
    world.cells.erase(world.cells.begin() + side.cell[1]);
  }
}

void triangles(Rng& rng, int count, int size, World& world) {
  std::vector<Point> points;
  while (!delaunay(rng, count, size, points, world.cells)) {
  }
  for (const Point& p : points) world.points.push_back({static_cast<double>(p[0]), static_cast<double>(p[1])});
}

void stretch(World& world, double x, double y) {
  for (Vec& p : world.points) p = {p[0] * x, p[1] * y};
}

/// Makes a cell of the circumcentres round each point that has triangles all round. The circumcentres are rounded, so
/// three of them need not be in line.
void dual(const World& of, World& world) {
  std::vector<std::map<int, std::pair<int, int>>> fans(
      of.points.size());  // by point: from one neighbour to triangle and next one
  for (const Loop& t : of.cells) {
    const Vec &a = of.points[static_cast<size_t>(t[0])], &b = of.points[static_cast<size_t>(t[1])],
              &c = of.points[static_cast<size_t>(t[2])];
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1], d = 2 * (bx * cy - by * cx);
    const int index = static_cast<int>(world.points.size());
    world.points.push_back({a[0] + (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d,
                            a[1] + (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d});
    for (size_t k = 0; k < 3; ++k) fans[static_cast<size_t>(t[k])][t[(k + 1) % 3]] = {index, t[(k + 2) % 3]};
  }
  for (const auto& fan : fans) {
    Loop cell;
    int at = fan.empty() ? -1 : fan.begin()->first;
    for (size_t i = 0; i < fan.size() && fan.count(at) != 0; ++i) {
      cell.push_back(fan.at(at).first);
      at = fan.at(at).second;
    }
    const bool closed = !fan.empty() && cell.size() == fan.size() && at == fan.begin()->first;
    if (closed && is_star(world.points, cell)) world.cells.push_back(cell);
  }
}

/// A square cut by lines, each through one cell only: where a cut ends, the neighbour has a vertex in a row with
/// others.
void cut(Rng& rng, World& world, int count) {
  world.points = {{0, 0}, {64, 0}, {64, 64}, {0, 64}};
  world.cells = {{0, 1, 2, 3}};
  for (int tries = 0; tries < 4 * count && static_cast<int>(world.cells.size()) < count; ++tries) {
    const size_t c = rng.below(world.cells.size());
    const Loop cell = world.cells[c];
    const size_t n = cell.size(), i = rng.below(n), j = (i + 1 + rng.below(n - 1)) % n;
    int made[2];
    for (size_t end = 0; end < 2; ++end) {
      const size_t k = end == 0 ? i : j;
      const Vec &a = world.points[static_cast<size_t>(cell[k])],
                &b = world.points[static_cast<size_t>(cell[(k + 1) % n])];
      const double t = rng.chance(0.5) ? 0.5 : rng.range(0.2, 0.8);
      made[end] = static_cast<int>(world.points.size());
      world.points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    Loop parts[2];
    for (size_t part = 0; part < 2; ++part) {
      const size_t from = part == 0 ? i : j, to = part == 0 ? j : i;
      parts[part] = {made[part]};
      for (size_t k = from; k != to; k = (k + 1) % n) parts[part].push_back(cell[(k + 1) % n]);
      parts[part].push_back(made[1 - part]);
    }
    std::vector<Loop> cells = world.cells;
    cells[c] = parts[0];
    cells.push_back(parts[1]);
    for (size_t end = 0; end < 2; ++end) {
      const size_t k = end == 0 ? i : j;
      for (size_t other = 0; other + 1 < cells.size(); ++other) {
        if (other == c) continue;
        Loop& loop = cells[other];
        for (size_t m = 0; m < loop.size(); ++m) {
          if (loop[m] != cell[(k + 1) % n] || loop[(m + 1) % loop.size()] != cell[k]) continue;
          loop.insert(loop.begin() + static_cast<ptrdiff_t>(m) + 1, made[end]);
          break;
        }
      }
    }
    const bool stars = std::all_of(cells.begin(), cells.end(), [&](const Loop& l) { return is_star(world.points, l); });
    if (stars) {
      world.cells = cells;
    } else {
      world.points.resize(world.points.size() - 2);
    }
  }
}

void make_lattice(Rng& rng, World& world) {
  const int size = rng.chance(0.5) ? 8 : 32, count = rng.between(4, 30);
  triangles(rng, count, size, world);
}
void make_delaunay(Rng& rng, World& world) { triangles(rng, rng.between(4, 40), 1000, world); }
void make_irrational(Rng& rng, World& world) {
  triangles(rng, rng.between(4, 40), 4096, world);
  stretch(world, 0.31622776601683794, 0.31415926535897931);
}
void make_flat(Rng& rng, World& world) {
  const int rows = rng.between(2, 6), columns = rng.between(2, 6);
  grid(axis(columns, 8), axis(rows, 8), world);
}
void make_quads(Rng& rng, World& world) {
  const int n = rng.between(2, 5);
  jittered(rng, world, axis(n, 8), axis(n, 8), rng.between(1, 3));
}
void make_warped(Rng& rng, World& world) {
  grid(axis(5, 1), axis(5, 1), world);
  for (Vec& p : world.points) {
    for (double& x : p) x += rng.range(-0.3, 0.3);
  }
  split_bad_quads(world);
}
void make_wide(Rng& rng, World& world) { jittered(rng, world, axis(4, 64), axis(3, 64), rng.chance(0.5) ? 0 : 12); }
void make_polygons(Rng& rng, World& world) {
  make_delaunay(rng, world);
  join(rng, world);
}
void make_joined(Rng& rng, World& world) {
  make_flat(rng, world);
  join(rng, world);
}
void make_voronoi(Rng& rng, World& world) {
  while (world.cells.empty()) {
    World sites;
    triangles(rng, rng.between(12, 40), 1000, sites);
    world.points.clear();
    dual(sites, world);
  }
}
void make_cut(Rng& rng, World& world) { cut(rng, world, rng.between(2, 25)); }
void make_slivers(Rng& rng, World& world) {
  make_delaunay(rng, world);
  stretch(world, 1.1, 1e-12);
}
void make_thin(Rng&, World& world) { grid({0, 1, 1 + 1e-12, 1 + 2e-12, 2}, {0, 1e-12, 1, 2}, world); }

}  // namespace

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"triangles_lattice", make_lattice, true, true, false},
      {"triangles", make_delaunay, true, true, false},
      {"triangles_irrational", make_irrational, false, true, false},
      {"quads_flat", make_flat, true, false, false},
      {"quads", make_quads, true, false, false},
      {"quads_warped", make_warped, false, false, false},
      {"wide", make_wide, true, false, false},
      {"polygons", make_polygons, true, false, false},
      {"joined", make_joined, true, false, false},
      {"voronoi", make_voronoi, false, false, false},
      {"cut", make_cut, false, false, false},
      {"slivers", make_slivers, false, true, true},
      {"thin", make_thin, false, false, true},
  };
  return all;
}

std::vector<Turn> turns(const std::string& only) {
  std::vector<Turn> list;
  for (const Kind& kind : kinds()) {
    if (!only.empty() && only != kind.name) continue;
    const bool rooms = std::string("wide") == kind.name || std::string("quads_flat") == kind.name;
    for (int i = 0; i < (rooms ? 6 : 4); ++i) list.push_back({&kind, Transform::kNone});
    if (!kind.fine) list.push_back({&kind, Transform::kFar});
    for (Transform t : {Transform::kLarge, Transform::kSmall, Transform::kPower, Transform::kVast, Transform::kTiny}) {
      list.push_back({&kind, t});
    }
    if (!kind.integer) continue;
    list.push_back({&kind, Transform::kDenormal});
    list.push_back({&kind, Transform::kCoarse});
  }
  return list;
}

World make_world(const Turn& turn, Rng& rng) {
  World world;
  turn.kind->make(rng, world);
  for (size_t i = world.cells.size(); i > 1; --i) std::swap(world.cells[i - 1], world.cells[rng.below(i)]);
  for (Vec& p : world.points) p = {transformed(p[0], turn.transform), transformed(p[1], turn.transform)};
  world.lattice = turn.kind->integer;
  world.link();
  for (uint32_t& tag : world.tags) tag = static_cast<uint32_t>(rng.next());
  return world;
}

}  // namespace dsw::oracle::plane
