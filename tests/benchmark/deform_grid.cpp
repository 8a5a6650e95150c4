#include "deform_peers.h"

#include "bucket_walk.h"

#include <algorithm>

namespace dsw::bench {

namespace {

/** Walls by the buckets that their boxes meet. Nothing of a wall is computed before a segment asks. */
class MovingGrid final : public MovingEngine {
 public:
  /** @param chained a list for each bucket, one pass over the walls; else they stand bucket by bucket: two. */
  MovingGrid(const WallMesh& walls, double edge, bool chained)
      : MovingEngine("grid, bucket " + std::to_string(edge) + (chained ? ", chained" : ", sorted")),
        walls_(walls),
        own_(walls),
        chained_(chained) {
    write();
    buckets_.edge = edge;
    buckets_.inverse = 1 / edge;
    for (std::size_t k = 0; k < 3; ++k) {
      double high = points_[k];
      buckets_.low[k] = high;
      for (std::size_t i = k; i < points_.size(); i += 3) {
        buckets_.low[k] = std::min(buckets_.low[k], points_[i]);
        high = std::max(high, points_[i]);
      }
      // Walls of the lattice lie in the middle of buckets and not in their sides, from where they would reach into two.
      buckets_.low[k] -= 0.5;
      buckets_.size[k] = static_cast<std::int32_t>(std::ceil((high - buckets_.low[k]) * buckets_.inverse));
    }
    const auto size = [&](std::size_t k) { return static_cast<std::size_t>(buckets_.size[k]); };
    first_.resize(size(0) * size(1) * size(2) + 1);
    update();
  }

  void write() override {
    points_.resize(3 * own_.vertices.size());
    for (std::size_t i = 0; i < own_.vertices.size(); ++i) {
      std::copy_n(walls_.point(own_.vertices[i]), 3, &points_[3 * i]);
    }
  }

  void update() override {
    if (chained_) {
      std::fill(first_.begin(), first_.end(), kNone);
      entries_.clear();
      for (std::uint32_t wall = 0; wall < own_.quads.size(); ++wall) {
        visit(range_of(wall), [&](std::size_t bucket) {
          entries_.push_back({wall, first_[bucket]});
          first_[bucket] = static_cast<std::uint32_t>(entries_.size() - 1);
        });
      }
      return;
    }
    std::fill(first_.begin(), first_.end(), 0u);
    ranges_.resize(own_.quads.size());
    for (std::uint32_t wall = 0; wall < ranges_.size(); ++wall) {
      ranges_[wall] = range_of(wall);
      visit(ranges_[wall], [&](std::size_t bucket) { ++first_[bucket]; });
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_) {
      sum += first;
      first = sum;
    }
    sorted_.resize(sum);
    for (std::uint32_t wall = 0; wall < ranges_.size(); ++wall) {
      visit(ranges_[wall], [&](std::size_t bucket) { sorted_[--first_[bucket]] = wall; });
    }
  }

  void prepare(const Segments& segments) override {
    segments_ = &segments;
    answers_.resize(segments.batch);
  }

  void run(std::size_t first, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      const double *from = &segments_->from[3 * (first + i)], *to = &segments_->to[3 * (first + i)];
      answers_[i] = walk_buckets(buckets_, from, to, [&](std::size_t bucket, Answer& answer) {
        if (chained_) {
          for (std::uint32_t e = first_[bucket]; e != kNone; e = entries_[e].next) {
            test_wall(entries_[e].wall, from, to, answer);
          }
        } else {
          for (std::uint32_t e = first_[bucket]; e < first_[bucket + 1]; ++e) test_wall(sorted_[e], from, to, answer);
        }
      });
    }
  }

  Answer answer(std::size_t i) const override { return answers_[i]; }

 private:
  struct Range {
    std::uint16_t low[3], high[3];
  };
  struct Entry {
    std::uint32_t wall, next;
  };

  const double* point(std::uint32_t i) const { return &points_[3 * std::size_t{i}]; }

