// A blade crosses an edge or not: that is exact under the shift, with the blade as the body. What is left of the edge are
// pieces between the crossings, each with its own ends. A piece is free because it lies on an edge that was, but its ends
// are rounded. So each is verified, and recedes from the crossing until it is right: on its side of the blade, free, and
// reached without passing anything.

#include "scene/body_cuts.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"
#include "contact/describe.h"
#include "cutting/blade_tree.h"
#include "locate/locate.h"
#include "predicates/plane_hit.h"
#include "scene/distances.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "sweep/simplex_sweep.h"
#include "walk/retreat.h"

namespace dsw {
namespace {

/** Where a simplex of the blade crosses an edge. */
struct EdgeCrossing {
  double time;  // from the first end, rounded down
  uint32_t simplex;
};

/** An edge that the blade crosses. */
struct CrossedEdge {
  uint32_t edge;
  bool has_faces;  // before any edge is cut
};

/** An end of a piece: a vertex of the body, or a new place. */
template <int D>
struct PieceEnd {
  double at[D];
  Cell cell;
  uint32_t vertex = kNone;
};

template <int D>
struct EdgePiece {
  PieceEnd<D> ends[2];
  bool is_left = false;  // else there is no free place for it
  uint32_t edge = kNone;
};

template <int D>
class BodyCutter {
 public:
  BodyCutter(Scene<D>& scene, const Blade<D>& blade)
      : scene_(scene), env_(scene.env), blade_(blade), tree_(scene.memory, blade), sweeps_(scene.env) {}

  /** Edges that are crossed. */
  void find(const Body<D>& body, Array<CrossedEdge>& edges) const {
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      if (!body.has_edge(e)) continue;
      const BodyEdge& edge = body.edges[e];
      if (!crosses(body.position(edge.ends[0]), body.position(edge.ends[1]))) continue;
      edges.push_back({e, edge.faces[0] != kNone || edge.faces[1] != kNone});
    }
  }

  /** Cuts these edges, and appends the cuts to `cuts`. */
  void cut(BodyRecord<D>& of, dsw_body_id id, const Array<CrossedEdge>& edges, Array<dsw_body_cut>& cuts) {
    Body<D>& body = of.body;
    const size_t first = cuts.size();
    ends_.clear();
    for (const CrossedEdge& each : edges) cut_edge(body, id, each, cuts);
    part(body);
    for (size_t i = first; i < cuts.size(); ++i) forget_gone(body, cuts[i]);
    refresh_body(scene_, of);
  }

 private:
  template <class Visit>
  void for_each_crossing(const double* a, const double* b, Visit visit) const {
    typename BladeTree<D>::Box box;
    box.add(a);
    box.add(b);
    bool more = true;
    tree_.for_each_in(box, [&](uint32_t s) {
      if (!more) return;
      const BladeSimplex<D> simplex = blade_.simplex(s);
      const int at_a = simplex.side(a), at_b = simplex.side(b);
      if (at_a == 0 || at_b == 0 || at_a == at_b || !simplex.is_passed(a, b, at_b)) return;
      more = visit(s);
    });
  }
  bool crosses(const double* a, const double* b) const {
    bool any = false;
    for_each_crossing(a, b, [&](uint32_t) {
      any = true;
      return false;
    });
    return any;
  }

  /** The crossings of an edge, from its first end. */
  void find_crossings(const double* a, const double* b) {
    crossings_.clear();
    for_each_crossing(a, b, [&](uint32_t s) {
      const double* corners[D];
      blade_.corners(s, corners);
      // Seen from where the edge goes to, as a wall is seen that stops a flight.
      if (blade_.simplex(s).side(a) > 0) std::swap(corners[0], corners[1]);
      crossings_.push_back({crossing_time<D>(a, b, corners), s});
      return true;
    });
    dsw::sort(crossings_.begin(), crossings_.end(), [](const EdgeCrossing& x, const EdgeCrossing& y) {
      return x.time != y.time ? x.time < y.time : x.simplex < y.simplex;
    });
  }

