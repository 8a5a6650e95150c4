#pragma once
// Vertices of a body that lie behind walls are brought to the side on which most of the body is.

#include "base/vec.h"
#include "body/body.h"
#include "walk/cast.h"

namespace dsw {

constexpr double kPenetrationMargin = 0x1p-5;  // how far things are pushed beyond what is needed, as a share of it

/** The unit normal of the wall that a cast has hit, against its way.
 * @param corner a corner of the wall. */
template <int D>
Vec normal_of(const Environment<D>& env, const CastResult& hit, const Vec& way, const double** corner);

template <int D>
class RightSide {
 public:
  /** @param inside by vertex: whether it lies in a passable cell; see find_cells. */
  RightSide(const Environment<D>& env, Body<D>& body, Array<bool>& inside)
      : env_(env), body_(body), inside_(inside), kept_(env.memory), queue_(env.memory) {}

  /** Decides which vertices are on the right side of all walls. The others are not inside.
   * @param side a cell there; invalid: of each connected part of the body, the most vertices that free edges join.
   * @param smallest how far places stay off walls. */
  void choose(Cell side, double smallest);
  /** Brings all vertices to the right side, each by a free way from a neighbour. False: there is none. */
  bool place_all();
  /** Moves a vertex along a free way, which ends before walls. */
  void shift(uint32_t v, const Vec& by);

  /** Whether a vertex was on the right side from the beginning. */
  bool is_kept(uint32_t v) const { return kept_[v]; }
  /** Whether each connected part of the body has a vertex that was. */
  bool all_have_kept() const { return all_have_kept_; }

 private:
  struct Place {
    double position[D];
    Cell cell;
  };

  void keep_to_side();
  void keep_largest_parts();
  void place(uint32_t v, const double* from, Cell start);
  void place_first(uint32_t v);
  void grow();
  Place lead(const double* from, Cell start, Vec target) const;
  bool get_before(const double* from, Cell start, const Vec& target, const CastResult& hit, Place& place) const;

  const Environment<D>& env_;
  Body<D>& body_;
  Array<bool>& inside_;
  double smallest_ = 0;
  Cell side_;
  bool all_have_kept_ = false;
  Array<bool> kept_;
  Array<uint32_t> queue_;  // vertices whose neighbours are to be placed
};

}  // namespace dsw
