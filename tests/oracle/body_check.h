// Compares what the library says of a moved body with the truth. A body moves one vertex after the other, so a move is
// replayed: each vertex's flight is judged with the others where they are by then, which is known without trusting more
// than the positions reached. Afterwards everything that the level covers must be free.
#pragma once

#include "body_state.h"
#include "sweep_check.h"

namespace dsw::oracle {

struct BodyMove {
  std::vector<uint32_t> order;  // never empty
  std::vector<Vec> targets;     // by slot
  bool drops = false;           // edges are left out on their way: contacts at edges may be missing
  bool stand_off = false;       // a wide one may leave no way at all
  bool all = false;             // DSW_SEARCH_EXHAUSTIVE: more contacts of a vertex may follow the first
};

class BodyChecker {
 public:
  BodyChecker(Arena& arena, SweepReport& report) : arena_(arena), report_(report) {}

  /// What of a body is not free at a level, or in no passable volume; empty if all is free.
  std::string not_free(const BodyState& state, dsw_level level);
  /// Edges that are not free at a level, faces' edges included at DSW_LEVEL_FACES.
  std::vector<size_t> blocked_edges(const BodyState& state, dsw_level level);
  /// Reports what is not free, and volumes that are not those of their vertices.
  void placed(const BodyState& state, dsw_level level, const std::string& how);
  /// An answer to a move whose contacts stop (DSW_RESPONSE_STOP) and are exact. Counts the steps.
  void replay(const BodyState& before, const BodyMove& move, dsw_level level, const BodyAnswer& answer,
              const std::string& how);
  /// Whether contacts say rightly that their vertex was stopped by the same obstacle in the move before.
  void history(const std::vector<dsw_body_contact>& before, const std::vector<dsw_body_contact>& now,
               const std::string& how);
  /// A contact against the sweep that it tells of, whatever came before.
  void alone(const dsw_body_contact& contact, const std::string& how);

  uint64_t true_contacts = 0, dropped = 0;  // of moves that may drop some
  double time_error = 0;                    // largest relative error of a reported time against the exact one

 private:
  void step(const BodyState& now, size_t vertex, const Vec& to, dsw_level level, const BodyMove& move,
            const dsw_body_contact* contact, const Vec& reached, const std::string& how);
  void judge(const VertexMove& flight, const MoveTruth& truth, const dsw_body_contact& contact, const std::string& what,
             const std::vector<dsw_body_edge_id>* edges, const std::vector<dsw_body_face_id>* faces);

  Arena& arena_;
  SweepReport& report_;
};

std::string describe(const VertexMove& flight);

}  // namespace dsw::oracle
