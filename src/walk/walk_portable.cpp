#include "base/dimensions.h"
#include "walk/walk.h"

namespace dsw {
namespace portable {
#include "walk/walk.inl"
}  // namespace portable

template <int D>
Walk<D> portable_walk() noexcept {
  return portable::this_walk<D>();
}
DSW_INSTANTIATE(portable_walk);

}  // namespace dsw
