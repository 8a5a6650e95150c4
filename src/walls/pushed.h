#pragma once
// What was pushed, or found in another cell, with where it was: so that it can go back.

#include "body/rigid_shape.h"
#include "walls/occupants.h"

namespace dsw {

/** Keeps its memory from move to move. */
template <int D>
class Pushed {
 public:
  explicit Pushed(Occupants<D>& all, const Memory* memory) : all_(all), places_(memory), motions_(memory) {}

  bool empty() const noexcept { return places_.empty(); }
  void clear() noexcept {
    places_.clear();
    motions_.clear();
  }
  /** Keeps where a point is. Throws std::bad_alloc. */
  void note(const Feature& point) {
    Place place{point, {}, cell_of(all_, point)};
    std::copy_n(position(all_, point), D, place.at);
    places_.push_back(place);
  }
  /** Keeps where a rigid body is. Throws std::bad_alloc. */
  void note_rigid(uint32_t owner) {
    Body<D>& body = *all_.bodies[owner].body;
    keep_shape(body);
    motions_.push_back({owner, body.shape[0].moved});
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) note({Feature::kVertex, owner, v});
    }
  }
  /** Puts all back, what was noted last first. */
  void take_back() noexcept {
    for (size_t i = places_.size(); i-- != 0;) set_location(all_, places_[i].point, places_[i].at, places_[i].cell);
    for (size_t i = motions_.size(); i-- != 0;) all_.bodies[motions_[i].owner].body->shape[0].moved = motions_[i].moved;
    clear();
  }
  uint64_t memory_bytes() const noexcept { return array_bytes(places_) + array_bytes(motions_); }

 private:
  struct Place {
    Feature point;
    double at[D];
    Cell cell;
  };
  struct Motion {
    uint32_t owner;
    RigidMotion<D> moved;
  };
  Occupants<D>& all_;
  Array<Place> places_;
  Array<Motion> motions_;  // of rigid bodies
};

}  // namespace dsw
