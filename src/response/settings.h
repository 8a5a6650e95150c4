#pragma once
// How a body is moved, and what comes of it.

#include "base/memory.h"
#include "dartsweep/body.h"
#include "dartsweep/contact.h"
#include "sweep/counts.h"

namespace dsw {

enum class Response : uint32_t { kStop, kAdaptiveOne, kAdaptiveMany, kHybrid, kSlide, kAdaptiveSlide };
enum class Search : uint32_t { kExact, kAll, kBisection, kBisectionVertex };

/** See dsw_move_options. */
struct MoveSettings {
  Response vertex = Response::kStop, edge = Response::kStop;
  Search search = Search::kExact;
  uint32_t bisection_depth = 20;
  uint32_t max_volumes = 0;
  double min_part = 0.25, min_length = 0;
  double stand_off = 0;  // 0: 1e-9 of the cell in front; negative: none
  double noise_share = 0;
  bool keeps_walls = false;  // slides stay before all walls that the vertex has touched
  uint32_t passes = 0;       // further ones, over the vertices that have stopped
  bool leaves = false;       // vertices that come to an exit stay there, to be removed

  bool halves() const { return search == Search::kBisection || search == Search::kBisectionVertex; }
  bool may_slide() const { return slides(vertex) || slides(edge); }
  static bool slides(Response response) { return response == Response::kSlide || response == Response::kAdaptiveSlide; }
  bool may_edit() const { return may_insert() || noise_share > 0; }
  bool may_insert() const {
    return edge == Response::kAdaptiveOne || edge == Response::kAdaptiveMany || edge == Response::kHybrid ||
           edge == Response::kAdaptiveSlide;
  }
};

/** Which vertices move, and in which order. */
struct MoveOrder {
  const uint32_t* vertices = nullptr;  // null: all living ones by index
  size_t count = 0;
};

/** Where a vertex that was at `from` is at a fraction of a motion of the whole body. */
using PlaceFn = void (*)(const void* user, uint32_t vertex, const double* from, double fraction, double* to);

/** A rigid motion as a host gives it, with a quaternion of length 1. */
struct PlainMotion {
  double rotation[4] = {0, 0, 0, 1};
  double centre[3] = {};
  double translation[3] = {};
};

/** What a move counts, and how far the body got. */
struct MoveSums {
  double fraction = 1;
  uint32_t moved = 0, stopped = 0, limited = 0;
  SweepCounts sweeps;
  PlainMotion left;  // of a rigid motion
};

/** What a move leaves for the host to read. */
struct MoveRecord : MoveSums {
  Array<dsw_body_contact> contacts;
  Array<dsw_contact_partner> partners;   // of the contacts, if bodies meet each other
  Array<dsw_previous_contact> previous;  // of the contacts: filled in when the move is done
  bool keeps_partners = false;
  Array<dsw_body_edit> edits;
  Array<dsw_exit> exits;    // of vertices that leave
  Array<double> ways_left;  // by slot, of a move at once

  explicit MoveRecord(const Memory* memory)
      : contacts(memory), partners(memory), previous(memory), edits(memory), exits(memory), ways_left(memory) {}
  void add(const dsw_body_contact& contact, const dsw_contact_partner& partner = {}) {
    contacts.push_back(contact);
    previous.emplace_back();
    if (keeps_partners) partners.push_back(partner);
  }
  void clear() {
    contacts.clear();
    partners.clear();
    previous.clear();
    edits.clear();
    exits.clear();
    ways_left.clear();
    static_cast<MoveSums&>(*this) = {};
  }
  void swap(MoveRecord& other) noexcept {
    contacts.swap(other.contacts);
    partners.swap(other.partners);
    previous.swap(other.previous);
    std::swap(keeps_partners, other.keeps_partners);
    edits.swap(other.edits);
    exits.swap(other.exits);
    ways_left.swap(other.ways_left);
    std::swap(static_cast<MoveSums&>(*this), static_cast<MoveSums&>(other));
  }
};

}  // namespace dsw
