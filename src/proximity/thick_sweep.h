#pragma once
// Distances that a thick body keeps: from everything impassable its radius, from other bodies and from itself both
// radii. What a vertex sweeps with its edges and faces must keep them on all of its way.

#include <cmath>

#include "base/function_ref.h"
#include "predicates/hull_gap.h"
#include "proximity/joined.h"
#include "proximity/near_lists.h"
#include "proximity/partners.h"

namespace dsw {

/** A length less a share of itself, 2^-34 or 2^-35. Denormal numbers have no part of their last digit to lose. */
inline double less_share(double length, double share) noexcept {
  constexpr double kUnit = 0x1p-1000;  // in which denormal numbers are normal
  const double shorter = length * (1 - share);
  return shorter / kUnit < length / kUnit * (1 - share) ? std::nextafter(shorter, length) : shorter;
}
/** The distance that counts as kept, if so much is wanted: by what stands still, and by what moves. A way that leads
 * along something may lose a little more by rounding than the place where it began. So what has moved is well kept. */
inline double least_at_rest(double wanted) noexcept { return less_share(wanted, 0x1p-34); }
inline double least_kept(double wanted) noexcept { return less_share(wanted, 0x1p-35); }

/** What comes too near to a part of a body, and when: something of the environment, with its vertices, or a part of a body. */
template <int D>
struct TooNear : WallFeature {
  double time = 0;               // of the way of the moving vertex; rounded
  Simplex part{};                // of the body, the moving vertex with others
  double shares[3] = {1, 0, 0};  // where on the part: weights of the moving vertex, and of the others as in the hull
  Vec normal;                    // unit, from the obstacle to the part
  uint32_t partner = kNone;      // its number; kNone: the environment
  Simplex other{};               // its part
  double weights[3] = {};        // of the other's corners in its nearest point

  TooNear() noexcept : WallFeature{{kNone, kNone, kNone}, 0, {}, {}} {}
};

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class ThickSweep {
 public:
  explicit ThickSweep(const Environment<D>& env) : env_(env), lists_(env, false), joined_(env.memory) {}

  /** What is remembered of the things near the body that is asked about. Null: nothing is remembered. */
  NearNotes<D>* notes = nullptr;
  /** How much more than its radius a thick body keeps, and any body from a thick one, but not from itself. */
  double bend = 0;

  /** Whether a body has distances to keep from anything. `partners` may be null, here and below. */
  static bool is_thick(const Partners<D>* partners, const Body<D>& body) noexcept {
    return body.radius > 0 || (partners != nullptr && partners->has_thick);
  }
  /** Whether a vertex can go to `to` with all that its level covers. */
  bool keeps(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to);
  /** What comes too near first on that way; whether anything does. */
  bool find_first(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to, TooNear<D>* first);
  /** All that come too near on that way, by time. */
  void find_all(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to, Array<TooNear<D>>& all);
  /** Whether a body that keeps its shape keeps all distances but those from itself while it goes to `targets`, one for each
   * vertex slot: its points straight, or as `bend` says beside that. Each part stays in the hull of its places.
   * @param near what is nearest then, of what is too near; may be null. */
  bool keeps_motion(const Partners<D>* partners, const Body<D>& body, PointArray targets, TooNear<D>* near);
  /** Whether two bodies that keep their shapes keep a distance while both go, each as above; whatever `bend` is.
   * @param near what of them is nearest then, of what is too near; may be null. Its partner is not named. */
  bool keeps_apart(const Body<D>& a, PointArray to_a, const Body<D>& b, PointArray to_b, double distance,
                   TooNear<D>* near) const;
  /** Whether an edge, with its faces, can be bent to pass through `point`, which a cell contains. */
  bool keeps_bend(const Partners<D>* partners, const Body<D>& body, uint32_t edge, const double* point, Cell cell);
  /** Whether a part that stands still keeps its distances. */
  bool keeps_at_rest(const Partners<D>* partners, const Body<D>& body, const Simplex& part);
  /** Whether all parts do. */
  bool keep_at_rest(const Partners<D>* partners, const Body<D>& body);
  /** Tells whether a part that the body does not have yet would keep its distances; `start` contains a point of the
   * part. `from`: what is joined to the part, and how far along the body. */
  bool keeps_at_rest(const Partners<D>* partners, const Body<D>& body, const ConvexHull& part, Cell start,
                     const WayAlong* from, uint32_t from_count);
  /** Appends the walls that are too near to a part at rest, as facets that are seen from passable cells. */
  void find_walls(const Body<D>& body, const Simplex& part, Array<HalfFacet>& walls);
  /** A lower bound of the least gap of a part: distance less radii. At most `limit`. */
  double least_gap(const Partners<D>* partners, const Body<D>& body, const Simplex& part, double limit);

 private:
  /** A part of a body, and what it sweeps. */
  struct Swept {
    ConvexHull hull;
    Simplex part{};
    Cell start;      // that contains a point of the hull
    double way = 0;  // all of the hull is within this distance of the part. Infinity: the part is not there
    bool is_at_rest = true;
    WayAlong from[4];
    uint32_t from_count = 0;
    bool is_rigid = false;  // its body keeps its shape
  };
  /** Something that stands still. */
  struct Thing {
    ConvexHull hull;
    double wanted;  // distance
    uint32_t partner;
    Simplex other;
    const WallFeature* obstacle;  // of the list
    const NearList<D>* list;
  };
  using VisitThing = FunctionRef<bool(const Thing&)>;

  Swept sweep_of(const Body<D>& body, const Simplex& part, uint32_t v, const double* to) const noexcept;
  static double least_of(const Swept& swept, double wanted) noexcept;
  template <class Visit>
  bool for_each_swept(const Body<D>& body, uint32_t v, const double* to, Visit visit) const;
  /** Calls visit(thing) for all that may be nearer than wanted and a limit more, until it returns false; whether it
   * never did. What is joined to the part is left out. */
  bool visit_near(const Partners<D>* partners, const Body<D>& body, const Swept& swept, double limit, VisitThing visit);
  bool visit_walls(const Body<D>& body, const Swept& swept, double wanted, double limit, VisitThing visit);
  bool visit_partner(const Partners<D>& partners, uint32_t number, const Body<D>& body, const Box<D>& box,
                     double wanted, VisitThing visit) const;
  bool keeps_swept(const Partners<D>* partners, const Body<D>& body, const Swept& swept);
  static void name_thing(const Swept& swept, const HullGap& gap, const Thing& thing, TooNear<D>* found);
  static bool keeps_until(ConvexHull start, const double* to, double time, const Thing& thing) noexcept;
  /** Calls visit(found). `first`, which may be null: what comes surely later is left out. */
  template <class Visit>
  void visit_too_near(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to,
                      const TooNear<D>* first, Visit visit);

  const Environment<D>& env_;
  NearLists<D> lists_;
  Joined<D> joined_;
};

}  // namespace dsw
