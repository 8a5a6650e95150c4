#include "exact.h"

#include "vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsw::bench {

namespace {

using bench::cross;
using bench::dot;

struct Rational {
  mpq_class x, y, z;
};

Rational rational(const double* p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }
Rational operator-(const Rational& a, const Rational& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Rational cross(const Rational& a, const Rational& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
mpq_class dot(const Rational& a, const Rational& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

std::optional<mpq_class> triangle_time(const Rational& a, const Rational& b, const Rational& c, const Rational& p,
                                       const Rational& q) {
  const Rational normal = cross(b - a, c - a);
  const mpq_class start = dot(normal, p - a), end = dot(normal, q - a);
  if (sgn(start) * sgn(end) > 0 || sgn(start) == sgn(end)) return std::nullopt;
  const Rational along = q - p;
  const Rational pa = a - p, pb = b - p, pc = c - p;
  const int ab = sgn(dot(along, cross(pa, pb))), bc = sgn(dot(along, cross(pb, pc))),
            ca = sgn(dot(along, cross(pc, pa)));
  if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return std::nullopt;
  return mpq_class(start / (start - end));
}

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/** Signed: positive when the triangle is met. */
double triangle_slack(const double* a, const double* b, const double* c, const double* p, const double* q) {
  const Vector normal = cross(minus(b, a), minus(c, a));
  const double scale = length(normal);
  double start = dot(normal, minus(p, a)) / scale, end = dot(normal, minus(q, a)) / scale;
  const double turn = end > start ? 1.0 : -1.0;  // crossing along the normal or against it
  if (end < start) std::swap(start, end);
  double least = std::min(-start, end);
  const Vector along = minus(q, p);
  const double* corners[4] = {a, b, c, a};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector edge = minus(corners[i + 1], corners[i]);
    const Vector across = cross(along, edge);
    const double distance = dot(across, minus(p, corners[i])) / length(across);
    // The line passes on the inner side of the edge when, looking along it, the edge turns as the normal does.
    least = std::min(least, turn * distance);
  }
  return least;
}

}  // namespace

Exact::Exact(const WallMesh& walls) : walls_(walls) {
  double high[3], edges = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = std::numeric_limits<double>::infinity();
    high[k] = -low_[k];
  }
  for (const auto& triangle : walls.triangles) {
    edges += length(minus(walls.point(triangle[1]), walls.point(triangle[0])));
    for (const std::uint32_t vertex : triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], walls.point(vertex)[k]);
        high[k] = std::max(high[k], walls.point(vertex)[k]);
      }
    }
  }
  bucket_ = 2.0 * edges / static_cast<double>(walls.triangles.size());
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = std::max(1, static_cast<std::int32_t>(std::ceil((high[k] - low_[k]) / bucket_)));
  }
  const auto cells =
      static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]);
  first_.assign(cells + 1, 0);
  for (const bool counting : {true, false}) {
    for (std::uint32_t i = 0; i < walls.triangles.size(); ++i) {
      double least[3], most[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = walls.triangles[i];
        const auto bounds = std::minmax({walls.point(t[0])[k], walls.point(t[1])[k], walls.point(t[2])[k]});
        least[k] = bounds.first;
        most[k] = bounds.second;
      }
      std::int32_t from[3], to[3];
      range(least, most, from, to);
      for (std::int32_t z = from[2]; z <= to[2]; ++z) {
        for (std::int32_t y = from[1]; y <= to[1]; ++y) {
          for (std::int32_t x = from[0]; x <= to[0]; ++x) {
            std::uint32_t& slot = first_[static_cast<std::size_t>(x + size_[0] * (y + size_[1] * z))];
            if (counting) {
              ++slot;
            } else {
              entries_[--slot] = i;
            }
          }
        }
      }
    }
    if (counting) {
      for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
      entries_.resize(first_.back());
    }
  }
}

/** Buckets that a box meets, with room for rounding. */
void Exact::range(const double* low, const double* high, std::int32_t* from, std::int32_t* to) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const double hair = 1e-3;
    from[k] = std::clamp(static_cast<std::int32_t>(std::floor((low[k] - low_[k]) / bucket_ - hair)), 0, size_[k] - 1);
    to[k] = std::clamp(static_cast<std::int32_t>(std::floor((high[k] - low_[k]) / bucket_ + hair)), 0, size_[k] - 1);
  }
}

std::optional<mpq_class> Exact::time(std::uint32_t wall, const double* from, const double* to) const {
  std::optional<mpq_class> least;
  const Rational p = rational(from), q = rational(to);
  for (std::uint32_t part = 0; part < walls_.walls[wall].triangle_count(); ++part) {
    const auto triangle = walls_.walls[wall].triangle(part);
    const auto found = triangle_time(rational(walls_.point(triangle[0])), rational(walls_.point(triangle[1])),
                                     rational(walls_.point(triangle[2])), p, q);
    if (found && (!least || *found < *least)) least = found;
  }
  return least;
}

Exact::First Exact::first(const double* from, const double* to) const {
  double low[3], high[3];
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(from[k], to[k]);
    high[k] = std::max(from[k], to[k]);
  }
  std::int32_t begin[3], end[3];
  range(low, high, begin, end);
  std::vector<std::uint32_t> candidates;
  for (std::int32_t z = begin[2]; z <= end[2]; ++z) {
    for (std::int32_t y = begin[1]; y <= end[1]; ++y) {
      for (std::int32_t x = begin[0]; x <= end[0]; ++x) {
        const auto at = static_cast<std::size_t>(x + size_[0] * (y + size_[1] * z));
        for (std::uint32_t i = first_[at]; i < first_[at + 1]; ++i) {
          candidates.push_back(walls_.triangle_wall[entries_[i]]);
        }
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  First result;
  for (const std::uint32_t wall : candidates) {
    const auto found = time(wall, from, to);
    if (!found || (!result.walls.empty() && *found > result.time)) continue;
    if (result.walls.empty() || *found < result.time) {
      result.walls.clear();
      result.time = *found;
    }
    result.walls.push_back(wall);
  }
  return result;
}

double Exact::slack(std::uint32_t wall, const double* from, const double* to) const {
  double most = -std::numeric_limits<double>::infinity();
  for (std::uint32_t part = 0; part < walls_.walls[wall].triangle_count(); ++part) {
    const auto triangle = walls_.walls[wall].triangle(part);
    most = std::max(most, triangle_slack(walls_.point(triangle[0]), walls_.point(triangle[1]),
                                         walls_.point(triangle[2]), from, to));
  }
  return std::fabs(most);
}

}  // namespace dsw::bench
