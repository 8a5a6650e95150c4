#pragma once
// Which tetrahedra are merged: pairs of neighbours, the best first, for as long as the union is a valid cell.

#include "topology/polyhedron.h"

namespace dsw {

struct CoarsenOptions {
  uint32_t max_facets = 16;  // of a merged cell: 4 .. kMostFacets
  uint64_t max_trials = 0;   // unions looked at; 0: no limit
};

class Merging {
 public:
  explicit Merging(const Environment<3>& env);

  void run(const CoarsenOptions& options);

  /** The cell with the lowest index of those that an alive cell is merged with. */
  uint32_t root(uint32_t cell) noexcept;
  /** What a root stands for; null: its cell alone. */
  const Polyhedron* polyhedron(uint32_t root) const noexcept;
  /** What areas are scaled by: the square of this. */
  double scale() const noexcept { return scale_; }
  uint64_t trials() const noexcept { return trials_; }
  bool complete() const noexcept { return complete_; }

 private:
  struct Pair {
    double value;
    uint32_t a, b, version_a, version_b;
    /** The worse comes later; never two alike. */
    bool operator<(const Pair& o) const noexcept;
  };
  struct Neighbour {
    uint32_t root;
    double shared;
    bool kept;
  };

  double area_of(HalfFacet h) const noexcept;
  uint32_t facets_of(uint32_t root, uint32_t (&out)[kMostFacets]) const noexcept;
  uint32_t root_beyond(HalfFacet h) noexcept;
  bool is_kept(HalfFacet h) const noexcept;
  void offer(uint32_t root, bool higher_only);
  void merge(const Pair& pair);

  const Environment<3>& env_;
  const double scale_;
  CoarsenOptions options_;
  Array<uint32_t> parent_;   // by cell: itself, or one with a lower index of the same union
  Array<uint32_t> version_;  // by root: grows with every merge
  Array<uint32_t> slot_;     // by root: where its polyhedron is
  Array<double> surface_;    // by root: scaled area of all facets
  Array<Polyhedron> polyhedra_{env_.memory};
  Array<uint32_t> free_slots_;
  Array<Pair> heap_{env_.memory};
  uint64_t trials_ = 0;
  bool complete_ = true;
};

/** The area of the triangle with these corners times `scale`. */
double scaled_area(const double* const* corners, double scale) noexcept;

}  // namespace dsw
