#pragma once
// What is right, by exact integers alone: README.md. Every claim is held against every obstacle there is; there is no
// walk, no filter and nothing that the engine remembers.

#include "body/box.h"
#include "environment/environment.h"

namespace dsw {

/** Whether a body point is in a cell, under the shift. */
template <int D>
bool exactly_contains(const Environment<D>& env, Cell c, const double* point) noexcept;

/** A segment or a triangle of body points and what of the environment it meets: a segment impassable faces, a triangle
 * edges of these and marked edges; in the plane a segment impassable sides, a triangle vertices of these and single
 * ones. Two points that are equal meet nothing. */
struct Claim {
  const double* points[3] = {};  // lent; the third is null for a segment
  uint32_t subject = 0;          // whom it is about
  bool is_met = false;
  /** When: a segment is the way of a vertex, a triangle p p' q what edge p q sweeps. The largest double not above the
   * first time. */
  double time = 2;
};

template <int D>
class Validator {
 public:
  explicit Validator(const Environment<D>& env)
      : env_(env), claims_(Allocator<Claim>(env.memory)), boxes_(Allocator<Box<D>>(env.memory)) {}

  void add(uint32_t subject, const double* p, const double* q, const double* r = nullptr);
  /** Holds all claims against all obstacles. O(obstacles * claims), but only boxes where they are apart. */
  void run();
  const Array<Claim>& claims() const { return claims_; }
  /** Whether a claim is near a cell that is not valid: where an environment is folded, what lies in one of its cells
   * passes faces of others. */
  bool is_folded(size_t claim) const noexcept;

 private:
  /** A simplex of a facet; a ridge of one, which is D - 1 points. */
  void meet_simplex(const double* const* simplex) noexcept;
  void meet_ridge(const double* const* ridge) noexcept;

  const Environment<D>& env_;
  Array<Claim> claims_;
  Array<Box<D>> boxes_;  // of claims
  Box<D> all_;
};

}  // namespace dsw