  Range range_of(std::uint32_t wall) const {
    const auto& quad = own_.quads[wall];
    const double *a = point(quad[0]), *b = point(quad[1]), *c = point(quad[2]), *d = point(quad[3]);
    Range range;
    for (std::size_t k = 0; k < 3; ++k) {
      // Every wall lies in the grid, so that rounding towards zero does.
      const double low = std::min(std::min(a[k], b[k]), std::min(c[k], d[k])) - buckets_.low[k];
      const double high = std::max(std::max(a[k], b[k]), std::max(c[k], d[k])) - buckets_.low[k];
      range.low[k] = static_cast<std::uint16_t>(static_cast<std::int32_t>(low * buckets_.inverse));
      range.high[k] = static_cast<std::uint16_t>(static_cast<std::int32_t>(high * buckets_.inverse));
    }
    return range;
  }

  template <typename Visit>
  void visit(const Range& range, Visit each) const {
    const auto row = static_cast<std::size_t>(buckets_.size[0]),
               layer = row * static_cast<std::size_t>(buckets_.size[1]);
    for (std::size_t z = range.low[2]; z <= range.high[2]; ++z) {
      for (std::size_t y = range.low[1]; y <= range.high[1]; ++y) {
        for (std::size_t x = range.low[0]; x <= range.high[0]; ++x) each(x + row * y + layer * z);
      }
    }
  }

  void test_wall(std::uint32_t wall, const double* from, const double* to, Answer& answer) const {
    const auto& quad = own_.quads[wall];
    const double *a = point(quad[0]), *b = point(quad[1]), *c = point(quad[2]), *d = point(quad[3]);
    const Vector pa = minus(a, from), pb = minus(b, from), pc = minus(c, from), pd = minus(d, from);
    test_triangle(wall, pa, pb, pc, minus(to, from), answer);
    test_triangle(wall, pa, pc, pd, minus(to, from), answer);
  }

  /** Corners relative to the start. */
  static void test_triangle(std::uint32_t wall, const Vector& a, const Vector& b, const Vector& c, const Vector& along,
                            Answer& answer) {
    const Vector normal = cross(minus(b.data(), a.data()), minus(c.data(), a.data()));
    const double start = -dot(normal, a), end = start + dot(normal, along);
    if ((start > 0) == (end > 0)) return;
    const double time = start / (start - end);
    if (time >= answer.time && answer.wall != kNone) return;
    const double ab = dot(along, cross(a, b)), bc = dot(along, cross(b, c)), ca = dot(along, cross(c, a));
    if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0)) answer = {wall, time};
  }

  const WallMesh& walls_;
  WallPoints own_;
  bool chained_;
  Buckets buckets_{};
  std::vector<double> points_;
  std::vector<std::uint32_t> first_;  // of each bucket
  std::vector<Entry> entries_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> sorted_;
  const Segments* segments_ = nullptr;
  std::vector<Answer> answers_;
};

}  // namespace

WallPoints::WallPoints(const WallMesh& walls) {
  std::vector<std::uint32_t> places(walls.points->size() / 3, kNone);
  const auto place = [&](std::uint32_t vertex) {
    if (places[vertex] == kNone) {
      places[vertex] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(vertex);
    }
    return places[vertex];
  };
  for (const auto& wall : walls.walls) {
    std::array<std::uint32_t, 4> quad;
    for (std::size_t k = 0; k < 4; ++k) quad[k] = place(wall.vertices[(k + wall.diagonal) % 4]);
    quads.push_back(quad);
    triangles.push_back({quad[0], quad[1], quad[2]});
    triangles.push_back({quad[0], quad[2], quad[3]});
  }
}

std::vector<std::unique_ptr<MovingEngine>> make_moving_grids(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const double edge : {1.0, 2.0, 3.0}) {
    for (const bool chained : {false, true}) engines.push_back(std::make_unique<MovingGrid>(walls, edge, chained));
  }
  return engines;
}

}  // namespace dsw::bench
