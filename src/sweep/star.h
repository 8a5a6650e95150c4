#pragma once
// What a body sweeps when one of its vertices moves: the path of the vertex, at EDGES its edges in their new places, at
// EDGES_SWEPT the triangles that they sweep, at FACES also the tetrahedra that its faces sweep [JCD10] 4.1.

#include "body/body.h"
#include "flood/box_probe.h"
#include "flood/sweep.h"
#include "pairs/pair_sweep.h"
#include "sweep/known_edge.h"
#include "sweep/touched_line.h"
#include "walk/packet.h"

namespace dsw {

/** What a vertex's star meets. */
struct StarContact {
  SweepContact contact;
  uint32_t edge = kNone, face = kNone;  // what touches; both kNone: the vertex itself
};

/** What stands in a way that was tried: what touches, or a partner. */
struct StarTry {
  SweepEnd end = SweepEnd::kFree;
  bool of_partner = false;              // kContact with another body, or of the body with itself
  uint32_t edge = kNone, face = kNone;  // else kContact of these; both kNone: the path of the vertex
};

/** How many sweeps of edges were asked for, and how many of those were left out. */
struct SweepCounts {
  uint32_t swept = 0, skipped = 0;
};

/** Sweeps stars; one for each thread. Throws std::bad_alloc. */
template <int D>
class StarSweep {
 public:
  explicit StarSweep(const Environment<D>& env);

  /** Whether vertex v can go to `to` without meeting anything that the body's level sees, partners included; *cell then
   * contains `to`. */
  bool is_free(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
    return try_way(body, v, to, cell).end == SweepEnd::kFree;
  }
  /** The same; says what was found first in the order path, edges, faces, partners, which need not be met first. */
  StarTry try_way(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
    StarTry tried = try_walls(body, v, to, cell);
    if (tried.end == SweepEnd::kFree && !is_apart(body, v, to)) {
      tried.end = SweepEnd::kContact;
      tried.of_partner = true;
    }
    return tried;
  }
  /** Where the path, or the edge in its new place, runs into a wall on a way that was tried and not free. False: it
   * does not, as what is met lies inside of what is swept: `inside` is then the first contact of that. */
  bool find_obstacle(const Body<D>& body, uint32_t v, const double* to, const StarTry& tried, CastResult* hit,
                     StarContact* inside);
  /** Whether it can go to another vertex of the body and become one with that. The two are joined by an edge. */
  bool can_merge(const Body<D>& body, uint32_t v, uint32_t into, Cell* cell) {
    const double* const to = body.position(into);
    return try_walls(body, v, to, cell).end == SweepEnd::kFree &&
           (partners == nullptr || is_merge_apart(*partners, body, v, into));
  }
  /** Whether it touches no partner on that way. */
  bool is_apart(const Body<D>& body, uint32_t v, const double* to) const {
    return partners == nullptr || is_way_apart(*partners, body, v, to, near);
  }
  /** What of its partners it touches first. */
  bool find_first_of_partners(const Body<D>& body, uint32_t v, const double* to, PairContact<D>* first) const {
    *first = PairContact<D>();
    return partners != nullptr && find_first_pair(*partners, body, v, to, first, near);
  }

  /** The first contact with the environment on that way, whose event borrows the body's points and `to`. Without one
   * *cell is set. At the work limit neither.
   * @param stays whether the path is known to stay in its cell. */
  SweepEnd find_first(const Body<D>& body, uint32_t v, const double* to, StarContact* first, Cell* cell,
                      bool stays = false);

  /** All contacts on that way of the vertex and its edges, by time, where find_first has found `first`; of faces only
   * that. */
  void find_all(const Body<D>& body, uint32_t v, const double* to, const StarContact& first, Array<StarContact>& all);

  /** What is known of the sweep of an edge; counts what is settled.
   * @param ask_balls whether the balls of its ends have not been asked.
   * @param ridge null, or what is met first if it is not settled; see follow_to_ridge. */
  Settled settle(const Body<D>& body, const EdgeSweep& sweep, bool ask_balls = true, FirstRidge* ridge = nullptr) {
    ++counts.swept;
    const Skipping& skipping = body.skipping;
    const bool keeps = body.keeps_sequences();
    const Cell from = body.vertices[sweep.v].cell;
    if ((skipping.by_environment || keeps) && from == sweep.arrival && from == sweep.fixed) {
      const bool convex = env_.map.convex(from);
      if (convex || is_seen(env_, body.level, sweep, counters)) {
        if (keeps) body.sequences[sweep.e].clear();
        counts.skipped += skipping.by_environment ? 1 : 0;
        return convex ? Settled::kInside : Settled::kSeen;
      }
    }
    ask_balls = ask_balls && skipping.by_clearance;
    return ask_balls || keeps ? settle_by_what_is_kept(body, sweep, ask_balls, ridge) : Settled::kNo;
  }
  /** The same for an edge that is known to lie, with what it sweeps, in a free box. */
  Settled settle_boxed(const Body<D>& body) {
    ++counts.swept;
    counts.skipped += body.skipping.by_clearance || body.skipping.sequences ? 1 : 0;
    return Settled::kBoxed;
  }
  bool settles(const Body<D>& body, const EdgeSweep& sweep) { return settle(body, sweep) != Settled::kNo; }

