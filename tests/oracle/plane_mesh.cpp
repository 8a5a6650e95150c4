#include "plane_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace dsw::oracle::plane {

void World::link() {
  std::map<std::pair<int, int>, size_t> open;
  sides.clear();
  for (size_t c = 0; c < cells.size(); ++c) {
    for (size_t i = 0; i < cells[c].size(); ++i) {
      const int a = cells[c][i], b = cells[c][(i + 1) % cells[c].size()];
      const auto found = open.find({b, a});
      if (found != open.end()) {
        sides[found->second].cell[1] = static_cast<int>(c);
        sides[found->second].local[1] = static_cast<int>(i);
      } else {
        open[{a, b}] = sides.size();
        sides.push_back({a, b, {static_cast<int>(c), -1}, {static_cast<int>(i), -1}});
      }
    }
  }
  cell_marked.assign(cells.size(), 0);
  tags.resize(cells.size());
  std::iota(tags.begin(), tags.end(), 1u);
}

bool World::impassable(const Side& s) const {
  return s.marked || s.cell[1] < 0 || cell_marked[static_cast<size_t>(s.cell[0])] != 0 ||
         cell_marked[static_cast<size_t>(s.cell[1])] != 0;
}

bool is_star(const std::vector<Vec>& points, const std::vector<int>& cell) {
  const double count = static_cast<double>(cell.size());
  double x = 0, y = 0, size = 0;
  for (const int v : cell) {
    const Vec& p = points[static_cast<size_t>(v)];
    x += p[0], y += p[1];
    size = std::max({size, std::fabs(p[0]), std::fabs(p[1])});
  }
  for (size_t i = 0; i < cell.size(); ++i) {
    const Vec &a = points[static_cast<size_t>(cell[i])], &b = points[static_cast<size_t>(cell[(i + 1) % cell.size()])];
    const double area = (a[0] - x / count) * (b[1] - y / count) - (a[1] - y / count) * (b[0] - x / count);
    if (!(area > 1e-9 * size * size)) return false;
  }
  return true;
}

}  // namespace dsw::oracle::plane
