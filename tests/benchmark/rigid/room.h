// A small room of tetrahedra, or of triangles in the plane, with walls in it; bodies in it; and a motion.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_ROOM_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_ROOM_H

#include "bodies.h"
#include "scenes/random.h"

namespace dsw::rigid {

using scenes::Random;

/** 3 cells along each axis, each cut into tetrahedra. Points inside are shifted at random, so no wall inside lies along
 * axes. */
class Room {
 public:
  /** Marks a share of the inner faces. */
  Room(int dimension, double share, Random& random);
  ~Room();
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  static constexpr int kCells = 3;

  int dimension() const { return dimension_; }
  dsw_scene* scene() const { return scene_; }
  const Figure& walls() const { return walls_; }
  /** Creates a body. Returns whether there was room for it. */
  bool add(const Figure& body, double radius, dsw_body_id& id, std::uint32_t flags = 0);
  std::vector<Point> places(dsw_body_id body) const;

 private:
  void add_cells(std::vector<std::int64_t>& cells) const;
  void mark(const std::vector<std::int64_t>& cells, double share, Random& random);

  int dimension_;
  dsw_environment* environment_ = nullptr;
  dsw_scene* scene_ = nullptr;
  Figure walls_;
};

enum class BodyKind { kRod, kSheet, kClosed };

/** Where a motion has something in its way on purpose. */
enum class Plant {
  kNone,
  kHidden,  // between the arc and its 1,000 chords
  kMissed,  // beside the arc, by 1e-9 to 1e-15
  kGrazed   // in its way, by 1e-9 to 1e-15
};

/** What of the body is beside what is planted. */
enum class Near {
  kVertex,     // a vertex, the farthest from the axis
  kEdgeAlong,  // an edge along the axis, the farthest from it
  kEdgeInside  // an edge across the axis, the nearest to it
};

struct Case {
  Figure body;
  BodyKind kind = BodyKind::kRod;
  std::vector<Figure> others;  // bodies that stand
  dsw_rigid_motion motion{};
  double degrees = 0;
  Plant plant = Plant::kNone;
  Near near = Near::kVertex;
  double depth = 0;  // of what is planted
};

Case draw_case(const Room& room, Random& random);

}  // namespace dsw::rigid

#endif
