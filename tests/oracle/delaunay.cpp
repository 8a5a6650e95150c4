// Incremental Delaunay tetrahedra of a few integer points (Bowyer and Watson), exact in 128 bits.
#include "scenes.h"

#include <algorithm>
#include <map>
#include <set>

namespace dsw::oracle {
namespace {

__extension__ using Wide = __int128;
using Point = std::array<int64_t, 3>;
using Tet = std::array<int, 4>;

int64_t orient(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int64_t bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const int64_t cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const int64_t dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  return (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
}

/// Whether e lies strictly inside the sphere round the positive tetrahedron abcd.
bool in_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& e) {
  const Point* row[4] = {&a, &b, &c, &d};
  Wide m[4][4];
  for (int i = 0; i < 4; ++i) {
    m[i][3] = 0;
    for (int k = 0; k < 3; ++k) {
      m[i][k] = (*row[i])[static_cast<size_t>(k)] - e[static_cast<size_t>(k)];
      m[i][3] += m[i][k] * m[i][k];
    }
  }
  Wide det = 0;
  for (int i = 0; i < 4; ++i) {
    int r[3], n = 0;
    for (int j = 0; j < 4; ++j) {
      if (j != i) r[n++] = j;
    }
    const Wide minor = m[r[0]][0] * (m[r[1]][1] * m[r[2]][2] - m[r[1]][2] * m[r[2]][1]) -
                       m[r[0]][1] * (m[r[1]][0] * m[r[2]][2] - m[r[1]][2] * m[r[2]][0]) +
                       m[r[0]][2] * (m[r[1]][0] * m[r[2]][1] - m[r[1]][1] * m[r[2]][0]);
    det += (i % 2 == 0 ? -1 : 1) * m[i][3] * minor;
  }
  return det < 0;  // with orient(a, b, c, d) > 0; checked against the sphere's centre in the tests
}

bool build(Rng& rng, int count, int size, std::vector<Point>& p, std::vector<Tet>& tets) {
  const int64_t far = 40ll * size;
  p = {{-far, -far, -far}, {3 * far, -far, -far}, {-far, 3 * far, -far}, {-far, -far, 3 * far}};
  tets = {{0, 1, 2, 3}};
  std::set<Point> used;
  while (static_cast<int>(p.size()) < count + 4) {
    const Point q = {rng.between(0, size), rng.between(0, size), rng.between(0, size)};
    if (!used.insert(q).second) continue;
    const int index = static_cast<int>(p.size());
    p.push_back(q);
    const auto at = [&](int i) -> const Point& { return p[static_cast<size_t>(i)]; };
    std::vector<Tet> keep;
    std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> faces;
    for (const Tet& t : tets) {
      if (!in_sphere(at(t[0]), at(t[1]), at(t[2]), at(t[3]), q)) {
        keep.push_back(t);
        continue;
      }
      const std::array<int, 3> f[4] = {{t[0], t[2], t[1]}, {t[0], t[1], t[3]}, {t[1], t[2], t[3]}, {t[2], t[0], t[3]}};
      for (const auto& face : f) {
        std::array<int, 3> key = face;
        std::sort(key.begin(), key.end());
        auto& entry = faces[key];
        ++entry.first;
        entry.second = face;
      }
    }
    for (const auto& [key, entry] : faces) {
      if (entry.first != 1) continue;
      const auto& f = entry.second;
      const Tet t = {f[0], f[2], f[1], index};  // f is counter-clockwise from outside the cavity
      if (orient(at(t[0]), at(t[1]), at(t[2]), at(t[3])) <= 0) return false;
      keep.push_back(t);
    }
    tets = keep;
  }
  tets.erase(
      std::remove_if(tets.begin(), tets.end(), [](const Tet& t) { return *std::min_element(t.begin(), t.end()) < 4; }),
      tets.end());
  return static_cast<int>(tets.size()) > count;
}

}  // namespace

Mesh delaunay(Rng& rng, int count, int size) {
  std::vector<Point> p;
  std::vector<Tet> tets;
  while (!build(rng, count, size, p, tets)) {
  }
  Mesh mesh;
  for (size_t i = 4; i < p.size(); ++i) {
    mesh.points.push_back({static_cast<double>(p[i][0]), static_cast<double>(p[i][1]), static_cast<double>(p[i][2])});
  }
  for (const Tet& t : tets) mesh.add_standard(DSW_CELL_TYPE_TETRA, {t[0] - 4, t[1] - 4, t[2] - 4, t[3] - 4});
  return mesh;
}

}  // namespace dsw::oracle
