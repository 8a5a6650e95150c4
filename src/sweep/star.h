#pragma once
// What a body meets when one of its vertices moves: on the path of the vertex, with the simplices at it that the body's
// level covers, and of its partners.

#include "proximity/pair_sweep.h"
#include "proximity/thick_sweep.h"
#include "sweep/simplex_sweep.h"

namespace dsw {

/** How a way that was tried ends. kPartner: at another body, or at the body itself. kTooNear: a thick body does not keep its
 * distance. */
enum class WayEnd : uint32_t { kFree, kContact, kPartner, kTooNear, kWorkLimit };

/** Sweeps stars; one for each thread. Throws std::bad_alloc. */
template <int D>
class StarSweep {
 public:
  explicit StarSweep(const Environment<D>& env) : simplices(env), thick(env), env_(env) {}

  /** Whether vertex v can go to `to` without meeting anything that the body's level sees, partners included; *cell then
   * contains `to`. */
  bool is_free(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
    Simplex part;
    return try_way(body, v, to, cell, &part) == WayEnd::kFree;
  }
  /** Tries whether vertex v can go to `to`, and says what was found. It looks in the order path, edges, faces,
   * partners, distances; what it finds need not be what is met first.
   * @param part of kContact, what touches; a vertex: its path. */
  WayEnd try_way(const Body<D>& body, uint32_t v, const double* to, Cell* cell, Simplex* part) {
    const WayEnd end = try_walls(body, v, to, cell, part);
    if (end != WayEnd::kFree) return end;
    if (!is_apart(body, v, to)) return WayEnd::kPartner;
    return keeps_distance(body, v, to) ? WayEnd::kFree : WayEnd::kTooNear;
  }
  /** Where the path, or the edge in its new place, runs into a wall on a way that was tried, where `part` touches. False: it
   * does not, as what is met lies inside of what is swept: `inside` is then the first contact of that. */
  bool find_obstacle(const Body<D>& body, uint32_t v, const double* to, const Simplex& part, CastResult* hit,
                     SweepContact* inside);
  /** Whether it can go to another vertex of the body and become one with that. The two are joined by an edge. */
  bool can_merge(const Body<D>& body, uint32_t v, uint32_t into, Cell* cell) {
    const double* const to = body.position(into);
    Simplex part;
    return try_walls(body, v, to, cell, &part) == WayEnd::kFree &&
           (partners == nullptr || is_merge_apart(*partners, body, v, into)) && keeps_distance(body, v, to);
  }
  /** Whether it keeps all distances of a thick body on that way. */
  bool keeps_distance(const Body<D>& body, uint32_t v, const double* to) {
    return !thick.is_thick(partners, body) || thick.keeps(partners, body, v, to);
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
   * *cell is set. At the work limit neither. */
  SweepEnd find_first(const Body<D>& body, uint32_t v, const double* to, SweepContact* first, Cell* cell);

  /** All contacts on that way of the vertex and its edges, by time, where find_first has found `first`; of faces only
   * that. */
  void find_all(const Body<D>& body, uint32_t v, const double* to, const SweepContact& first, Array<SweepContact>& all);

  SimplexSweep<D> simplices;
  ThickSweep<D> thick;
  const Partners<D>* partners = nullptr;  // other bodies that the body can meet; null: none
  NearEdges* near = nullptr;              // of the body, while it moves; null: its boxes are asked

 private:
  MovingPart go(const Body<D>& body, uint32_t v, const double* to, CastResult* path);
  MovingPart sweep_of(const Body<D>& body, const MovingPart& vertex, const Simplex& part) const;
  WayEnd try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell, Simplex* part);
  bool comes_first(const PointWay& way, const SweepContact& a, const SweepContact& b) const;

  const Environment<D>& env_;
};

}  // namespace dsw
