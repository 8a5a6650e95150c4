#include "walk/walk.h"

#include "base/dimensions.h"

namespace dsw {
namespace portable {
#include "walk/walk.inl"
}  // namespace portable

constexpr Walk<2> kPlaneWalk = portable::kThisWalk<2>;
constexpr Walk<3> kPortableWalk = portable::kThisWalk<3>;

}  // namespace dsw
