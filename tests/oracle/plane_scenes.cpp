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

/// A jittered grid; a quad that is no star becomes two triangles.
void quads(Rng& rng, int n, std::vector<Vec>& points, std::vector<Loop>& cells) {
  const int jitter = rng.between(0, 3);
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      points.push_back({8.0 * x + rng.between(-jitter, jitter), 8.0 * y + rng.between(-jitter, jitter)});
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int a = x + (n + 1) * y, b = a + 1, c = b + n + 1, d = a + n + 1;
      const Loop one = {a, b, c}, two = {a, c, d};
      if (is_star(points, {a, b, c, d})) {
        cells.push_back({a, b, c, d});
      } else if (is_star(points, one) && is_star(points, two)) {
        cells.insert(cells.end(), {one, two});
      } else {
        cells.insert(cells.end(), {{b, c, d}, {b, d, a}});
      }
    }
  }
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

}  // namespace

World make_world(Rng& rng) {
  World world;
  const uint32_t kind = rng.below(4u);
  if (kind == 0) {
    quads(rng, rng.between(2, 5), world.points, world.cells);
  } else {
    std::vector<Point> points;
    while (!delaunay(rng, rng.between(4, 40), rng.chance(0.3) ? 8 : 1000, points, world.cells)) {
    }
    for (const Point& p : points) world.points.push_back({static_cast<double>(p[0]), static_cast<double>(p[1])});
  }
  if (kind > 1) join(rng, world);
  static const int scales[] = {0, 0, 0, -3, -60, 400, 900, -500, -1000};
  const int scale = scales[rng.below(9u)];
  const double move = rng.chance(0.2) ? 0x1p40 : 0;
  for (Vec& p : world.points) p = {std::ldexp(p[0] + move, scale), std::ldexp(p[1] - 3 * move, scale)};
  world.link();
  return world;
}

}  // namespace dsw::oracle::plane
