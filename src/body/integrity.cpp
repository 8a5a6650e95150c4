#include "body/integrity.h"

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"

#include <algorithm>
#include <utility>

namespace dsw {
namespace {

/** Edges by their two ends, sorted. */
using EdgesByEnds = Array<std::pair<uint64_t, uint32_t>>;

uint64_t key_of(uint32_t a, uint32_t b) { return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a; }

/** The edge between two vertices, or kNone. */
uint32_t edge_between(const EdgesByEnds& edges, uint32_t a, uint32_t b) {
  const uint64_t key = key_of(a, b);
  const auto at = std::lower_bound(edges.begin(), edges.end(), std::make_pair(key, uint32_t{0}));
  return at != edges.end() && at->first == key ? at->second : kNone;
}

template <class Has>
bool slots_fit(const SlotPool& slots, size_t count, Has has) {
  if (slots.slot_count() != count) return false;
  for (uint32_t i = 0; i < count; ++i) {
    if (slots.alive(i, slots.generation(i)) != has(i)) return false;
  }
  return true;
}

template <int D>
const char* check_edges(const Body<D>& body, EdgesByEnds& by_ends) {
  for (uint32_t e = 0; e < body.edges.size(); ++e) {
    if (!body.has_edge(e)) continue;
    const BodyEdge& edge = body.edges[e];
    if (!body.has_vertex(edge.ends[0]) || !body.has_vertex(edge.ends[1]) || edge.ends[0] == edge.ends[1]) {
      return "an edge without two ends";
    }
    for (const uint32_t f : edge.faces) {
      if (f != kNone && !body.has_face(f)) return "an edge of a face that is gone";
    }
    by_ends.emplace_back(key_of(edge.ends[0], edge.ends[1]), e);
  }
  dsw::sort(by_ends.begin(), by_ends.end());
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  return std::adjacent_find(by_ends.begin(), by_ends.end(), same) == by_ends.end() ? nullptr : "two edges are the same";
}

/** Whether each edge is in the lists of its two ends. Edges are sound. */
template <int D>
bool lists_whole(const Body<D>& body, size_t edges) {
  size_t rest = 2 * edges;  // a list that runs in a circle has too many
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    for (uint32_t e = body.vertices[v].first_edge; e != kNone;) {
      if (!body.has_edge(e) || rest-- == 0) return false;
      const BodyEdge& edge = body.edges[e];
      if (edge.ends[0] != v && edge.ends[1] != v) return false;
      e = edge.next[edge.side_of(v)];
    }
  }
  return rest == 0;
}

/** Edges are sound. */
template <int D>
const char* check_faces(const Body<D>& body, const EdgesByEnds& by_ends) {
  size_t sides = 0;
  for (uint32_t f = 0; f < body.faces.size(); ++f) {
    if (!body.has_face(f)) continue;
    const uint32_t* const corners = body.faces[f].corners;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t from = corners[k], to = corners[(k + 1) % 3];
      const uint32_t e = from == to || !body.has_vertex(from) ? kNone : edge_between(by_ends, from, to);
      if (e == kNone) return "a side of a face is no edge";
      const uint32_t* const faces = body.edges[e].faces;
      if ((faces[0] == f) == (faces[1] == f)) return "an edge does not know its face";
      const uint32_t other = faces[faces[0] == f ? 1 : 0];
      if (other != kNone) {
        const uint32_t* const c = body.faces[other].corners;
        if (std::count(c, c + 3, from) != 1 || std::count(c, c + 3, to) != 1 || body.faces[other].after(to) != from) {
          return "two faces at an edge are turned against each other";
        }
        if (body.faces[other].before(to) == corners[(k + 2) % 3]) return "two faces are the same";
      }
      ++sides;
    }
  }
  for (const auto& [key, e] : by_ends) {
    for (const uint32_t f : body.edges[e].faces) sides -= f != kNone ? 1 : 0;
  }
  return sides == 0 ? nullptr : "a face does not know its edge";
}

}  // namespace

template <int D>
const char* check_integrity(const Body<D>& body) {
  const bool fit = slots_fit(body.vertex_slots, body.vertices.size(), [&](uint32_t v) { return body.has_vertex(v); }) &&
                   slots_fit(body.edge_slots, body.edges.size(), [&](uint32_t e) { return body.has_edge(e); }) &&
                   slots_fit(body.face_slots, body.faces.size(), [&](uint32_t f) { return body.has_face(f); });
  if (!fit) return "a slot is alive and empty, or the other way round";
  if (D == 2 && !body.faces.empty()) return "faces in the plane";
  EdgesByEnds by_ends(body.edges.get_allocator());
  by_ends.reserve(body.edge_slots.alive_count());
  if (const char* const broken = check_edges(body, by_ends)) return broken;
  if (!lists_whole(body, by_ends.size())) return "an edge is in no list of a vertex";
  if (const char* const broken = check_faces(body, by_ends)) return broken;
  const auto lives = [&](uint32_t v) { return body.has_vertex(v); };
  return dsw::all_of(body.inserted.begin(), body.inserted.end(), lives) ? nullptr : "an inserted vertex is gone";
}

DSW_INSTANTIATE(check_integrity);

}  // namespace dsw
