#pragma once
// Bodies of which all vertices move at once, until something is touched.

#include "together/shortened_ways.h"

namespace dsw {

/** Who stops at a contact; see dsw_together_stop. */
enum class TogetherStop : uint32_t { kAll, kIsland, kFeature };

struct TogetherSettings {
  TogetherStop stop = TogetherStop::kAll;
  uint32_t rounds = 64;  // most rounds of kFeature
};

/** Moves bodies; one for each thread. */
template <int D>
class TogetherMove {
 public:
  explicit TogetherMove(const Environment<D>& env) : env_(env), walls_(env), bodies_(env.memory) {}
  TogetherMove(const TogetherMove&) = delete;
  TogetherMove& operator=(const TogetherMove&) = delete;

  /** Moves bodies that depend on nobody else that moves. They begin with their records cleared. Throws std::bad_alloc
   * with some vertices moved.
   * @param bodies_meet whether bodies can touch at all. */
  void move(Array<Traveller<D>>& travellers, bool bodies_meet, const TogetherSettings& settings);

  void set_counters(CastCounters* counters) { walls_.set_counters(counters); }

 private:
  void start(Array<Traveller<D>>& travellers, bool bodies_meet);
  /** How a round ended. kDeparted: before anything was touched. */
  enum class Round { kArrived, kDeparted, kStopped };
  Round run_round(Array<Traveller<D>>& travellers, bool may_depart);
  Round shorten_ways(Array<Traveller<D>>& travellers, uint32_t most_rounds, bool may_depart);
  bool departs(Array<Traveller<D>>& travellers);
  void drop_covering(const Array<Traveller<D>>& travellers);
  void retreat(Array<Traveller<D>>& travellers);
  bool is_free(Array<Traveller<D>>& travellers);
  void set_ends(Array<Traveller<D>>& travellers, double time);
  void arrive(Array<Traveller<D>>& travellers);

  const Environment<D>& env_;
  WallWays<D> walls_;
  BodyWays<D> bodies_;
  ShortenedWays<D> shortened_{env_, walls_, bodies_};
  FirstTouches<D> first_{env_.memory};
  double time_ = 1;  // of this round, up to which all have gone
};

}  // namespace dsw
