// Shape matching [MHTG05] as [JCD10] 7.3 takes it: equation 1 with weights, the rotation by Jacobi rotations. Uses no
// libm but sqrt, so that a scene is the same on every machine.
#ifndef DARTSWEEP_TESTS_SCENES_SHAPE_MATCHING_H
#define DARTSWEEP_TESTS_SCENES_SHAPE_MATCHING_H

#include <array>
#include <cstddef>
#include <vector>

namespace dsw::scenes {

using Matrix = std::array<std::array<double, 3>, 3>;  // rows

constexpr Matrix kIdentity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/** The rotation R of the polar decomposition A = R S: of all rotations the nearest to A. Eigenvectors of A^T A come
 * from cyclic Jacobi rotations. R is never a reflection: if the determinant of A is negative, the direction of least
 * stretch is turned over.
 * @param last what counts where A has rank one or zero, so that no rotation is the nearest. */
Matrix nearest_rotation(const Matrix& a, const Matrix& last);

/** One shape at rest. The mass centre of the rest positions is the origin of its vectors. */
class RestShape {
 public:
  /** @param rest 3 doubles a particle. @param weights one a particle, positive. */
  RestShape(const std::vector<double>& rest, std::vector<double> weights);

  std::size_t size() const { return weights_.size(); }
  /** Minimises equation 1 over rotations and translations.
   * @param at 3 doubles a particle. @param rotation [in,out] that of the step before, then the one found.
   * @param goals [out] 3 doubles a particle: the rest shape, turned and moved. */
  void find_goals(const double* at, Matrix& rotation, double* goals) const;

 private:
  std::vector<double> rest_, weights_;
  double sum_ = 0;
};

}  // namespace dsw::scenes

#endif
