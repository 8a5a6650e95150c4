#include "dartsweep/pairs.h"

#include "capi/handle.h"
#include "query/moving_pairs.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr size_t kMostPairs = size_t{1} << 28;

/** Refuses kinds that the dimension does not have. */
void check_kinds(uint32_t dimension, const uint8_t* kinds, size_t count) {
  const uint32_t first = dimension == 2 ? DSW_PAIR_VERTEX_EDGE : DSW_PAIR_VERTEX_FACE,
                 last = dimension == 2 ? DSW_PAIR_VERTEX_EDGE : DSW_PAIR_EDGE_EDGE;
  for (size_t i = 0; i < count; ++i) {
    if (kinds[i] >= first && kinds[i] <= last) continue;
    fail(DSW_STATUS_UNSUPPORTED, "kinds[%zu] is %u, must be %u .. %u in dimension %u", i, unsigned{kinds[i]}, first,
         last, dimension);
  }
}

}  // namespace

dsw_status dsw_sweep_pairs(const dsw_context* context, uint32_t dimension, size_t count, const uint8_t* kinds,
                           const double* from, const double* to, size_t stride_bytes, uint32_t flags,
                           dsw_pair_touch* touches) {
  return capi::guard(__func__, [&] {
    if (context != nullptr) capi::check_handle(context);
    if (dimension != 2 && dimension != 3) fail(DSW_STATUS_OUT_OF_RANGE, "dimension is %u, must be 2 or 3", dimension);
    if (count > kMostPairs) fail(DSW_STATUS_TOO_LARGE, "count is %zu, must be at most %zu", count, kMostPairs);
    dsw::require_array(kinds, count, "kinds");
    dsw::check_flags(flags, DSW_PAIRS_RANK, "flags");
    const int D = static_cast<int>(dimension);
    const size_t point_count = count * (dimension + 1);
    const dsw::PointArray starts = dsw::to_finite_points(D, from, point_count, stride_bytes, "from"),
                          ends = dsw::to_finite_points(D, to, point_count, stride_bytes, "to");
    dsw::require_array(touches, count, "touches");
    check_kinds(dimension, kinds, count);
    const dsw::Parallel parallel = context == nullptr ? dsw::Parallel{} : context->parallel;
    const auto sweep = dimension == 2 ? dsw::sweep_pairs<2> : dsw::sweep_pairs<3>;
    sweep(capi::memory_of(context), parallel, count, kinds, starts, ends, (flags & DSW_PAIRS_RANK) != 0, touches);
  });
}
