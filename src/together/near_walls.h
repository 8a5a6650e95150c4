#pragma once
// What of the environment is near the ways of parts of bodies: found once in a call.

#include "together/trajectory.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class NearWalls {
 public:
  explicit NearWalls(const Environment<D>& env) : env_(env), lists_(env, false) {}

  /** Forgets what was found for another call. */
  void start(const Array<Trajectory<D>>& trajectories);
  /** Whether it is known that nothing is near the way of an edge or a face. */
  bool is_alone(const Trajectory<D>& of, const Simplex& part);
  /** What an edge or a face of trajectory `number` can touch in the call. The view holds until the next search. */
  CandidateView<D> find(const Trajectory<D>& of, uint32_t number, const Simplex& part);

 private:
  /** What is near a part. Numbers of planes count from first_plane. */
  struct Range {
    uint32_t first_feature = kNone, feature_end = 0;  // kNone: nobody has looked
    uint32_t first_plane = 0, plane_end = 0;
  };
  struct Reach {
    double way, size;

    bool is_short() const { return way <= size; }
  };
  /** A side of a wall's triangle, in the plane a corner; or a corner in space. */
  struct Side {
    uint32_t vertices[2];
    uint32_t plane, obstacle;
  };
  bool keeps_notes(const Trajectory<D>& of, const Simplex& part) const;
  static Reach reach_of(const Trajectory<D>& of, const Part<D>& part);
  void collect(const Trajectory<D>& of, const Part<D>& part, const Reach* kept, Range& near);
  void add_obstacles(const NearList<D>& list, const NearSelection<D>* selection, const Box<D>& box);
  void add_features(bool corners_alone, Range& near);

  const Environment<D>& env_;
  NearLists<D> lists_;
  Array<Array<Range>> edges_{env_.memory}, faces_{env_.memory};  // by trajectory and slot
  Array<Candidate> features_{env_.memory};
  Array<WallPlane<D>> planes_{env_.memory};
  Array<uint32_t> plane_numbers_{env_.memory};
  Array<WallFeature> obstacles_{env_.memory};  // of the part that is looked at; vertices of the environment
  Array<Side> sides_{env_.memory};
};

}  // namespace dsw
