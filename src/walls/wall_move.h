#pragma once
// One vertex of the environment on its way to a target, with the walls at it, and what they meet [JCD10] 5.1.

#include "walls/pushed.h"
#include "walls/rigid_push.h"
#include "walls/settings.h"

namespace dsw {

template <int D>
class WallMove {
 public:
  WallMove(Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around);

  /** kHeld: by what is met. kInvalid: cells that hold occupants would not be valid, or something could not be followed
   * into its new cell. In both cases the vertex stays, and nothing is pushed. kStopped: as kHeld, and nothing has been pushed. */
  enum class Moved { kYes, kHeld, kInvalid, kStopped };

  /** Other points move now, from the start of a way. */
  void begin() noexcept { told_.clear(); }
  /** Moves near vertex v. Contacts go to the record. Throws std::bad_alloc, with a state that holds no more. */
  Moved move(uint32_t v, const double* to, const WallSettings& settings, WallRecord& record);

  /** Cells round the vertex that was moved last which are not valid with it at `to`, but for those that have been told
   * since the way began. */
  void find_invalid(uint32_t v, const double* to, Array<dsw_volume_id>& invalid);
  /** All cells round that vertex: where they would be valid, but what lies in them cannot be followed there. */
  void find_around(Array<dsw_volume_id>& cells) const;

  uint64_t memory_bytes() const noexcept {
    return rigid_.memory_bytes() + pushed_.memory_bytes() + relocated_.memory_bytes() + array_bytes(features_) +
           array_bytes(hits_);
  }

 private:
  class Try;
  void look_round(uint32_t v);
  bool find_hits(const double* from, const double* to);
  bool make_room(const double* from, const double* to, int pushes, const WallSettings& settings, WallRecord& record);
  bool make_room_for(WallHit& hit, const double* from, const double* to, int pushes, const WallSettings& settings,
                     WallRecord& record);
  bool is_there(const Feature& feature) const noexcept;
  bool is_rigid(const Feature& feature) const noexcept {
    return feature.kind != Feature::kParticle && all_.bodies[feature.owner].body->is_rigid();
  }
  bool push_corners(uint32_t owner, const uint32_t* corners, int count, const double* weights, const Vec& way,
                    WallRecord& record);
  bool push(const Feature& point, const Vec& way);
  uint32_t insert(const WallHit& hit, double min_part);
  void put(uint32_t v, const double* position);
  bool locate_all();
  bool is_star_valid() const noexcept;
  bool has_thick() const noexcept;
  Box<D> box_of(Cell c) const noexcept;
  Cell find_cell(const Feature& point) const;

  Environment<D>& env_;
  Occupants<D>& all_;
  Neighbourhood<D>& around_;
  WallSweep<D> walls_;
  StarSweep<D> sweeps_;
  RigidPush<D> rigid_;
  const Array<Cell>* star_ = nullptr;
  Array<Feature> features_{env_.memory};  // in the star
  Array<WallHit> hits_{env_.memory};
  Pushed<D> pushed_{all_, env_.memory}, relocated_{all_, env_.memory};  // relocated: points of the star, by cell alone
  CellQueue told_{env_.memory};                                         // those of find_invalid
};

}  // namespace dsw
