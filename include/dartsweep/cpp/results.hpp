// Results of calls that give more than one, ids, defaults, and how lists are copied.
#pragma once

#include <algorithm>

#include "dartsweep/cpp/arrays.hpp"
#include "dartsweep/dartsweep.h"

namespace dartsweep {

struct Located {
  dsw_volume_id volume;  // null when outside
  dsw_location location;
};

struct VolumeCounts {
  dsw_cell_type type;
  std::uint32_t vertices, edges, faces;
};

struct FaceVolumes {
  dsw_volume_id near_side, far_side;
};

struct Neighbour {
  dsw_volume_id volume;  // null at the outer boundary
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
  Vec3 position;  // in the plane z is 0
  dsw_volume_id volume;
};

struct BodyFilter {
  std::uint32_t category, mask;
};

struct Depenetration {
  bool freed;
  double distance;  // of the vertex that moved farthest
};

/** The cell that an id names. */
inline dsw_cell cell_of(dsw_vertex_id id) { return {DSW_CELL_VERTEX, id.index, id.generation, 0}; }
inline dsw_cell cell_of(dsw_edge_id id) {
  return {DSW_CELL_EDGE, id.volume, id.generation, id.local};
}
inline dsw_cell cell_of(dsw_face_id id) {
  return {DSW_CELL_FACE, id.volume, id.generation, id.local};
}
inline dsw_cell cell_of(dsw_volume_id id) { return {DSW_CELL_VOLUME, id.index, id.generation, 0}; }

/** Throws what a call with this status would. For tests. */
inline void raise_status(dsw_status status) {
  if (status != DSW_STATUS_OK) throw_status(status, dsw_status_string(status));
}

#ifndef SWIG
/** Whether an id names nothing. */
template <class Id>
bool is_null(const Id &id) {
  return id.generation == 0;
}

inline bool equal(dsw_face_id a, dsw_face_id b) {
  return a.volume == b.volume && a.generation == b.generation && a.local == b.local;
}
inline bool equal(dsw_edge_id a, dsw_edge_id b) {
  return a.volume == b.volume && a.generation == b.generation && a.local == b.local;
}
/** Whether two ids name the same. */
template <class Id>
bool equal(Id a, Id b) {
  return a.index == b.index && a.generation == b.generation;
}

/** A description or options with their defaults: defaults<dsw_move_options>(). */
template <class T>
T defaults();
#define DSW_DEFAULTS(type)           \
  template <>                        \
  inline type defaults<type>() {     \
    type made;                       \
    type##_init(&made, sizeof made); \
    return made;                     \
  }
DSW_DEFAULTS(dsw_environment_desc)
DSW_DEFAULTS(dsw_scene_desc)
DSW_DEFAULTS(dsw_body_desc)
DSW_DEFAULTS(dsw_volumes_desc)
DSW_DEFAULTS(dsw_cut_desc)
DSW_DEFAULTS(dsw_open_crack_desc)
DSW_DEFAULTS(dsw_carve_desc)
DSW_DEFAULTS(dsw_tie_desc)
DSW_DEFAULTS(dsw_detach_desc)
DSW_DEFAULTS(dsw_remesh_desc)
DSW_DEFAULTS(dsw_cast_options)
DSW_DEFAULTS(dsw_sweep_options)
DSW_DEFAULTS(dsw_move_options)
DSW_DEFAULTS(dsw_together_options)
DSW_DEFAULTS(dsw_scene_deform_options)
DSW_DEFAULTS(dsw_deform_options)
DSW_DEFAULTS(dsw_coarsen_options)
#undef DSW_DEFAULTS

/** What was given, or the defaults. */
template <class T>
T or_defaults(const T *given) {
  return given ? *given : defaults<T>();
}

/** How many points of `next` a deformation reads. The points beyond are room. */
template <class Options>
std::size_t read_count(const dsw_environment *environment, const Lent &next, Options &options) {
  if (options.point_room > next.count)
    throw WrongSize("point_room is " + std::to_string(options.point_room) + ", there are " +
                    std::to_string(next.count) + " points");
  const double *now = nullptr;
  std::size_t count = 0;
  check(dsw_environment_get_points(environment, &now, &count));
  if (next.count > count) options.point_room = next.count;
  return std::min(next.count, count);
}

/** Whether a deformation has made an array what the environment reads. */
inline bool is_read(const dsw_environment *environment, const Lent &next) {
  const double *now = nullptr;
  std::size_t count = 0;
  check(dsw_environment_get_points(environment, &now, &count));
  return now == next.data;
}
#endif

/** What get(&pointer, &count) lends, copied while the lock is held. */
template <class T, class Get>
Array<T> copied(Get get) {
  const T *lent = nullptr;
  std::size_t count = 0;
  check(get(&lent, &count));
  return Array<T>(lent, count);
}

/** What get(out, capacity, &count) fills. The first call tells how much there is. */
template <class T, class Get>
Array<T> filled(Get get) {
  std::size_t count = 0;
  const dsw_status status = get(static_cast<T *>(nullptr), std::size_t{0}, &count);
  if (status != DSW_STATUS_BUFFER_TOO_SMALL) check(status);
  Array<T> out(count);
  if (count) check(get(out.data(), count, &count));
  return out;
}

/** What a change of the topology did. Its arrays are copies, which the pointers of dsw_change lead
 * to. */
class Change : public dsw_change {
 public:
  explicit Change(const dsw_change &lent)
      : dsw_change(lent),
        volumes_(lent.volumes, lent.volume_count),
        vertices_(lent.vertices, lent.vertex_count),
        faces_(lent.faces, lent.face_count),
        whole_(lent.whole, lent.whole_count),
        carved_(lent.carved, lent.carved_count),
        unrepaired_(lent.unrepaired, lent.unrepaired_count),
        detached_(lent.detached, lent.detached_count),
        body_vertices_(lent.body_vertices, lent.body_vertex_count),
        body_faces_(lent.body_faces, lent.body_face_count) {
    volumes = volumes_.data();
    vertices = vertices_.data();
    faces = faces_.data();
    whole = whole_.data();
    carved = carved_.data();
    unrepaired = unrepaired_.data();
    detached = detached_.data();
    body_vertices = body_vertices_.data();
    body_faces = body_faces_.data();
  }

  Array<dsw_volume_change> get_volumes() const { return copy(volumes_); }
  Array<dsw_vertex_origin> get_vertices() const { return copy(vertices_); }
  Array<dsw_cut_face> get_faces() const { return copy(faces_); }
  Array<dsw_volume_id> get_whole() const { return copy(whole_); }
  Array<dsw_volume_id> get_carved() const { return copy(carved_); }
  Array<dsw_volume_id> get_unrepaired() const { return copy(unrepaired_); }
  Array<dsw_volume_id> get_detached() const { return copy(detached_); }
  Array<dsw_vertex_origin> get_body_vertices() const { return copy(body_vertices_); }
  Array<dsw_face_origin> get_body_faces() const { return copy(body_faces_); }

 private:
  template <class T>
  static Array<T> copy(const Array<T> &from) {
    return Array<T>(from.data(), from.size());
  }

  Array<dsw_volume_change> volumes_;
  Array<dsw_vertex_origin> vertices_;
  Array<dsw_cut_face> faces_;
  Array<dsw_volume_id> whole_, carved_, unrepaired_, detached_;
  Array<dsw_vertex_origin> body_vertices_;
  Array<dsw_face_origin> body_faces_;
};

}  // namespace dartsweep
