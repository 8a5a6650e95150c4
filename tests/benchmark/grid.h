// A uniform grid over the walls as a peer: triangles in buckets, walked bucket by bucket along the segment, in doubles.
// Nothing comes with it, so it is written here, and tuned: the bucket size is the best of several, triangles lie in the
// order of their buckets, and a wall that lies in a bucket's side is entered on its passable side only.
#ifndef DARTSWEEP_TESTS_BENCHMARK_GRID_H
#define DARTSWEEP_TESTS_BENCHMARK_GRID_H

#include "engine.h"

namespace dsw::bench {

class Grid final : public Engine {
 public:
  /** @param bucket edge of a bucket, scene units. */
  Grid(const WallMesh& walls, double bucket);

  void prepare(const Segments& segments) override;
  void run(std::size_t first, std::size_t count) override;
  Answer answer(std::size_t i) const override { return answers_[i]; }

  /** Takes a wall in, as in a scene that changes. `id` is what answers name; it must not be in use. */
  void insert(std::uint32_t id, const scenes::Wall& wall);
  void remove(std::uint32_t id, const scenes::Wall& wall);

  std::size_t bytes() const;

 private:
  struct alignas(64) Triangle {  // 128 bytes, two cache lines; a segment on one side of the plane needs the first only
    double normal[3], offset;
    double a[3], b[3], c[3];
    std::uint32_t wall;
  };
  struct Bucket {  // 8 bytes
    std::uint32_t first;
    std::uint16_t count, capacity;
  };

  template <typename Visit>
  void visit_buckets(const double* a, const double* b, const double* c, bool two_sided, Visit visit) const;
  Triangle make_triangle(const scenes::Wall& wall, std::uint32_t part, std::uint32_t id) const;
  void place(std::uint32_t bucket, std::uint32_t triangle);
  void unplace(std::uint32_t bucket, std::uint32_t triangle);
  void test_bucket(std::size_t bucket, const double* from, const double* to, Answer& answer) const;
  Answer cast(const double* from, const double* to) const;

  const WallMesh& walls_;
  double low_[3] = {}, bucket_ = 1.0, inverse_ = 1.0;
  std::int32_t size_[3] = {};
  std::vector<Bucket> buckets_;
  std::vector<std::uint32_t> entries_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> free_;
  std::vector<std::array<std::uint32_t, 2>> wall_triangles_;  // of each wall
  std::vector<double> from_, to_;
  std::vector<Answer> answers_;
};

/** Grids with buckets around a guess. */
std::vector<std::unique_ptr<Engine>> make_grids(const WallMesh& walls, const std::vector<double>& buckets);

}  // namespace dsw::bench

#endif
