#pragma once
// Eigen's quaternions and matrices, for rigid motions. Only source files include this: it takes long to compile.
//
// Results have the same bits for any compiler, instruction set and host. So Eigen is told to use no vector
// instructions, which add in another order, and gets a namespace of its own: in a program that is linked to the static
// library and uses Eigen, too, the linker keeps one of two functions of the same name, and that of the host may fuse
// multiplications and additions.
//
// Never `auto` for what Eigen's operators return: it refers to operands that may be gone.

#ifdef EIGEN_CORE_H
#error "base/eigen.h comes before any other header that includes Eigen"
#endif
#define EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_PARALLELIZE
#define EIGEN_MPL2_ONLY
#define EIGEN_NO_MALLOC  // memory is the context's
#define Eigen dsw_eigen
#include <Eigen/Geometry>
#undef Eigen

#include "base/fp_rules.h"

namespace dsw {

namespace Eigen = ::dsw_eigen;

}  // namespace dsw
