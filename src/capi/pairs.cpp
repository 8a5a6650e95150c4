#include "dartsweep/pairs.h"

#include "base/point_ends.h"
#include "capi/handle.h"
#include "capi/rows.h"
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

constexpr size_t kNumbersOfMotion = 17;
// The numbers of a motion that are 0 in the plane.
constexpr uint32_t kMotionOffPlane = 1u << 0 | 1u << 1 | 1u << 4 | 1u << 5 | 1u << 10 | 1u << 13 | 1u << 16;

/** Refuses what is not finite, what leaves the plane, and quaternions that are 0 at some time. */
void check_motions(uint32_t dimension, const double* motions, size_t count) {
  static_assert(sizeof(dsw::TurningWay) == kNumbersOfMotion * sizeof(double), "a motion is read where it is");
  for (size_t i = 0; i < count; ++i) {
    capi::check_row("motions", i, motions + kNumbersOfMotion * i, kNumbersOfMotion,
                    dimension == 2 ? kMotionOffPlane : 0);
    const dsw::TurningWay& way = reinterpret_cast<const dsw::TurningWay*>(motions)[i];
    if (capi::with_dimension(dimension, [&](auto d) { return dsw::has_turn<decltype(d)::value>(way); })) continue;
    fail(DSW_STATUS_OUT_OF_RANGE, "motions[%zu] has a quaternion that is 0 at some time", i);
  }
}

void check_indices(const uint32_t* indices, size_t count, size_t motion_count) {
  for (size_t i = 0; i < count; ++i) {
    if (indices[i] == dsw::kNoMotion || indices[i] < motion_count) continue;
    fail(DSW_STATUS_OUT_OF_RANGE, "indices[%zu] is %u, must be below %zu or UINT32_MAX", i, indices[i], motion_count);
  }
}

/** What both functions are given. */
struct Arguments {
  const dsw_context* context;
  uint32_t dimension, flags;
  size_t count;
  const uint8_t* kinds;
  const double *from, *to;
  size_t stride_bytes;
  dsw_pair_touch* touches;

  dsw::PointEnds check() const {
    if (context != nullptr) capi::check_handle(context);
    if (dimension != 2 && dimension != 3) fail(DSW_STATUS_OUT_OF_RANGE, "dimension is %u, must be 2 or 3", dimension);
    if (count > kMostPairs) fail(DSW_STATUS_TOO_LARGE, "count is %zu, must be at most %zu", count, kMostPairs);
    dsw::require_array(kinds, count, "kinds");
    dsw::check_flags(flags, DSW_PAIRS_RANK, "flags");
    const int D = static_cast<int>(dimension);
    const size_t point_count = count * (dimension + 1);
    const dsw::PointEnds points = dsw::to_finite_ends(D, from, to, point_count, stride_bytes);
    dsw::require_array(touches, count, "touches");
    check_kinds(dimension, kinds, count);
    return points;
  }

  dsw::Parallel parallel() const { return context == nullptr ? dsw::Parallel{} : context->parallel; }
  bool has_ranks() const noexcept { return (flags & DSW_PAIRS_RANK) != 0; }
};

}  // namespace

dsw_status dsw_sweep_pairs(const dsw_context* context, uint32_t dimension, size_t count, const uint8_t* kinds,
                           const double* from, const double* to, size_t stride_bytes, uint32_t flags,
                           dsw_pair_touch* touches) {
  return capi::guard(__func__, [&] {
    const Arguments a{context, dimension, flags, count, kinds, from, to, stride_bytes, touches};
    const dsw::PointEnds points = a.check();
    capi::with_dimension(dimension, [&](auto d) {
      dsw::sweep_pairs<decltype(d)::value>(capi::memory_of(context), a.parallel(), count, kinds, points.starts,
                                           points.ends, a.has_ranks(), touches);
    });
  });
}

dsw_status dsw_sweep_rigid_pairs(const dsw_context* context, uint32_t dimension, size_t count, const uint8_t* kinds,
                                 const double* from, const double* to, size_t stride_bytes, const double* motions,
                                 size_t motion_count, const uint32_t* indices, uint32_t flags,
                                 dsw_pair_touch* touches) {
  return capi::guard(__func__, [&] {
    const Arguments a{context, dimension, flags, count, kinds, from, to == nullptr ? from : to, stride_bytes, touches};
    const dsw::PointEnds points = a.check();
    dsw::require_array(motions, motion_count, "motions");
    dsw::require_array(indices, count, "indices");
    check_motions(dimension, motions, motion_count);
    check_indices(indices, 2 * count, motion_count);
    capi::with_dimension(dimension, [&](auto d) {
      dsw::sweep_rigid_pairs<decltype(d)::value>(capi::memory_of(context), a.parallel(), count, kinds, points.starts,
                                                 points.ends, reinterpret_cast<const dsw::TurningWay*>(motions),
                                                 indices, a.has_ranks(), touches);
    });
  });
}
