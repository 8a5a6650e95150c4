// Whether a mesh may be refused: some face has no fan that leaves the stars of its volumes positive. In plain double
// arithmetic: scenes have wide margins or are built to be certain.
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dsw::oracle {
namespace {

double volume(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  Vec x, y, z;
  for (size_t k = 0; k < 3; ++k) {
    x[k] = b[k] - a[k];
    y[k] = c[k] - a[k];
    z[k] = d[k] - a[k];
  }
  return (x[1] * y[2] - x[2] * y[1]) * z[0] + (x[2] * y[0] - x[0] * y[2]) * z[1] + (x[0] * y[1] - x[1] * y[0]) * z[2];
}

}  // namespace

bool may_be_refused(const Mesh& mesh) {
  double most = 0;
  for (const Cell& cell : mesh.cells) {
    for (const Loop& f : cell.faces) {
      for (int v : f) {
        for (double x : mesh.points[static_cast<size_t>(v)]) most = std::max(most, std::fabs(x));
      }
    }
  }
  std::vector<Vec> points = mesh.points;
  for (Vec& p : points) {
    for (double& x : p) x = std::ldexp(x, -std::ilogb(most));
  }
  const auto at = [&](int v) -> const Vec& { return points[static_cast<size_t>(v)]; };
  std::map<std::vector<int>, std::vector<char>> fans;  // by face: which bases suit all volumes seen so far
  for (const Cell& cell : mesh.cells) {
    std::vector<int> used;
    for (const Loop& f : cell.faces) used.insert(used.end(), f.begin(), f.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    Vec centre = {0, 0, 0};
    for (int v : used) {
      for (size_t k = 0; k < 3; ++k) centre[k] += at(v)[k] / static_cast<double>(used.size());
    }
    for (const Loop& f : cell.faces) {
      std::vector<int> key = f;
      std::sort(key.begin(), key.end());
      std::vector<char>& good = fans.insert({key, std::vector<char>(f.size(), 1)}).first->second;
      for (size_t b = 0; b < f.size(); ++b) {
        const auto place = static_cast<size_t>(std::lower_bound(key.begin(), key.end(), f[b]) - key.begin());
        for (size_t i = 1; i + 1 < f.size(); ++i) {
          const int second = f[(b + i) % f.size()], third = f[(b + i + 1) % f.size()];
          if (!(volume(at(f[b]), at(second), at(third), centre) < 0)) good[place] = 0;
        }
      }
      if (std::find(good.begin(), good.end(), 1) == good.end()) return true;
    }
  }
  return false;
}

}  // namespace dsw::oracle
