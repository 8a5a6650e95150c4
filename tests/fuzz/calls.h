#pragma once
// One call after the other, as bytes say.

#include "use.h"

namespace dsw_fuzz {

class Calls {
 public:
  /** A scene made by make_home(); the object has to outlive its environment, to which it lends points. */
  Calls(dsw_scene* scene, Bytes* bytes)
      : scene_(scene), environment_(dsw_scene_get_environment(scene)), bytes_(*bytes) {}

  /** Makes the next call. */
  dsw_status make();

 private:
  dsw_status change_marks(uint32_t which);
  dsw_status change_topology(uint32_t which);
  dsw_status cut(uint32_t which);
  dsw_status use_particles(uint32_t which);
  dsw_status make_bodies(uint32_t which);
  dsw_status edit_body(uint32_t which);
  dsw_status move_bodies(uint32_t which);
  dsw_status add_volumes();
  dsw_status deform();
  dsw_status remesh();

  /** Mostly something that there is; else anything. */
  dsw_volume_id volume();
  dsw_face_id face();
  dsw_edge_id edge();
  dsw_vertex_id vertex();
  dsw_particle_id particle();
  dsw_body_id body();
  dsw_body_vertex_id body_vertex(dsw_body_id of);
  dsw_body_edge_id body_edge(dsw_body_id of);
  dsw_body_face_id body_face(dsw_body_id of);
  /** A number in the box of the environment, or any. */
  void place(double* xyz);
  dsw_mark mark() { return bytes_.below(4) == 0 ? DSW_MARK_PASSABLE : DSW_MARK_IMPASSABLE; }
  bool wild() { return bytes_.below(16) == 15; }
  dsw_move_options options();

  dsw_scene* scene_;
  dsw_environment* environment_;
  Bytes& bytes_;
  std::vector<double> lent_[2];
  std::vector<uint32_t> order_;
};

}  // namespace dsw_fuzz
