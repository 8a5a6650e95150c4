// Edits of bodies: free after each, or refused for a reason and with nothing changed.
#include "body_course.h"

#include <algorithm>

namespace dsw::oracle {

void Course::editing() {
  const uint32_t flags = rng_.chance(0.5) ? 0 : DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_CLEARANCE;
  SweepReport& faults = report_.at(level_);
  BodyChecker checker(arena_, faults);
  Bodies source(arena_, places_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  if (!create(checker, source, faults, flags, plan, body, state)) return;
  for (int i = 0; i < 20 && !state.at.empty(); ++i) {
    const BodyState before = state;
    const uint32_t kind = rng_.below(10);
    std::string how = "edit " + std::to_string(i) + " of kind " + std::to_string(kind);
    const dsw_status status = edit(body, source, before, kind, faults);
    const std::string fault = read_body(scene_, body, state);
    if (!fault.empty()) {
      faults.fault(SweepReport::kWrong, how + ": " + fault);
      break;
    }
    ++report_.body_edits;
    how += std::string(" answered ") + dsw_status_string(status);
    if (status != DSW_STATUS_OK &&
        (state.at != before.at || state.edges != before.edges || state.faces != before.faces)) {
      faults.fault(SweepReport::kWrong, how + " and something has changed");
    }
    checker.placed(state, level_, how);
  }
  dsw_body_destroy(scene_, body);
}

dsw_status Course::edit(dsw_body_id body, Bodies& source, const BodyState& state, uint32_t kind, SweepReport& faults) {
  const auto any = [&]() {
    uint32_t v = rng_.below(state.at.size());
    while (state.vertices[v].generation == 0) v = (v + 1) % static_cast<uint32_t>(state.at.size());
    return v;
  };
  const bool bare = state.edges.empty();
  if (std::none_of(state.vertices.begin(), state.vertices.end(), [](auto v) { return v.generation != 0; })) kind = 7;
  switch (bare && kind < 5 ? 7 : kind) {
    case 0:
    case 1:
    case 2: {
      static const double shares[] = {0.5, 0.25, 1e-9, 0.3333};
      return dsw_body_split_edge(scene_, body, state.edge_ids[rng_.below(state.edges.size())], shares[rng_.below(4)],
                                 nullptr);
    }
    case 3:
    case 4: {
      const size_t e = rng_.below(state.edges.size());
      const uint32_t from = state.edges[e][rng_.below(2)], to = state.edges[e][state.edges[e][0] == from ? 1 : 0];
      const dsw_status status = dsw_body_collapse_edge(scene_, body, state.edge_ids[e], state.vertices[from], nullptr);
      const bool free = arena_.exact.move(state.flight(from, state.at[to]), level_).events.empty();
      if (status == DSW_STATUS_NOT_MANIFOLD || status == (free ? DSW_STATUS_OK : DSW_STATUS_OCCUPIED)) return status;
      faults.fault(free ? SweepReport::kEarly : SweepReport::kMissed,
                   "collapsing " + describe(state.flight(from, state.at[to])) + ": " + dsw_status_string(status));
      return status;
    }
    case 5: {
      dsw_body_edge_id edge;
      const uint32_t a = any(), b = any();
      return dsw_body_add_edge(scene_, body, state.vertices[a], state.vertices[b], &edge);
    }
    case 6: {
      dsw_body_face_id face;
      const uint32_t a = any(), b = any(), c = any();
      const dsw_status status =
          dsw_body_add_face(scene_, body, state.vertices[a], state.vertices[b], state.vertices[c], &face);
      if (arena_.dimension == 2 && status == DSW_STATUS_OK) {
        faults.fault(SweepReport::kWrong, "a face in the plane: " + std::string(dsw_status_string(status)));
      }
      return status;
    }
    case 7: {
      dsw_body_vertex_id vertex;
      const Vec at = source.next().at[0];
      return dsw_body_add_vertex(scene_, body, at.data(), {0, 0}, &vertex);
    }
    case 8: {
      dsw_rigid_motion m;
      const Vec to = source.target(state, any());
      for (size_t k = 0; k < 3; ++k) {
        m.centre[k] = state.at[any()][k];
        m.translation[k] = rng_.chance(0.5) ? 0.1 * (to[k] - m.centre[k]) : 0;
        m.rotation[k] = k == 2 || arena_.dimension == 3 ? rng_.range(-1, 1) : 0;
      }
      m.rotation[3] = rng_.range(-1, 1);
      return dsw_body_move_rigid(scene_, body, &m, nullptr, nullptr);
    }
    default: {
      if (!state.faces.empty() && rng_.chance(0.3)) {
        return dsw_body_remove_face(scene_, body, state.face_ids[rng_.below(state.faces.size())]);
      }
      if (!bare && rng_.chance(0.3)) {
        return dsw_body_remove_edge(scene_, body, state.edge_ids[rng_.below(state.edges.size())]);
      }
      // To another level and back.
      const auto other = static_cast<dsw_level>(rng_.between(1, 4));
      BodyChecker checker(arena_, faults);
      const bool free = other <= level_ || checker.blocked_edges(state, other).empty();
      const dsw_status want = arena_.dimension == 2 && other == DSW_LEVEL_FACES ? DSW_STATUS_UNSUPPORTED
                              : free                                            ? DSW_STATUS_OK
                                                                                : DSW_STATUS_OCCUPIED;
      const dsw_status status = dsw_body_set_level(scene_, body, other);
      if (status != want) {
        faults.fault(free ? SweepReport::kEarly : SweepReport::kMissed,
                     "level " + std::to_string(other) + " answers " + dsw_status_string(status));
      }
      if (dsw_body_set_level(scene_, body, level_) != DSW_STATUS_OK) {
        faults.fault(SweepReport::kWrong, "no way back to the level");
      }
      return status;
    }
  }
}

}  // namespace dsw::oracle
