#pragma once
// What is done about bodies of which edges are not free where the environment has gone, or rigid ones of which vertices
// lie beyond walls [JCD10] 5.1: rigid ones move as a whole, edges of others get new vertices. What comes of it is
// looked at where it is, not on its way.

#include "sweep/body_probe.h"
#include "walls/rigid_push.h"
#include "walls/settings.h"

namespace dsw {

template <int D>
class EndRepair {
 public:
  EndRepair(const Environment<D>& env, Occupants<D>& all);

  /** `start`: where the points of the environment were. */
  void begin(const double* start) noexcept { start_ = start; }

  /** Moves a rigid body so that it lies on this side of all walls, and is free; `struck` are its
   * vertices that lie beyond one, by index. False if none of a few motions does that: then it is
   * somewhere. O(size of the body and volumes met). Throws std::bad_alloc. */
  bool move(uint32_t owner, const Feature* struck, size_t count, WallRecord& record);

  /** Bends the edges of a body that are not free round what they meet, where both parts keep
   * `min_part`. Throws std::bad_alloc. */
  void bend(uint32_t owner, double min_part, WallRecord& record);

 private:
  /** A point of a body that has to move, and how far. */
  struct Way {
    double at[D];
    Vec normal, way;
    double along = 0;  // of an edge
    HalfFacet wall;
  };
  enum class Look { kFree, kStruck, kStuck };

  Look look(uint32_t owner, Way* way);
  void put(Body<D>& body, const RigidMotion<D>& moved) noexcept;
  bool find_way(const Body<D>& body, uint32_t edge, Way* way) const;
  void add_contact(uint32_t owner, uint32_t edge, const Way& way, dsw_wall_response done, WallRecord& record) const;

  const Environment<D>& env_;
  Occupants<D>& all_;
  BodyProbe<D> probe_;
  const double* start_ = nullptr;
  // By vertex of the body at hand: a point that is known to be on the right side of all walls.
  Array<double> starts_{env_.memory};
  Array<Cell> cells_{env_.memory};
  Array<double> places_{env_.memory};
  uint32_t edge_ = kNone;  // that the last look has found
};

}  // namespace dsw
