// The judge: what a segment meets first, in exact rational arithmetic over the doubles that all engines were given.
#ifndef DARTSWEEP_TESTS_BENCHMARK_EXACT_H
#define DARTSWEEP_TESTS_BENCHMARK_EXACT_H

#include "engine.h"

#include <gmpxx.h>

#include <optional>

namespace dsw::bench {

class Exact {
 public:
  explicit Exact(const WallMesh& walls);

  /** When the closed segment meets the closed wall first; none if it does not. A segment in a wall's plane counts as
   * not meeting it. */
  std::optional<mpq_class> time(std::uint32_t wall, const double* from, const double* to) const;

  struct First {
    std::vector<std::uint32_t> walls;  // all that are met first, at the same time; empty: nothing is met
    mpq_class time;
  };
  First first(const double* from, const double* to) const;

  /** By how much segment or wall must move, in scene units, before the segment meets the wall or no longer does: the
   * larger over its triangles of the least distance among both ends to the plane and the segment's line to the
   * edges. */
  double slack(std::uint32_t wall, const double* from, const double* to) const;

 private:
  const WallMesh& walls_;
  // A coarse grid of boxes: which triangles can meet a segment.
  double low_[3], bucket_;
  std::int32_t size_[3];
  std::vector<std::uint32_t> first_, entries_;

  void range(const double* low, const double* high, std::int32_t* from, std::int32_t* to) const;
};

}  // namespace dsw::bench

#endif
