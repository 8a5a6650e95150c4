#pragma once
// What of bodies and particles lies in which cells.

#include <algorithm>

#include "base/sort.h"
#include "body/feature.h"
#include "proximity/partners.h"
#include "response/settings.h"
#include "walk/particle_state.h"

namespace dsw {

/** All that lies in an environment. */
template <int D>
struct Occupants {
  struct Owner {
    Body<D>* body = nullptr;  // null: a free slot
    MoveRecord* record = nullptr;
    dsw_body_id id = {};
  };
  Array<Owner> bodies;  // by the owner of a Feature
  ParticleState<D>* particles = nullptr;
  size_t particle_count = 0;
  const SlotPool* particle_slots = nullptr;
  const Partners<D>* partners = nullptr;  // all bodies, if they meet each other

  explicit Occupants(const Memory* memory)
      : bodies(memory),
        saved_particles_(memory),
        saved_vertices_(memory),
        saved_bodies_(memory),
        saved_shapes_(memory) {}

  /** Keeps where everything is, and if vertices will be inserted the bodies as a whole. Throws std::bad_alloc. */
  void save(bool whole);
  /** Puts everything back to where it was when it was saved last; unless that is done, was let go, or saving failed. */
  void restore() noexcept;
  /** Where a vertex of a body was when it was saved last; null where it was not. */
  const double* saved_position(uint32_t owner, uint32_t vertex) const noexcept;
  /** Lets go what was saved before. */
  void forget_saved() noexcept { saved_ = false; }
  uint64_t memory_bytes() const noexcept;

 private:
  bool saved_ = false;
  Array<ParticleState<D>> saved_particles_;
  Array<BodyVertex<D>> saved_vertices_;
  Array<Body<D>> saved_bodies_;
  Array<RigidShape<D>> saved_shapes_;  // of rigid ones, unless they are saved as a whole
};

template <int D>
inline const double* position(const Occupants<D>& all, const Feature& point) {
  return point.kind == Feature::kParticle ? all.particles[point.index].position
                                          : all.bodies[point.owner].body->position(point.index);
}
template <int D>
inline Cell cell_of(const Occupants<D>& all, const Feature& point) {
  return point.kind == Feature::kParticle ? all.particles[point.index].cell
                                          : all.bodies[point.owner].body->vertices[point.index].cell;
}
template <int D>
inline void set_location(Occupants<D>& all, const Feature& point, const double* at, Cell cell) {
  if (point.kind == Feature::kParticle) {
    ParticleState<D>& p = all.particles[point.index];
    if (p.cell != cell) p.forecast = kNoFacet;
    std::copy_n(at, D, p.position);
    p.cell = cell;
  } else {
    put_vertex(*all.bodies[point.owner].body, point.index, at, cell);
  }
}

/** Features by cell. One may be noted in more cells than it lies in, and more than once. */
class CellFeatures {
 public:
  explicit CellFeatures(const Memory* memory) : heads_(memory), nodes_(memory) {}

  /** Empty, for so many cells. Throws std::bad_alloc. */
  void start(size_t cells) {
    clear();
    tidied_ = 0;
    heads_.resize(cells, kNone);
  }
  void clear() noexcept {
    for (const Node& node : nodes_) heads_[node.cell] = kNone;
    nodes_.clear();
  }
  /** Whether it is the cell's first. Throws std::bad_alloc before it changes anything. */
  bool add(uint32_t cell, const Feature& feature) {
    const uint32_t head = heads_[cell];
    if (head != kNone && nodes_[head].feature == feature) return false;
    nodes_.push_back({feature, cell, head});
    heads_[cell] = static_cast<uint32_t>(nodes_.size() - 1);
    return head == kNone;
  }
  /** Drops what stands twice, once that is most of it. */
  void tidy() {
    if (nodes_.size() < 2 * tidied_ + 1024) return;
    const auto before = [](const Node& a, const Node& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.feature < b.feature;
    };
    const auto same = [](const Node& a, const Node& b) { return a.cell == b.cell && a.feature == b.feature; };
    dsw::sort(nodes_.begin(), nodes_.end(), before);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end(), same), nodes_.end());
    for (uint32_t n = 0; n < nodes_.size(); ++n) {
      const bool first = n == 0 || nodes_[n - 1].cell != nodes_[n].cell;
      nodes_[n].next = first ? kNone : n - 1;
      heads_[nodes_[n].cell] = n;
    }
    tidied_ = nodes_.size();
  }
  template <class Visit>
  void for_each(uint32_t cell, Visit visit) const {
    for (uint32_t n = heads_[cell]; n != kNone; n = nodes_[n].next) visit(nodes_[n].feature);
  }
  uint64_t memory_bytes() const noexcept { return array_bytes(heads_) + array_bytes(nodes_); }

 private:
  struct Node {
    Feature feature;
    uint32_t cell, next;
  };
  Array<uint32_t> heads_;  // by cell
  Array<Node> nodes_;
  size_t tidied_ = 0;
};

}  // namespace dsw
