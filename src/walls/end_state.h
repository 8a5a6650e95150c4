#pragma once
// The environment's points go to new places at once [JCD10] 5.1: occupants are looked for where they are then. That
// tells rightly on which side of a wall they are when walls move less than a cell is thick.

#include "proximity/thick_sweep.h"
#include "sweep/body_probe.h"
#include "walk/packet.h"
#include "walls/end_repair.h"
#include "walls/find_way.h"

namespace dsw {

/** The cells that the points of a packet lie in, each once: neighbours on a body share them. */
template <int D>
class PacketCells {
 public:
  void clear() noexcept {
    count_ = 0;
    std::fill_n(places_, kSlots, kEmpty);
  }
  uint32_t count() const noexcept { return count_; }
  Cell operator[](uint32_t place) const noexcept { return cells_[place]; }
  /** Its place. */
  uint32_t insert(Cell c) noexcept {
    uint32_t slot = (c.unit * 0x9e3779b1u) >> 24;
    for (; places_[slot] != kEmpty; slot = (slot + 1) % kSlots) {
      if (cells_[places_[slot]] == c) return places_[slot];
    }
    cells_[count_] = c;
    places_[slot] = static_cast<uint8_t>(count_);
    return count_++;
  }

 private:
  static constexpr uint32_t kSlots = 256;
  static constexpr uint8_t kEmpty = 0xff;
  static_assert(2 * kPacket <= kSlots);

  uint32_t count_ = 0;
  Cell cells_[kPacket];
  uint8_t places_[kSlots];  // by hash, linear probing
};

template <int D>
class EndState {
 public:
  EndState(Environment<D>& env, Occupants<D>& all);

  /** See WallMotion::run. What has come to lie beyond a wall is put before it. Where that is not enough, or a cell that
   * is met would not be valid, the way is shortened. O(occupants, volumes met). */
  void run(double* next, const WallSettings& settings, WallRecord& record);

 private:
  Went try_state(const WallSettings& settings, WallRecord& record);
  Went run_packet(const WallSettings& settings, WallRecord& record);
  bool put_before(const CastRequest& request, const CastResult& flight, const Feature& point, dsw_wall_response done,
                  WallRecord& record);
  bool repair(const WallSettings& settings, WallRecord& record);

  Environment<D>& env_;
  Occupants<D>& all_;
  Packet<D> packet_;
  Array<Feature> points_{env_.memory};  // of the packet
  PacketCells<D> cells_;
  double centres_[kPacket][D];  // of these
  BodyProbe<D> probe_;
  ThickSweep<D> thick_;
  EndRepair<D> repair_;
  Array<Feature> struck_{env_.memory};  // vertices of rigid bodies that lie beyond walls
};

}  // namespace dsw
