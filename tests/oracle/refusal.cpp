// Whether a mesh may be refused: some face has no triangulation that leaves the stars of its volumes positive. In plain
// double arithmetic: scenes have wide margins or are built to be certain.
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
  struct Sides {
    Loop loop;                 // seen from outside of the first volume
    std::vector<Vec> centres;  // of one or two volumes
  };
  std::map<std::vector<int>, Sides> faces;
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
      Sides& sides = faces.insert({key, {f, {}}}).first->second;
      sides.centres.push_back(centre);
    }
  }
  for (const auto& entry : faces) {
    const Loop& f = entry.second.loop;
    const size_t n = f.size();
    const auto positive = [&](size_t a, size_t b, size_t c) {
      double wanted = -1;
      for (const Vec& centre : entry.second.centres) {
        if (!(wanted * volume(at(f[a]), at(f[b]), at(f[c]), centre) > 0)) return false;
        wanted = 1;
      }
      return true;
    };
    // reach[i][j]: the part of the face between corners i and j can be cut well.
    std::vector<std::vector<char>> reach(n, std::vector<char>(n, 0));
    for (size_t i = 0; i + 1 < n; ++i) reach[i][i + 1] = 1;
    for (size_t span = 2; span < n; ++span) {
      for (size_t i = 0; i + span < n; ++i) {
        for (size_t m = i + 1; m < i + span && reach[i][i + span] == 0; ++m) {
          if (reach[i][m] != 0 && reach[m][i + span] != 0 && positive(i, m, i + span)) reach[i][i + span] = 1;
        }
      }
    }
    if (reach[0][n - 1] == 0) return true;
  }
  return false;
}

}  // namespace dsw::oracle
