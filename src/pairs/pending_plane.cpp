// Stands in until pairs serve the plane.

#include "contact/describe_pair.h"
#include "pairs/pair_sweep.h"

namespace dsw {

template <>
bool find_first_pair(const Partners<2>&, const Body<2>&, uint32_t, const double*, PairContact<2>*) noexcept {
  return false;
}
template <>
bool is_segment_apart(const Partners<2>&, const Body<2>&, const Corner&, const Corner&) noexcept {
  return true;
}
template <>
bool is_tetrahedron_apart(const Partners<2>&, const Body<2>&, const double* const*) noexcept {
  return true;
}
template <>
bool is_triangle_apart(const Partners<2>&, const Body<2>&, const Corner*) noexcept {
  return true;
}
template <>
bool is_way_apart(const Partners<2>&, const Body<2>&, uint32_t, const double*) noexcept {
  return true;
}
template <>
dsw_contact describe(const Environment<2>&, const Body<2>&, uint32_t, const double*, const PairContact<2>&) {
  return {};
}
template <>
dsw_contact_partner partner_of(const PairContact<2>&) noexcept {
  return {};
}

}  // namespace dsw
