#include "scene/free_fractions.h"

#include <algorithm>

#include "base/search.h"
#include "capi/body_access.h"
#include "capi/rows.h"
#include "dartsweep/move.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr size_t kNumbersOfPose = 7, kMostPaths = size_t{1} << 28;
constexpr uint32_t kPoseOffPlane = 1u << 0 | 1u << 1 | 1u << 6;  // the numbers of a pose that are 0 in the plane
static_assert(sizeof(dsw::Pose) == kNumbersOfPose * sizeof(double), "a pose is read where it is");

/** Refuses what is not finite, what leaves the plane, quaternions of 0, and poses that lead further than doubles go. */
template <int D>
void check_poses(const dsw::Body<D>& body, const double* centre, const double* poses, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const double* const pose = poses + kNumbersOfPose * i;
    capi::check_row("poses", i, pose, kNumbersOfPose, D == 2 ? kPoseOffPlane : 0);
    if (dsw::all_of(pose, pose + 4, [](double x) { return x == 0; })) {
      fail(DSW_STATUS_OUT_OF_RANGE, "poses[%zu] has a quaternion that is 0", i);
    }
    if (dsw::is_pose_finite(body, centre, reinterpret_cast<const dsw::Pose*>(poses)[i])) continue;
    fail(DSW_STATUS_NON_FINITE, "poses[%zu] leads further than doubles go", i);
  }
}

/** How many indices there are. Refuses paths without poses. */
size_t check_path_offsets(const uint32_t* offsets, size_t path_count) {
  if (offsets == nullptr) return 2 * path_count;
  if (offsets[0] != 0) fail(DSW_STATUS_WRONG_SIZE, "offsets[0] is %u, must be 0", offsets[0]);
  for (size_t i = 0; i < path_count; ++i) {
    if (offsets[i] < offsets[i + 1]) continue;
    fail(DSW_STATUS_WRONG_SIZE, "offsets[%zu] is %u after %u: a path has at least one pose", i + 1, offsets[i + 1],
         offsets[i]);
  }
  return offsets[path_count];
}

void check_pose_indices(const uint32_t* indices, size_t count, size_t pose_count) {
  for (size_t i = 0; i < count; ++i) {
    if (indices[i] < pose_count) continue;
    fail(DSW_STATUS_OUT_OF_RANGE, "indices[%zu] is %u, must be below %zu", i, indices[i], pose_count);
  }
}

}  // namespace

dsw_status dsw_body_find_free_fractions(const dsw_scene* scene, dsw_body_id body, const double* centre,
                                        const double* poses, size_t pose_count, const uint32_t* indices,
                                        const uint32_t* offsets, size_t path_count, dsw_free_fraction* fractions,
                                        dsw_body_contact* contacts) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    constexpr int D = capi::kDimension<decltype(of)>;
    dsw::to_finite_point(D, centre, "centre");
    if (pose_count > kMostPaths) {
      fail(DSW_STATUS_TOO_LARGE, "pose_count is %zu, must be at most %zu", pose_count, kMostPaths);
    }
    if (path_count > kMostPaths) {
      fail(DSW_STATUS_TOO_LARGE, "path_count is %zu, must be at most %zu", path_count, kMostPaths);
    }
    dsw::require_array(poses, pose_count, "poses");
    dsw::require_array(indices, path_count, "indices");
    dsw::require_array(fractions, path_count, "fractions");
    check_pose_indices(indices, check_path_offsets(offsets, path_count), pose_count);
    check_poses(of.body, centre, poses, pose_count);
    dsw::Array<dsw::FreeFraction> found(path_count, dsw::FreeFraction{}, of.scene.memory);
    const dsw::PosePaths paths{centre, reinterpret_cast<const dsw::Pose*>(poses), indices, offsets, path_count};
    // The arrays of the host stay as they are if memory runs out.
    dsw::Array<dsw_body_contact> met(contacts != nullptr ? path_count : 0, dsw_body_contact{}, of.scene.memory);
    find_free_fractions(of.scene, of.record, paths, found.data(), contacts != nullptr ? met.data() : nullptr);
    std::copy(met.begin(), met.end(), contacts);
    for (size_t i = 0; i < path_count; ++i) {
      fractions[i] = {found[i].fraction, found[i].piece_fraction, found[i].piece, found[i].is_start_free ? 1u : 0u};
    }
  });
}
