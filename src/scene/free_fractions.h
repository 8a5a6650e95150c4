#pragma once
// How far a body could go along paths of poses. Nothing moves.

#include "scene/scene.h"

namespace dsw {

/** Where a body could be: turned about a centre and shifted, from where it is. The array of the host is read in place. */
struct Pose {
  double rotation[4];  // x y z w, of any length but 0
  double translation[3];
};

/** Paths through poses, which several of them may share. */
struct PosePaths {
  const double* centre;     // D numbers
  const Pose* poses;        // in the plane with third components of 0
  const uint32_t* indices;  // of poses, path after path
  const uint32_t* offsets;  // count + 1, where each path begins in `indices`; null: each has two poses
  size_t count;

  uint32_t begin(size_t path) const noexcept {
    return offsets != nullptr ? offsets[path] : 2 * static_cast<uint32_t>(path);
  }
};

/** See dsw_free_fraction. */
struct FreeFraction {
  double fraction = 0, piece_fraction = 0;
  uint32_t piece = 0;
  bool is_start_free = false;
};

/** Whether all of a body stays within doubles in a pose. */
template <int D>
bool is_pose_finite(const Body<D>& body, const double* centre, const Pose& pose) noexcept;

/** Finds how far a body could go along each path, and with `contacts`, one for each path, what it would touch first: zeros
 * where there is nothing. What is found for one path does not depend on the others. Throws std::bad_alloc with some answers written. */
template <int D>
void find_free_fractions(const Scene<D>& scene, const BodyRecord<D>& of, const PosePaths& paths,
                         FreeFraction* fractions, dsw_body_contact* contacts);

}  // namespace dsw
