#pragma once
// What a body meets when one of its vertices moves: on the path of the vertex, with the simplices at it that the body's
// level covers, and of its partners.

#include "proximity/pair_sweep.h"
#include "proximity/thick_sweep.h"
#include "sweep/simplex_sweep.h"

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
  bool is_too_near = false;             // kContact of a thick body
  uint32_t edge = kNone, face = kNone;  // else kContact of these; both kNone: the path of the vertex
};

/** Sweeps stars; one for each thread. Throws std::bad_alloc. */
template <int D>
class StarSweep {
 public:
  explicit StarSweep(const Environment<D>& env) : simplices(env), thick(env), env_(env) {}

  /** Whether vertex v can go to `to` without meeting anything that the body's level sees, partners included; *cell then
   * contains `to`. */
  bool is_free(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
    return try_way(body, v, to, cell).end == SweepEnd::kFree;
  }
  /** Tries whether vertex v can go to `to`, and says what was found. It looks in the order path, edges, faces,
   * partners, distances; what it finds need not be what is met first. */
  StarTry try_way(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
    StarTry tried = try_walls(body, v, to, cell);
    if (tried.end == SweepEnd::kFree && !is_apart(body, v, to)) {
      tried.end = SweepEnd::kContact;
      tried.of_partner = true;
    }
    if (tried.end == SweepEnd::kFree && !keeps_distance(body, v, to)) {
      tried.end = SweepEnd::kContact;
      tried.is_too_near = true;
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
           (partners == nullptr || is_merge_apart(*partners, body, v, into)) && keeps_distance(body, v, to);
  }
  /** Whether it keeps all distances of a thick body on that way. */
  bool keeps_distance(const Body<D>& body, uint32_t v, const double* to) { return thick.keeps(partners, body, v, to); }
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
   * *cell is set. At the work limit neither. */
  SweepEnd find_first(const Body<D>& body, uint32_t v, const double* to, StarContact* first, Cell* cell);

  /** All contacts on that way of the vertex and its edges, by time, where find_first has found `first`; of faces only
   * that. */
  void find_all(const Body<D>& body, uint32_t v, const double* to, const StarContact& first, Array<StarContact>& all);

  SimplexSweep<D> simplices;
  ThickSweep<D> thick;
  const Partners<D>* partners = nullptr;  // other bodies that the body can meet; null: none
  NearEdges* near = nullptr;              // of the body, while it moves; null: its boxes are asked

 private:
  /** A vertex on its way. */
  struct Way {
    uint32_t v;
    const double* to;
    CastResult path;
    PathFacets crossed;
    bool reached;
  };
  Way go(const Body<D>& body, uint32_t v, const double* to);
  EdgeSweep edge_sweep(const Body<D>& body, const Way& way, uint32_t e) const;
  FaceSweep face_sweep(const Body<D>& body, const Way& way, uint32_t f) const;
  template <class Visit>
  bool visit_sweeps(const Body<D>& body, const Way& way, Visit visit) const;
  StarTry try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell);
  bool comes_first(const Body<D>& body, const Way& way, const StarContact& a, const StarContact& b) const;

  const Environment<D>& env_;
};

}  // namespace dsw
