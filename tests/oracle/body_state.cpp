#include "body_state.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "names.h"

namespace dsw::oracle {
namespace {

std::array<uint32_t, 2> ordered(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

template <class Id>
std::string read_ids(const dsw_scene* scene, dsw_body_id body,
                     dsw_status (*get)(const dsw_scene*, dsw_body_id, Id*, size_t, size_t*), uint32_t expected,
                     std::vector<Id>& ids) {
  size_t count = 0;
  ids.resize(expected);
  const dsw_status status = get(scene, body, ids.data(), expected, &count);
  if (status != DSW_STATUS_OK) return std::string("ids: ") + dsw_last_error_message();
  return count == expected ? "" : "another number of ids than counted";
}

}  // namespace

VertexMove BodyState::flight(size_t vertex, const Vec& to, std::vector<size_t>* edges_of,
                             std::vector<size_t>* faces_of) const {
  VertexMove move = {at[vertex], to, {}, {}};
  std::vector<uint32_t> ends;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges[e][0] != vertex && edges[e][1] != vertex) continue;
    ends.push_back(edges[e][edges[e][0] == vertex ? 1 : 0]);
    move.fixed.push_back(at[ends.back()]);
    if (edges_of != nullptr) edges_of->push_back(e);
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    const auto& corners = faces[f];
    const size_t i = static_cast<size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
    if (i == 3) continue;
    std::array<size_t, 2> pair;
    for (size_t k = 0; k < 2; ++k) {
      pair[k] = static_cast<size_t>(std::find(ends.begin(), ends.end(), corners[(i + 1 + k) % 3]) - ends.begin());
    }
    move.faces.push_back(pair);
    if (faces_of != nullptr) faces_of->push_back(f);
  }
  return move;
}

BodyState state_of(const BodyPlan& plan) {
  BodyState s;
  s.at = plan.at;
  s.vertices.resize(plan.at.size());
  for (uint32_t v = 0; v < s.vertices.size(); ++v) s.vertices[v] = {v, 1};
  s.edges = plan.edges;
  const auto add_edge = [&](uint32_t a, uint32_t b) {
    for (const auto& e : s.edges) {
      if (ordered(e[0], e[1]) == ordered(a, b)) return;
    }
    s.edges.push_back({a, b});
  };
  for (const auto& f : plan.faces) {
    for (size_t i = 1; i + 1 < f.size(); ++i) s.faces.push_back({f[0], f[i], f[i + 1]});
  }
  for (const auto& f : s.faces) {
    for (size_t k = 0; k < 3; ++k) add_edge(f[k], f[(k + 1) % 3]);
  }
  return s;
}

dsw_status create_body(dsw_scene* scene, const BodyPlan& plan, dsw_level level, uint32_t flags,
                       const std::vector<dsw_volume_id>& hints, dsw_body_id* body, double radius) {
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  std::vector<uint32_t> offsets = {0}, corners;
  for (const auto& f : plan.faces) {
    corners.insert(corners.end(), f.begin(), f.end());
    offsets.push_back(static_cast<uint32_t>(corners.size()));
  }
  desc.flags = flags;
  desc.level = level;
  desc.radius = radius;
  desc.positions = plan.at[0].data();
  desc.stride_bytes = sizeof(Vec);
  desc.vertex_count = plan.at.size();
  desc.stride_bytes = sizeof(Vec);
  desc.hints = hints.empty() ? nullptr : hints.data();
  desc.edges = plan.edges.empty() ? nullptr : plan.edges[0].data();
  desc.edge_count = plan.edges.size();
  desc.face_count = plan.faces.size();
  if (!plan.faces.empty()) {
    desc.face_offsets = offsets.data();
    desc.face_corners = corners.data();
    desc.face_corner_count = corners.size();
  }
  return dsw_body_create(scene, &desc, body);
}

