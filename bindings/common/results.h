// Answers of calls that have more than one, and helpers for answers that are lists.
#pragma once

#include "common/arrays.h"
#include "dartsweep/dartsweep.h"

namespace dartsweep {

struct Location {
  dsw_volume_id volume;  // Null when outside.
  dsw_place place;
};

struct VolumeCounts {
  dsw_cell_type type;
  std::uint32_t vertices, edges, faces;
};

struct FaceVolumes {
  dsw_volume_id near_side, far_side;
};

struct Neighbour {
  dsw_volume_id volume;  // Null at the outer boundary.
  bool impassable;
};

struct Marked {
  std::size_t marked, skipped;
};

struct VolumeSplit {
  dsw_volume_id left, right;
  dsw_face_id face;
};

struct FaceSplit {
  dsw_face_id left, right;
  dsw_edge_id edge;
};

struct EdgeSplit {
  dsw_vertex_id vertex;
  dsw_edge_id first, second;
};

struct Particle {
  dsw_vec3 position;  // In the plane z is 0, as in all structs.
  dsw_volume_id volume;
};

struct Detached {
  dsw_body_id body;
  dsw_detach_report report;
};

struct BodyFilter {
  std::uint32_t category, mask;
};

/** The cell that an id names. */
inline dsw_cell cell_of(dsw_vertex_id id) { return {DSW_CELL_VERTEX, id.index, id.generation, 0}; }
inline dsw_cell cell_of(dsw_edge_id id) { return {DSW_CELL_EDGE, id.volume, id.generation, id.local}; }
inline dsw_cell cell_of(dsw_face_id id) { return {DSW_CELL_FACE, id.volume, id.generation, id.local}; }
inline dsw_cell cell_of(dsw_volume_id id) { return {DSW_CELL_VOLUME, id.index, id.generation, 0}; }

// Throws what a call with this status would: for hosts' tests of their exceptions.
inline void raise_status(dsw_status status) {
  if (status != DSW_STATUS_OK) throw Error(status, dsw_status_string(status));
}

// What get(&pointer, &count) lends, copied while the lock is held.
template <class T, class Get>
Array<T> copied(Get get) {
  const T *lent = nullptr;
  std::size_t count = 0;
  check(get(&lent, &count));
  return Array<T>(lent, count);
}

// What get(out, capacity, &count) fills: asked twice, since the first call tells how much there is.
template <class T, class Get>
Array<T> filled(Get get) {
  std::size_t count = 0;
  const dsw_status status = get(static_cast<T *>(nullptr), std::size_t{0}, &count);
  if (status != DSW_STATUS_BUFFER_TOO_SMALL) check(status);
  Array<T> out(count);
  if (count) check(get(out.data(), count, &count));
  return out;
}

}  // namespace dartsweep
