// Bodies as the public interface tells of them, and the calls that make, move and read one.
#pragma once

#include "defaults.h"
#include "exact.h"

#include <string>

namespace dsw::oracle {

/// What a body is made from. In the plane the last of three coordinates is 0.
struct BodyPlan {
  std::vector<Vec> at;
  std::vector<std::array<uint32_t, 2>> edges;
  std::vector<std::vector<uint32_t>> faces;  // three corners or more
};

/// A body as the public interface tells of it; vertices by slot.
struct BodyState {
  std::vector<Vec> at;
  std::vector<dsw_volume_id> volumes;
  std::vector<dsw_body_vertex_id> vertices;  // of generation 0: a free slot
  std::vector<dsw_body_edge_id> edge_ids;
  std::vector<std::array<uint32_t, 2>> edges;
  std::vector<dsw_body_face_id> face_ids;
  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<uint32_t> untested;  // indices of edges that were left so, ascending

  /// Where the vertex would go to, and what hangs on it. The edges and faces come in the order of the lists.
  VertexMove flight(size_t vertex, const Vec& to, std::vector<size_t>* edges_of = nullptr,
                    std::vector<size_t>* faces_of = nullptr) const;
};

/// The state that dsw_body_create must make of a plan; volumes, and generations of ids, are left out.
BodyState state_of(const BodyPlan& plan);

dsw_status create_body(dsw_scene* scene, const BodyPlan& plan, dsw_level level, uint32_t flags,
                       const std::vector<dsw_volume_id>& hints, dsw_body_id* body, double radius = 0);

/// What is wrong: a call that failed, parts that do not fit; empty if nothing is.
std::string read_body(const dsw_scene* scene, dsw_body_id body, BodyState& state);

/// What the library answered to a move.
struct BodyAnswer {
  dsw_move_report report;
  std::vector<dsw_body_contact> contacts;
  BodyState after;
};

/// Moves, and reads what came of it. `targets` by slot. What is wrong, or empty.
std::string move_body(dsw_scene* scene, dsw_body_id body, const std::vector<Vec>& targets,
                      const dsw_move_options* options, BodyAnswer& answer);

/// Every byte of the contacts and positions, ids included, as text.
std::string bits_of(const BodyAnswer& answer);

}  // namespace dsw::oracle
