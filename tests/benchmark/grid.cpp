#include "grid.h"

#include "bucket_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dsw::bench {

namespace {

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** A wall closer than this to a bucket's side, in buckets, counts as lying in it. */
constexpr double kSkin = 1e-9;

}  // namespace

Grid::Grid(const WallMesh& walls, double bucket)
    : Engine("grid, bucket " + std::to_string(bucket)), walls_(walls), bucket_(bucket), inverse_(1.0 / bucket) {
  double high[3];
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = std::numeric_limits<double>::infinity();
    high[k] = -low_[k];
  }
  for (const auto& triangle : walls.triangles) {
    for (const std::uint32_t vertex : triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], walls.point(vertex)[k]);
        high[k] = std::max(high[k], walls.point(vertex)[k]);
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = std::max(1, static_cast<std::int32_t>(std::ceil((high[k] - low_[k]) * inverse_ - kSkin)));
  }
  buckets_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                  static_cast<std::size_t>(size_[2]));

  std::vector<std::array<std::uint32_t, 2>> pairs;  // bucket, triangle
  std::vector<Triangle> unsorted;
  std::vector<std::uint32_t> home;
  for (std::uint32_t wall = 0; wall < walls.walls.size(); ++wall) {
    for (std::uint32_t part = 0; part < walls.walls[wall].triangle_count(); ++part) {
      const Triangle triangle = make_triangle(walls.walls[wall], part, wall);
      const auto index = static_cast<std::uint32_t>(unsorted.size());
      home.push_back(0);
      visit_buckets(triangle.a, triangle.b, triangle.c, walls.walls[wall].two_sided, [&](std::uint32_t at) {
        pairs.push_back({at, index});
        home.back() = at;
      });
      unsorted.push_back(triangle);
    }
  }
  // Triangles in the order of their buckets, and entries bucket by bucket.
  std::vector<std::uint32_t> order(unsorted.size()), rank(unsorted.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return home[a] < home[b]; });
  wall_triangles_.assign(walls.walls.size(), {kNone, kNone});
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    triangles_.push_back(unsorted[order[i]]);
  }
  for (std::uint32_t i = 0; i < unsorted.size(); ++i) {
    auto& own = wall_triangles_[unsorted[i].wall];
    own[own[0] == kNone ? 0 : 1] = rank[i];
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [at, triangle] : pairs) {
    if (buckets_[at].count == 0) buckets_[at].first = static_cast<std::uint32_t>(entries_.size());
    ++buckets_[at].count;
    ++buckets_[at].capacity;
    entries_.push_back(rank[triangle]);
  }
}

Grid::Triangle Grid::make_triangle(const scenes::Wall& wall, std::uint32_t part, std::uint32_t id) const {
  Triangle triangle{};
  const auto vertices = wall.triangle(part);
  std::copy_n(walls_.point(vertices[0]), 3, triangle.a);
  std::copy_n(walls_.point(vertices[1]), 3, triangle.b);
  std::copy_n(walls_.point(vertices[2]), 3, triangle.c);
  const Vector normal = cross(minus(triangle.b, triangle.a), minus(triangle.c, triangle.a));
  std::copy_n(normal.data(), 3, triangle.normal);
  triangle.offset = dot(triangle.normal, triangle.a);
  triangle.wall = id;
  return triangle;
}

/** Buckets that a triangle, moved a hair to its passable side, has more than a hair in common with. */
template <typename Visit>
void Grid::visit_buckets(const double* a, const double* b, const double* c, bool two_sided, Visit visit) const {
  const Vector normal = cross(minus(b, a), minus(c, a));
  const double length = std::sqrt(dot(normal, normal));
  const double hair = kSkin * bucket_;
  std::int32_t from[3], to[3];
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::min({a[k], b[k], c[k]}), most = std::max({a[k], b[k], c[k]});
    if (two_sided) {
      least -= hair;
      most += hair;
    } else {
      least += 2 * hair * normal[k] / length;
      most += 2 * hair * normal[k] / length;
      if (most - least > 4 * hair) {
        least += hair;
        most -= hair;
      }
    }
    from[k] = std::clamp(static_cast<std::int32_t>(std::floor((least - low_[k]) * inverse_)), 0, size_[k] - 1);
    to[k] = std::clamp(static_cast<std::int32_t>(std::floor((most - low_[k]) * inverse_)), 0, size_[k] - 1);
  }
  for (std::int32_t z = from[2]; z <= to[2]; ++z) {
    for (std::int32_t y = from[1]; y <= to[1]; ++y) {
      for (std::int32_t x = from[0]; x <= to[0]; ++x) {
        // The bucket's box against the triangle's plane.
        const Vector centre = {low_[0] + (x + 0.5) * bucket_, low_[1] + (y + 0.5) * bucket_,
                               low_[2] + (z + 0.5) * bucket_};
        const double reach = 0.5 * bucket_ * (std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]));
        if (std::fabs(dot(normal, minus(centre.data(), a))) <= reach + 4 * hair * length) {
          visit(static_cast<std::uint32_t>(x + size_[0] * (y + size_[1] * z)));
        }
      }
    }
  }
}