  /** Whether what a face sweeps lies inside of one cell and meets nothing. The cells contain p, to, q and r of `m`. */
  bool stays_inside(const FaceMotion& m, Cell from, Cell arrival, Cell q, Cell r) const {
    return from == arrival && from == q && from == r && (env_.map.convex(from) || is_face_seen(m, from));
  }

  /** Whether a box is seen to be free from all of these cells: then nothing that is swept inside of it from one of them
   * meets anything. Not asked with a work limit, which is that of the cells that a sweep itself meets. */
  template <class... Cells>
  bool is_boxed(const Bounds<D>& box, Cell start, Cells... others) noexcept {
    return max_volumes == 0 && probe_.is_free(box, start) && (probe_.has_entered(others) && ...);
  }

  /** Whether what stopped an edge before stands in its way: then its sweep is most likely not free. */
  bool meets_touched_line(const Body<D>& body, const EdgeSweep& sweep) const noexcept {
    return max_volumes == 0 && pierces_touched_line(env_, body, sweep);
  }
  bool is_triangle_free(const EdgeMotion& m, Cell start) {
    if (is_boxed(bounds<D>(m.p, m.to, m.q), start)) return true;
    return flood_until(m, start, 1).end == SweepEnd::kFree;
  }
  bool is_tetrahedron_free(const FaceMotion& m, Cell start) {
    if (is_boxed(bounds<D>(m.p, m.to, m.q, m.r), start)) return true;
    if constexpr (D == 3) return flood(m, start).end == SweepEnd::kFree;
    return true;  // no body of the plane has faces
  }

  SweepCounts counts;
  CastCounters* counters = nullptr;       // of casts, and cells of floods; may stay null
  uint32_t max_volumes = 0;               // work limit of each cast and flood; 0: none
  const Partners<D>* partners = nullptr;  // other bodies that the body can meet; null: none
  NearEdges* near = nullptr;              // of the body, while it moves; null: its boxes are asked

 private:
  /** The first of the contacts on one way. */
  struct Earliest {
    StarContact* contact;
    bool any = false;
  };
  void consider(const double* p, const double* to, StarContact found, Earliest& earliest) const;
  template <class Motion, class... Collect>
  SweepResult flood(const Motion& m, Cell start, Collect... collect) {
    return count(flood_.sweep(m, start, max_volumes, collect...));
  }
  /** For an edge: what is met after `end` is not needed. With a work limit, which is that of all cells, it may be
   * found. */
  SweepResult flood_until(const EdgeMotion& m, Cell start, double end) {
    if constexpr (D == 3) {
      if (max_volumes == 0) return count(flood_.sweep_until(m, start, end));
    }
    return flood(m, start);
  }
  SweepResult count(const SweepResult& swept) {
    if (counters != nullptr) counters->volumes_visited += swept.volumes_visited;
    limited_ = limited_ || swept.end == SweepEnd::kWorkLimit;
    return swept;
  }
  bool is_face_seen(const FaceMotion& m, Cell cell) const;
  Settled settle_by_what_is_kept(const Body<D>& body, const EdgeSweep& sweep, bool ask_balls, FirstRidge* ridge);
  CastResult cast_path(const Body<D>& body, uint32_t v, const double* to, bool stays = false);
  StarTry try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell);
  uint32_t find_swept_edge(const Body<D>& body, uint32_t v, const double* to, const CastResult& path);
  uint32_t find_swept_face(const Body<D>& body, uint32_t v, const double* to, const CastResult& path);
  bool find_hit_edges(const Body<D>& body, uint32_t v, const double* to, Cell cell, bool one_is_enough);
  void consider_edge(const Body<D>& body, const EdgeSweep& sweep, Earliest& earliest);
  bool stays_free(const Body<D>& body, const EdgeSweep& sweep, FirstRidge* ridge);
  bool consider_ridge(const Body<D>& body, const EdgeSweep& sweep, const FirstRidge& ridge, Earliest& earliest);
  void consider_face(const Body<D>& body, uint32_t v, const double* to, uint32_t f, Earliest& earliest);
  void collect_edge(const Body<D>& body, uint32_t v, const double* to, uint32_t e, const StarContact& first,
                    Array<StarContact>& all);

  const Environment<D>& env_;
  bool limited_ = false;  // the work limit was met
  BoxProbe<D> probe_;
  SweepFlood<D> flood_;
  EdgeScratch<D> scratch_{env_.memory};
  Packet<D> packet_;
  uint32_t packet_edges_[kPacket] = {};
  Array<uint32_t> hit_edges_{env_.memory};  // at EDGES: those whose new place is not free
};

}  // namespace dsw
