#pragma once
// The environment's points go to new places, and what lies there is kept free [JCD10] 5.1: near occupants one vertex at
// a time, by index, so that nothing is passed; elsewhere at once.

#include "walls/find_way.h"
#include "walls/wall_move.h"

namespace dsw {

template <int D>
class WallMotion {
 public:
  WallMotion(Environment<D>& env, Occupants<D>& all);

  /** Takes the points to `next` in 2^k steps; k grows until the cells that are met stay valid with every single vertex.
   * The environment reads `next` from then on, in which there is what was reached. Throws std::bad_alloc, and
   * NON_FINITE for a point near occupants: then all is as it was before. O(occupants, volumes met); where the way is
   * shortened, O(points). */
  void run(double* next, const WallSettings& settings, WallRecord& record);

  /** The cells that hold anything now, each once. Valid until the next call. Throws std::bad_alloc. */
  const Array<Cell>& find_occupied() {
    around_.find_occupants();
    return around_.occupied();
  }

  uint64_t memory_bytes() const noexcept { return around_.memory_bytes() + move_.memory_bytes() + array_bytes(turns_); }

 private:
  Went try_steps(double* next, double way, uint32_t halvings, const WallSettings& settings, WallRecord& record);
  void finish(WallRecord& record);

  Environment<D>& env_;
  Occupants<D>& all_;
  Neighbourhood<D> around_;
  WallMove<D> move_;
  Array<uint32_t> turns_{env_.memory};
  uint32_t holds_ = 0;  // turns in this call in which a vertex has stayed
  bool is_limited_ = false;
};

}  // namespace dsw
