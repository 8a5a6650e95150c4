#pragma once
// What a body that turns touches first, exactly: walls, marked edges and vertices, and bodies that stand.

#include "body/simplices.h"
#include "proximity/obstacle_sides.h"
#include "proximity/obstacles_near.h"
#include "proximity/partners.h"
#include "response/rigid_way.h"

namespace dsw {

/** A part of the body, and what it enters first. */
template <int D>
struct RigidTouch {
  Simplex part{};
  // The corners of what is touched, and where they go if the environment moves; of the environment they have names.
  const double *points[3] = {}, *ends[3] = {};
  uint32_t vertices[3] = {kNone, kNone, kNone};
  uint32_t count = 0;
  HalfFacet facet;  // as in WallFeature
  Cell cell;
  uint32_t partner = kNone;  // the number of the body that is touched; kNone: the environment
  Simplex other{};           // its part
};

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class RigidTouches {
 public:
  explicit RigidTouches(const Environment<D>& env)
      : env_(env),
        flood_(env),
        obstacles_(env.memory),
        parts_(env.memory),
        others_(env.memory),
        turns_(env.memory),
        beyond_(env.memory),
        asked_(env.memory) {}

  /** From now on the environment's points go straight to these. Null: they stand still. */
  void set_next(const double* points) noexcept { next_ = points; }

  /** Finds when the body first enters something: a wall under the shift, or another body as soon as they touch.
   * @param until what is entered after this time need not be found.
   * @param reached where points of the environment that go are at that time; null: where set_next() leads them.
   * @param beside cells that are within this distance of the way are among cells(). */
  FirstTouch find_first(const Body<D>& body, const RigidWay<D>& way, const Partners<D>* partners, double until = 1,
                        const double* reached = nullptr, double beside = 0);
  /** Whether find_first has found pairs that touch at time 0 and does not know what they do then. */
  bool is_open_at_start() const noexcept { return is_open_; }
  /** What find_first has found, if it enters anything. */
  const RigidTouch<D>& touched() const noexcept { return touched_; }

  /** What find_first has found of the environment that can be met in the box of the way. */
  const NearList<D>& obstacles() const noexcept { return obstacles_; }
  /** The cells that find_first has come by. */
  const CellQueue& cells() const noexcept { return flood_.cells(); }

 private:
  struct Part {
    Simplex name;
    SimplexCorners<D> corners;
  };
  /** An obstacle or a part of another body, by its number, and the piece of the way that first comes near it. */
  struct Turn {
    uint32_t piece, number;
  };
  void find_obstacles(const Body<D>& body, const RigidWay<D>& way, double beside);
  void add_obstacle(const RigidWay<D>& way, const WallFeature& obstacle);
  void add(const RigidWay<D>& way, const RigidTouch<D>& other);
  void add_body(const RigidWay<D>& way, const Partners<D>& partners, uint32_t number);
  void find_parts(const Body<D>& body);
  static Box<D> box_of(const RigidTouch<D>& other, const RigidWay<D>& way, uint32_t piece) noexcept;
  void meet(const Body<D>& body, const RigidWay<D>& way, const Turn& turn);
  void meet_moving(const RigidWay<D>& way, const Turn& turn);
  void look_from(const Body<D>& body, const RigidWay<D>& way, const ObstacleSides<D>& sides, uint32_t piece,
                 uint16_t* beyond) const;
  void touch(const Part& part, const RigidWay<D>& way, RigidTouch<D>& touch, uint32_t beyond, uint8_t* asked);
  void ask(const TurningPair<D>& pair, const RigidTouch<D>& touch);
  uint32_t last_piece(const RigidWay<D>& way) const noexcept;

  const Environment<D>& env_;
  const double* next_ = nullptr;
  ObstacleFlood<D> flood_;
  NearList<D> obstacles_;
  Array<Part> parts_;  // in the order of for_each_simplex
  Array<RigidTouch<D>> others_;
  Array<Turn> turns_;
  Array<uint16_t> beyond_;  // by vertex, at the begin and the end of a piece
  Array<uint8_t> asked_;    // by part
  FirstTouch first_{};
  RigidTouch<D> touched_;
  uint64_t asks_ = 0, first_ask_ = 0;  // numbers of the pair that is asked about, and of the one that touches first
  bool is_open_ = false;
};

}  // namespace dsw
