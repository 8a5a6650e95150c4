#include "base/dimensions.h"
#include "motion/walk.h"

namespace dsw {
namespace portable {
#include "motion/walk.inl"
}  // namespace portable

template <int D>
Walk<D> portable_walk() noexcept {
  return portable::this_walk<D>();
}
DSW_INSTANTIATE(portable_walk);

}  // namespace dsw