void Grid::place(std::uint32_t bucket, std::uint32_t triangle) {
  Bucket& own = buckets_[bucket];
  if (own.count == own.capacity) {  // moves to the end with room to grow; the old room is lost
    const auto capacity = static_cast<std::uint16_t>(std::max(4, 2 * own.capacity));
    const auto first = static_cast<std::uint32_t>(entries_.size());
    entries_.resize(entries_.size() + capacity);
    std::copy_n(entries_.begin() + own.first, own.count, entries_.begin() + first);
    own.first = first;
    own.capacity = capacity;
  }
  entries_[own.first + own.count++] = triangle;
}

void Grid::unplace(std::uint32_t bucket, std::uint32_t triangle) {
  Bucket& own = buckets_[bucket];
  std::uint32_t* entries = entries_.data() + own.first;
  for (std::uint32_t i = 0; i < own.count; ++i) {
    if (entries[i] == triangle) {
      entries[i] = entries[--own.count];
      return;
    }
  }
}

void Grid::insert(std::uint32_t id, const scenes::Wall& wall) {
  if (id >= wall_triangles_.size()) wall_triangles_.resize(id + 1, {kNone, kNone});
  for (std::uint32_t part = 0; part < wall.triangle_count(); ++part) {
    const Triangle triangle = make_triangle(wall, part, id);
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(triangles_.size()));
      triangles_.emplace_back();
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    triangles_[index] = triangle;
    wall_triangles_[id][part] = index;
    visit_buckets(triangle.a, triangle.b, triangle.c, wall.two_sided,
                  [&](std::uint32_t bucket) { place(bucket, index); });
  }
}

void Grid::remove(std::uint32_t id, const scenes::Wall& wall) {
  for (std::uint32_t part = 0; part < wall.triangle_count(); ++part) {
    const std::uint32_t index = wall_triangles_[id][part];
    const Triangle& triangle = triangles_[index];
    visit_buckets(triangle.a, triangle.b, triangle.c, wall.two_sided,
                  [&](std::uint32_t bucket) { unplace(bucket, index); });
    free_.push_back(index);
    wall_triangles_[id][part] = kNone;
  }
}

void Grid::prepare(const Segments& segments) {
  from_ = segments.from;
  to_ = segments.to;
  answers_.resize(segments.batch);
}

void Grid::run(std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) answers_[i] = cast(&from_[3 * (first + i)], &to_[3 * (first + i)]);
}

inline void Grid::test_bucket(std::size_t bucket, const double* from, const double* to, Answer& answer) const {
  const Bucket& own = buckets_[bucket];
  for (std::uint32_t i = 0; i < own.count; ++i) {
    const Triangle& triangle = triangles_[entries_[own.first + i]];
    const double start = dot(triangle.normal, from) - triangle.offset;
    const double end = dot(triangle.normal, to) - triangle.offset;
    if ((start > 0) == (end > 0)) continue;
    const double time = start / (start - end);
    if (time >= answer.time && answer.wall != kNone) continue;
    const Vector along = minus(to, from);
    const Vector a = minus(triangle.a, from), b = minus(triangle.b, from), c = minus(triangle.c, from);
    const double ab = dot(along, cross(a, b)), bc = dot(along, cross(b, c)), ca = dot(along, cross(c, a));
    if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0)) answer = {triangle.wall, time};
  }
}

inline Answer Grid::cast(const double* from, const double* to) const {
  return walk_buckets({{low_[0], low_[1], low_[2]}, bucket_, inverse_, {size_[0], size_[1], size_[2]}}, from, to,
                      [&](std::size_t bucket, Answer& answer) { test_bucket(bucket, from, to, answer); });
}

std::size_t Grid::bytes() const {
  return buckets_.size() * sizeof(Bucket) + entries_.size() * sizeof(std::uint32_t) +
         triangles_.size() * sizeof(Triangle);
}

std::vector<std::unique_ptr<Engine>> make_grids(const WallMesh& walls, const std::vector<double>& buckets) {
  std::vector<std::unique_ptr<Engine>> engines;
  for (const double bucket : buckets) engines.push_back(std::make_unique<Grid>(walls, bucket));
  return engines;
}

}  // namespace dsw::bench
