// One body of a scene and its physics. In a scene in the plane all third coordinates are 0.
#ifndef DARTSWEEP_PHYSICS_SOFT_BODY_H
#define DARTSWEEP_PHYSICS_SOFT_BODY_H

#include <optional>
#include <string>

#include "contact_response.h"
#include "integrators.h"
#include "library.h"
#include "removal.h"
#include "shape_matching.h"

namespace physics {

struct SoftBodyOptions {
  IntegratorOptions integrator;
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;  // of a line
  dsw_move_options move;                    // how the library answers contacts
  double omega = 0.5;                       // share of the mass that an inserted vertex takes over, see Points::split
  double match = 0;                         // with a shape: share of the way to its goals made in one step, in (0, 1]
  // With a shape: inserted vertices go by the criterion of [JCD10] 7.3.1 (removal.h). A pull of so large a share of the
  // radius of the shape at rest is negligible. 0: none go this way. `move.noise_share` is ours and goes by the line
  // between two neighbours instead.
  double negligible = 0;
  double restitution = 0;
  int contact_rounds = 8;
  // For so many steps a contact that presses stays a constraint of the physics, found again or not: targets then do not lead into a wall that
  // is known, and the library has no contact to find. 0: every step finds its contacts anew. What kept contacts do to walls that give
  // way is not handed to them.
  int contact_memory = 0;
  std::size_t most_vertices = 1000;  // a body with as many gets no new ones: its edges slide
  Friction friction;

  // Vertices slide; edges get new vertices where there is room and slide where there is none; inserted ones go when they are in line again.
  SoftBodyOptions();
};

// A body as it is made: its corners, and edges (two indices each) or triangles (three).
struct BodyMesh {
  Positions corners;
  std::vector<std::uint32_t> edges, triangles;
};

struct StepReport {
  dsw_move_report move;
  dsw_status status = DSW_STATUS_OK;  // of the move; NON_FINITE: see SoftBody::step
  bool was_finite = true;             // false: positions or velocities that physics wanted were no numbers
  std::string message;                // of the library, where it refused them
  std::size_t inserted = 0, removed = 0;
  double library_seconds = 0;  // of the move, on the wall clock
};

class SoftBody {
 public:
  // A polyline through `line`. Throws LibraryError where it is not free.
  SoftBody(dsw_scene* scene, const Positions& line, double mass_each, const SoftBodyOptions& options);
  // A closed or open surface of triangles (three indices each), at level FACES.
  SoftBody(dsw_scene* scene, const Positions& corners, const std::vector<std::uint32_t>& triangles, double mass_each,
           const SoftBodyOptions& options);
  // Edges at the level of the options, triangles at level FACES.
  SoftBody(dsw_scene* scene, const BodyMesh& mesh, double mass_each, const SoftBodyOptions& options);

  // One time step: remove inserted vertices that `negligible` allows to remove, integrate, move as far as the library
  // finds free, follow its edits, answer its contacts.
  // Targets that are no numbers are refused by the library (DSW_STATUS_NON_FINITE): the body stays where it was, at rest, and the
  // scene goes on from there. Velocities that are no numbers although the targets are become 0. Throws LibraryError for whatever else a
  // call answers.
  StepReport step(double dt);
  // Living vertices.
  std::size_t count() const;

  // Adds a vertex before vertex `next` of a line, and the spring between them; false where the edge is not free.
  bool add_vertex(const Vector3& at, std::size_t next, double mass, double stretching, double bending,
                  std::size_t* added);

  // Reads positions back: a wall may have pushed (walls.h), and inserted vertices.
  void read_positions();
  // Applies the edits that the library made in its last call.
  void follow_edits(StepReport* report);
  // With a shape: how far each vertex is from its goal, 0 in free slots. That is the pull of the shape, see removal.h.
  std::vector<double> pulls();

  dsw_scene* scene() const { return scene_; }
  dsw_body_id id() const { return id_; }
  const std::vector<Touch>& touches() const { return touches_; }
  const InsertedVertices& inserted() const { return inserted_; }
  bool was_inserted(std::size_t i) const { return inserted_.contains(i); }

  Points points;
  std::vector<dsw_volume_id> volumes;  // that the points lie in
  Positions targets;                   // of the last move, before anything stopped it
  Springs springs;
  std::optional<ShapeMatching> shape;
  Load load;
  SoftBodyOptions options;

 private:
  void follow_edit(const dsw_body_edit& edit, StepReport* report);
  void remove_negligible(StepReport* report);
  void create(const Positions& corners, double mass_each, dsw_body_desc* desc);
  void pull_into_shape(double dt, Points* next);
  void stay_off_known_walls(double dt, Points* next);
  void remember_contacts();

  dsw_scene* scene_;
  dsw_body_id id_ = {0, 0};
  InsertedVertices inserted_;
  std::vector<std::size_t> new_;        // inserted since the last move began
  std::vector<double> whole_;           // masses before the first of the inserted vertices
  std::vector<Touch> touches_, known_;  // of the last move; of earlier ones, see contact_memory
};

}  // namespace physics

#endif