std::string read_body(const dsw_scene* scene, dsw_body_id body, BodyState& s) {
  dsw_body_counts counts;
  std::memset(&counts, 0, sizeof counts);
  counts.struct_size = sizeof counts;
  if (dsw_body_get_counts(scene, body, &counts) != DSW_STATUS_OK) return dsw_last_error_message();
  const size_t slots = counts.vertex_slots;
  size_t count = 0;
  s.at.assign(slots, {0, 0, 0});
  s.volumes.assign(slots, {0, 0});
  if (dsw_body_get_positions(scene, body, s.at[0].data(), slots, sizeof(Vec), s.volumes.data(), &count) !=
          DSW_STATUS_OK ||
      count != slots) {
    return std::string("positions: ") + dsw_last_error_message();
  }
  std::vector<dsw_body_vertex_id> living;
  std::string fault = read_ids(scene, body, dsw_body_get_vertex_ids, counts.vertex_count, living);
  if (fault.empty()) fault = read_ids(scene, body, dsw_body_get_edge_ids, counts.edge_count, s.edge_ids);
  if (fault.empty()) fault = read_ids(scene, body, dsw_body_get_face_ids, counts.face_count, s.face_ids);
  if (!fault.empty()) return fault;
  std::vector<dsw_body_edge_id> untested(s.edge_ids.size());
  if (dsw_body_get_untested_edges(scene, body, untested.data(), untested.size(), &count) != DSW_STATUS_OK)
    return dsw_last_error_message();
  s.untested.clear();
  for (size_t i = 0; i < count; ++i) {
    const auto is_it = [&](const dsw_body_edge_id& e) { return same_id(e, untested[i]); };
    if (std::none_of(s.edge_ids.begin(), s.edge_ids.end(), is_it)) return "an untested edge that is none";
    if (i > 0 && untested[i].index <= untested[i - 1].index) return "the order of untested edges";
    s.untested.push_back(untested[i].index);
  }
  s.vertices.assign(slots, {0, 0});
  for (const dsw_body_vertex_id& v : living) {
    if (v.index >= slots || v.generation == 0 || s.vertices[v.index].generation != 0) return "ids of vertices";
    s.vertices[v.index] = v;
  }
  const auto alive = [&](dsw_body_vertex_id v) {
    return v.index < slots && v.generation != 0 && s.vertices[v.index].generation == v.generation;
  };
  s.edges.clear();
  s.faces.clear();
  std::vector<std::array<uint32_t, 2>> sorted;
  for (const dsw_body_edge_id& e : s.edge_ids) {
    dsw_body_vertex_id v[2];
    if (dsw_body_get_edge_ends(scene, body, e, v) != DSW_STATUS_OK || !alive(v[0]) || !alive(v[1]))
      return "ends of an edge";
    s.edges.push_back({v[0].index, v[1].index});
    sorted.push_back(ordered(v[0].index, v[1].index));
  }
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return "an edge stands twice";
  for (const dsw_body_face_id& f : s.face_ids) {
    dsw_body_vertex_id v[3];
    if (dsw_body_get_face_corners(scene, body, f, v) != DSW_STATUS_OK) return "corners of a face";
    for (size_t k = 0; k < 3; ++k) {
      if (!alive(v[k])) return "a face with a corner that is gone";
      if (!std::binary_search(sorted.begin(), sorted.end(), ordered(v[k].index, v[(k + 1) % 3].index))) {
        return "a face without its edge";
      }
    }
    s.faces.push_back({v[0].index, v[1].index, v[2].index});
  }
  return "";
}

std::string move_body(dsw_scene* scene, dsw_body_id body, const std::vector<Vec>& targets,
                      const dsw_move_options* options, BodyAnswer& answer) {
  std::memset(&answer.report, 0xee, sizeof answer.report);
  if (dsw_body_move(scene, body, targets[0].data(), targets.size(), sizeof(Vec), options, &answer.report) !=
      DSW_STATUS_OK) {
    return std::string("move: ") + dsw_last_error_message();
  }
  const dsw_body_contact* contacts = nullptr;
  size_t count = 0;
  if (dsw_body_get_contacts(scene, body, &contacts, &count) != DSW_STATUS_OK) return dsw_last_error_message();
  answer.contacts.assign(contacts, contacts + count);
  return read_body(scene, body, answer.after);
}

std::string bits_of(const BodyAnswer& answer) {
  std::string bits;
  const auto add = [&](const void* data, size_t size) { bits.append(static_cast<const char*>(data), size); };
  for (const dsw_body_contact& c : answer.contacts) add(&c, offsetof(dsw_body_contact, history) + sizeof c.history);
  for (const Vec& p : answer.after.at) add(p.data(), sizeof p);
  for (const dsw_volume_id& v : answer.after.volumes) add(&v, sizeof v);
  return bits;
}

}  // namespace dsw::oracle