  void cut_edge(Body<D>& body, dsw_body_id id, const CrossedEdge& crossed, Array<dsw_body_cut>& cuts) {
    const uint32_t e = crossed.edge;
    const BodyEdge edge = body.edges[e];
    const uint32_t a = edge.ends[0], b = edge.ends[1];
    find_crossings(body.position(a), body.position(b));
    pieces_.assign(crossings_.size() + 1, EdgePiece<D>());
    if (!crossed.has_faces) {
      Partners<D> partners(scene_.memory);
      if (scene_.features.contacts) find_partners(scene_, body, reach_of(body), partners);
      for (size_t i = 0; i < pieces_.size(); ++i)
        find_piece(body, e, i, scene_.features.contacts ? &partners : nullptr);
    }
    dsw_body_cut cut{};
    cut.body = id;
    cut.edge = edge_id(body, e);
    cut.ends[0] = vertex_id(body, a);
    cut.ends[1] = vertex_id(body, b);
    double from[D], to[D];
    std::copy_n(body.position(a), D, from);
    std::copy_n(body.position(b), D, to);
    reserve(body, 2 * crossings_.size(), pieces_.size(), 0);
    reserve_removals(body);
    reserve_more(cuts, crossings_.size());
    reserve_more(ends_, 2 * crossings_.size());
    remove_edge(body, e);
    for (EdgePiece<D>& piece : pieces_) put(body, piece);
    for (size_t i = 0; i < crossings_.size(); ++i) {
      cut.edge_parameter = crossings_[i].time;
      point_at<D>(from, to, cut.edge_parameter, cut.point);
      for (size_t k = 0; k < 2; ++k) {
        const EdgePiece<D>& piece = pieces_[i + k];
        cut.vertices[k] = piece.is_left ? vertex_id(body, piece.ends[1 - k].vertex) : dsw_body_vertex_id{};
        cut.parts[k] = piece.is_left ? edge_id(body, piece.edge) : dsw_body_edge_id{};
        // Where nothing is left up to an end of the edge, that end is the free one.
        const bool is_outer = k == 0 ? i == 0 : i + 1 == crossings_.size();
        if (piece.is_left) ends_.push_back(piece.ends[1 - k].vertex);
        if (!piece.is_left && is_outer) ends_.push_back(k == 0 ? a : b);
      }
      cuts.push_back(cut);
    }
  }

  /** Makes a piece a part of the body. */
  void put(Body<D>& body, EdgePiece<D>& piece) noexcept {
    if (!piece.is_left) return;
    for (PieceEnd<D>& end : piece.ends) {
      if (end.vertex == kNone) end.vertex = add_vertex(body, end.at, end.cell);
    }
    piece.edge = add_edge(body, piece.ends[0].vertex, piece.ends[1].vertex);
  }

  /** The largest piece between two crossings that is right, its ends at most 60 steps away from them. */
  void find_piece(const Body<D>& body, uint32_t e, size_t i, const Partners<D>* partners) {
    const uint32_t ends[2] = {body.edges[e].ends[0], body.edges[e].ends[1]};
    const double *const a = body.position(ends[0]), *const b = body.position(ends[1]);
    const bool is_first = i == 0, is_last = i == crossings_.size();
    const double low = is_first ? 0 : crossings_[i - 1].time, high = is_last ? 1 : crossings_[i].time;
    // Both sides of a thick thread that meets itself have to be apart.
    const double apart = body.keeps_lengths() ? body.radius / length(difference<D>(b, a)) : 0;
    double step = first_step<D>(a, b, 1);
    EdgePiece<D>& piece = pieces_[i];
    for (int tries = 0; tries < 60; ++tries, step *= 2) {
      const double from = is_first ? 0 : low + apart + step, to = is_last ? 1 : high - apart - step;
      if (!(from < to)) return;
      const double times[2] = {from, to};
      for (int k = 0; k < 2; ++k) {
        PieceEnd<D>& end = piece.ends[k];
        const bool is_old = k == 0 ? is_first : is_last;
        end.vertex = is_old ? ends[k] : kNone;
        end.cell = is_old ? body.vertices[ends[k]].cell : Cell{};
        if (is_old) {
          std::copy_n(body.position(ends[k]), D, end.at);
        } else {
          point_at<D>(a, b, times[k], end.at);
        }
      }
      piece.is_left = is_right(body, e, i, partners);
      if (piece.is_left) return;
    }
  }

  /** Whether a piece is on its own side of the crossings at its ends, crosses nothing of the blade, and is free; finds the
   * cells of its ends. */
  bool is_right(const Body<D>& body, uint32_t e, size_t i, const Partners<D>* partners) {
    const uint32_t ends[2] = {body.edges[e].ends[0], body.edges[e].ends[1]};
    PieceEnd<D>*const from = &pieces_[i].ends[0], *const to = &pieces_[i].ends[1];
    if (std::equal(from->at, from->at + D, to->at)) return false;
    const auto is_on_side_of = [&](size_t crossing, const PieceEnd<D>& end, uint32_t vertex) {
      const BladeSimplex<D> simplex = blade_.simplex(crossings_[crossing].simplex);
      return simplex.side(end.at) == simplex.side(body.position(vertex));
    };
    if (from->vertex == kNone && !is_on_side_of(i - 1, *from, ends[1])) return false;
    if (to->vertex == kNone && !is_on_side_of(i, *to, ends[0])) return false;
    if (crosses(from->at, to->at)) return false;
    if (!is_free(body, e, *from, *to)) return false;
    if (partners == nullptr) return true;
    const Corner corners[2] = {{from->at, from->vertex}, {to->at, to->vertex}};
    for (const Corner& corner : corners) {
      if (corner.vertex != kNone) continue;
      if (!is_bend_apart(*partners, body, e, corner.at)) return false;
      if (!is_segment_apart(*partners, body, corner, corner, e)) return false;
    }
    return !covers_edges(body.level) || is_segment_apart(*partners, body, corners[0], corners[1], e);
  }

