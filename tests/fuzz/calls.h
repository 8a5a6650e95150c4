#pragma once
// One call after the other, as bytes say. They mean the same to all compilers: since arguments of one call are
// evaluated in any order, at most one of them reads bytes.

#include "use.h"

namespace dsw_fuzz {

class Calls {
 public:
  /** The object has to outlive the scene's environment, which is of that world, and to which it lends points. */
  Calls(dsw_scene* scene, const World& world, Bytes* bytes);

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
  dsw_status look(uint32_t which);
  dsw_status add_volumes();
  dsw_status deform();
  dsw_status remesh();
  dsw_status look_at_cells();
  dsw_status look_at_changes();
  dsw_status look_at_scene();
  dsw_status look_at_body();
  dsw_status ask();
  dsw_status draw();
  dsw_status make_copies();

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
  /** Some points, one after the other, in the box of the environment or anywhere. */
  template <size_t N>
  void places(double (&points)[N]) {
    for (size_t i = 0; i + dimension_ <= N / 3 * dimension_; i += dimension_) place(points + i);
  }
  void place(double* xyz);
  dsw_mark mark() { return bytes_.below(4) == 0 ? DSW_MARK_PASSABLE : DSW_MARK_IMPASSABLE; }
  bool wild() { return bytes_.below(16) == 15; }
  dsw_move_options options();
  /** Where all vertices of bodies go: some hundredths of a box away. */
  std::vector<double> targets_of(const dsw_body_id* ids, uint32_t count);
  /** Mostly some hundredths of a box. */
  double radius() { return wild() ? bytes_.number() : bytes_.byte() / 2048.0; }

  dsw_scene* scene_;
  dsw_environment* environment_;
  Bytes& bytes_;
  size_t dimension_;                       // doubles of a point
  double size_[3];                         // of the world
  uint32_t most_volumes_, most_vertices_;  // indices that are tried are below
  std::vector<double> lent_[2];
  std::vector<uint32_t> order_;
};

}  // namespace dsw_fuzz
