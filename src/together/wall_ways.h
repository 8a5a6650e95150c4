#pragma once
// What of the environment bodies touch when all of their vertices move at once.

#include "flood/box_probe.h"
#include "together/sleeves.h"
#include "walk/packet.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class WallWays {
 public:
  explicit WallWays(const Environment<D>& env) : env_(env), lists_(env, false), probe_(env), sleeves_(env) {}

  /** Forgets what was found for another call. */
  void start(const Array<Traveller<D>>& travellers);
  /** Casts the paths of all vertices to their ends, and so finds the cells where they arrive. */
  void cast_paths(Array<Traveller<D>>& travellers);
  /** Whether no path is blocked, and nothing else touches the environment on its way. */
  bool is_free(const Array<Traveller<D>>& travellers);
  /** What is touched first. */
  void find_first(const Array<Traveller<D>>& travellers, FirstTouches<D>& first);

  void set_counters(CastCounters* counters) { counters_ = sleeves_.counters = counters; }
  SweepCounts counts;  // of edges and faces

 private:
  /** A feature near a part, and which of the part's planes it lies in. */
  struct Feature {
    WallFeature name;
    uint32_t first_plane, plane_end;  // in plane_numbers_
  };
  /** What was found near a part. */
  struct Near {
    uint32_t first_feature = kNone, feature_end = 0;  // kNone: nobody has looked
    uint32_t first_plane = 0, plane_end = 0;
  };
  struct Reach {
    double way, size;

    bool is_short() const { return way <= size; }
  };
  /** The triangle of a wall, in the plane its segment. */
  struct Plane {
    const double* corners[D];
  };
  /** A side of a wall's triangle, in the plane a corner; or a corner in space. */
  struct Side {
    uint32_t vertices[2];
    uint32_t plane, obstacle;
  };
  /** The path of a vertex that is blocked. */
  struct Blocked {
    uint32_t traveller, vertex;
    CastResult path;
  };
  template <class Visit>
  bool visit_parts(const Array<Traveller<D>>& travellers, Visit visit);
  template <class Visit>
  bool visit_part(const Traveller<D>& of, uint32_t number, const Simplex& part, Visit visit);
  bool is_settled(const Traveller<D>& of, const Simplex& part);
  Near& near_of(uint32_t number, const Simplex& part) {
    return (part.kind == Simplex::kEdge ? edges_ : faces_)[number][part.index];
  }
  /** Whether something is remembered of what is near a part. */
  static bool keeps_notes(const Traveller<D>& of, const Simplex& part) {
    return of.notes != nullptr && !is_covered(*of.body, part);
  }
  bool is_alone(const Traveller<D>& of, const Simplex& part);
  void find_near(const Traveller<D>& of, const Simplex& part, Near& near);
  static Reach reach_of(const Traveller<D>& of, const Part<D>& part);
  void collect(const Traveller<D>& of, const Part<D>& part, const Reach* kept, Near& near);
  void add_obstacles(const NearList<D>& list, const NearSelection<D>* selection, const Box<D>& box);
  void add_sides(const NearList<D>& list, const NearObstacle<D>& o, bool corners_alone);
  void add_features(bool corners_alone, Near& near);
  bool is_beside(const Plane& plane, const double* const* points, uint32_t count) const;
  bool keeps_sides(const Traveller<D>& of, const SimplexCorners<D>& corners, const Feature& feature) const;
  WayTouch<D> touch_of(const Traveller<D>& of, const Blocked& blocked) const;

  const Environment<D>& env_;
  NearLists<D> lists_;
  BoxProbe<D> probe_;
  Sleeves<D> sleeves_;
  Packet<D> packet_;
  CastCounters* counters_ = nullptr;
  Array<Blocked> blocked_{env_.memory};
  Array<Array<Near>> edges_{env_.memory}, faces_{env_.memory};  // by traveller and slot
  Array<Feature> features_{env_.memory};
  Array<Plane> planes_{env_.memory};
  Array<uint32_t> plane_numbers_{env_.memory};  // among the planes of a part
  Array<NearObstacle<D>> obstacles_{env_.memory};  // of the part that is looked at; vertices of the environment
  Array<Side> sides_{env_.memory};
  Array<uint8_t> is_beside_{env_.memory};  // by plane of the part: all of its way is on one side of it
};

}  // namespace dsw