  bool is_free(const Body<D>& body, uint32_t e, PieceEnd<D>& from, PieceEnd<D>& to) {
    const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
    if (!covers_edges(body.level)) {
      for (PieceEnd<D>* const end : {&from, &to}) {
        if (end->vertex != kNone) continue;
        end->cell = locate(env_, end->at, a.cell, nullptr).cell;
        if (!end->cell.valid() || is_closed(env_, end->cell)) return false;
      }
      return true;
    }
    const auto reach = [&](const double* start, Cell cell, PieceEnd<D>& end) {
      const CastResult way = cast(env_, start, end.at, cell);
      if (way.end != CastEnd::kReached || (end.vertex != kNone && way.cell != end.cell)) return false;
      end.cell = way.cell;
      return true;
    };
    if (from.vertex == kNone && !reach(a.position, a.cell, from)) return false;
    if (!reach(from.at, from.cell, to)) return false;
    if (!sweeps_edges(body.level)) return true;
    const auto sweeps = [&](const double* p, const double* q, const double* r, Cell cell) {
      return sweeps_.is_triangle_free({p, q, r}, cell);
    };
    if (from.vertex == kNone && !sweeps(a.position, from.at, b.position, a.cell)) return false;
    return to.vertex != kNone || sweeps(from.at, to.at, b.position, from.cell);
  }

  /** Takes away vertices at the cut until a body keeps its distances, from itself above all. */
  void part(Body<D>& body) {
    for (;;) {
      scene_.offending.clear();
      try {
        check_distances(scene_, body);
        return;
      } catch (const Error&) {
        if (!remove_offending_ends(body)) throw;
      }
    }
  }

  bool remove_offending_ends(Body<D>& body) noexcept {
    bool any = false;
    const size_t known = ends_.size();
    for (size_t i = 0; i < known; ++i) {
      const uint32_t v = ends_[i];
      const auto& offending = scene_.offending;
      if (v == kNone || !body.has_vertex(v) || dsw::find(offending.begin(), offending.end(), v) == offending.end())
        continue;
      ends_[i] = kNone;
      for_each_edge(body, v, [&](uint32_t e) {
        ends_[i] = body.edges[e].other(v);  // the next end, if the thread does not branch there
        return true;
      });
      remove_vertex(body, v);
      any = true;
    }
    return any;
  }

  void forget_gone(const Body<D>& body, dsw_body_cut& cut) const noexcept {
    for (int k = 0; k < 2; ++k) {
      if (!body.vertex_slots.alive(cut.vertices[k].index, cut.vertices[k].generation)) cut.vertices[k] = {};
      if (!body.edge_slots.alive(cut.parts[k].index, cut.parts[k].generation)) cut.parts[k] = {};
    }
  }

  Scene<D>& scene_;
  const Environment<D>& env_;
  const Blade<D>& blade_;
  BladeTree<D> tree_;
  SimplexSweep<D> sweeps_;
  Array<EdgeCrossing> crossings_{scene_.memory};
  Array<EdgePiece<D>> pieces_{scene_.memory};
  Array<uint32_t> ends_{scene_.memory};  // free ends at the cuts of a body
};

}  // namespace

template <int D>
void cut_bodies(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, const Blade<D>& blade) {
  BodyCutter<D> cutter(scene, blade);
  Array<dsw_body_cut> cuts(scene.memory);
  Array<uint32_t> changed(scene.memory);
  Array<CrossedEdge> edges(scene.memory);
  Array<Body<D>> before(scene.memory);
  try {
    for (size_t i = 0; i < count; ++i) {
      BodyRecord<D>& of = *bodies[i];
      edges.clear();
      cutter.find(of.body, edges);
      if (edges.empty()) continue;
      follow_changes(scene, of);
      changed.push_back(static_cast<uint32_t>(i));
      before.push_back(of.body);
      const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
      cutter.cut(of, {slot, scene.body_slots.generation(slot)}, edges, cuts);
    }
  } catch (...) {
    for (size_t k = before.size(); k-- != 0;) {
      BodyRecord<D>& of = *bodies[changed[k]];
      std::swap(of.body, before[k]);
      refresh_body(scene, of);
    }
    throw;
  }
  scene.body_cuts.swap(cuts);
}

DSW_INSTANTIATE(cut_bodies);

}  // namespace dsw
