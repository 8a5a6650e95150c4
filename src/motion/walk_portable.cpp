#include "motion/walk.h"

namespace dsw {
namespace portable {
#include "motion/walk.inl"
}  // namespace portable

template <int D>
Walk<D> portable_walk() noexcept {
  return portable::this_walk<D>();
}
template Walk<2> portable_walk() noexcept;
template Walk<3> portable_walk() noexcept;

}  // namespace dsw
