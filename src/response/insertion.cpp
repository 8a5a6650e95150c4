#include "response/insertion.h"

#include "base/dimensions.h"
#include "contact/describe.h"
#include "locate/locate.h"

namespace dsw {
namespace {

template <int D>
bool is_reached(const Environment<D>& env, const double* from, Cell start, const BodyVertex<D>& to) noexcept {
  const CastResult way = cast(env, from, to.position, start);
  return way.end == CastEnd::kReached && way.cell == to.cell;
}

}  // namespace

template <int D>
bool can_bend(const Environment<D>& env, StarSweep<D>& star, const Body<D>& body, uint32_t edge, const double* point,
              Cell* cell) {
  const BodyEdge& e = body.edges[edge];
  const BodyVertex<D>&p = body.vertices[e.ends[0]], &q = body.vertices[e.ends[1]];
  if (star.partners != nullptr && !is_bend_apart(*star.partners, body, edge, point)) return false;
  const auto keeps_distance = [&] { return star.thick.keeps_bend(star.partners, body, edge, point, *cell); };
  if (!covers_edges(body.level)) {
    *cell = locate(env, point, p.cell, nullptr).cell;
    return cell->valid() && !is_closed(env, *cell) && keeps_distance();
  }
  const CastResult to_point = cast(env, p.position, point, p.cell);
  *cell = to_point.cell;
  if (to_point.end != CastEnd::kReached || !is_reached(env, point, *cell, q)) return false;
  const bool swept = sweeps_edges(body.level);
  if (swept && !star.simplices.is_triangle_free({p.position, point, q.position}, p.cell)) return false;
  for (const uint32_t f : e.faces) {
    if (f == kNone) continue;
    const BodyFace& face = body.faces[f];
    const uint32_t far = face.after(e.ends[0]) == e.ends[1] ? face.before(e.ends[0]) : face.after(e.ends[0]);
    const double* const r = body.position(far);
    if (!is_reached(env, point, *cell, body.vertices[far])) return false;
    if (!covers_faces(body.level)) continue;
    if (!star.simplices.is_triangle_free({p.position, point, r}, p.cell) ||
        !star.simplices.is_tetrahedron_free({p.position, point, q.position, r}, p.cell)) {
      return false;
    }
  }
  return keeps_distance();
}

template <int D>
uint32_t insert_vertex(Body<D>& body, uint32_t edge, const double* point, Cell cell, double share,
                       dsw_body_edit* edit) {
  reserve(body, 1, 3, 2);
  const BodyEdge before = body.edges[edge];
  const uint32_t middle = add_vertex(body, point, cell);
  const uint32_t rest = split_edge(body, edge, middle);
  if (edit != nullptr) {
    *edit = {};
    edit->vertex = vertex_id(body, middle);
    edit->ends[0] = vertex_id(body, before.ends[0]);
    edit->ends[1] = vertex_id(body, before.ends[1]);
    edit->edge = edge_id(body, edge);
    edit->rest = edge_id(body, rest);
    edit->edge_parameter = share;
    edit->inserted = 1;
  }
  return middle;
}

template <int D>
bool merge_vertex(StarSweep<D>& star, Body<D>& body, uint32_t edge, uint32_t vertex, dsw_body_edit* edit) {
  const uint32_t kept = body.edges[edge].other(vertex);
  Cell cell;
  if (!can_collapse(body, edge, vertex) || !star.can_merge(body, vertex, kept, &cell)) return false;
  reserve_removals(body);
  if (edit != nullptr) {
    *edit = {};
    edit->vertex = vertex_id(body, vertex);
    edit->ends[0] = vertex_id(body, kept);
    edit->edge = edge_id(body, edge);
  }
  collapse_edge(body, edge, vertex);
  return true;
}

DSW_INSTANTIATE(can_bend);
DSW_INSTANTIATE(insert_vertex);
DSW_INSTANTIATE(merge_vertex);

}  // namespace dsw
