#pragma once
// How an environment's points are moved, and what comes of it.

#include "base/sort.h"
#include "dartsweep/deform.h"
#include "walls/wall_sweep.h"

namespace dsw {

/** See dsw_deform_options. */
struct WallSettings {
  dsw_wall_response response = DSW_WALL_PUSH;
  bool end_state = false;
  bool refuses_invalid = false;
  uint32_t most_halvings = 10;   // of the steps
  uint32_t max_holds = 1 << 14;  // turns in which a vertex stays, in all tries together
  double min_part = 0.25;        // of an edge, that a split leaves
  size_t point_room = 0;         // of the array that is lent, in vertices; 0: no more than there are
};

/** What a deformation leaves for the host to read. */
struct WallRecord {
  Array<dsw_wall_contact> contacts;
  Array<dsw_vertex_id> held;     // of the environment, not where they should be
  Array<dsw_volume_id> invalid;  // that could not be let become what they would have
  dsw_deform_outcome outcome = DSW_DEFORM_DONE;
  double fraction = 1;
  uint32_t steps = 0, near = 0, pushed = 0;

  explicit WallRecord(const Memory* memory) : contacts(memory), held(memory), invalid(memory) {}
  void clear() {
    contacts.clear();
    held.clear();
    invalid.clear();
    outcome = DSW_DEFORM_DONE;
    fraction = 1;
    steps = near = pushed = 0;
  }
  /** Lists of ids by index, each once. */
  void sort() noexcept {
    const auto before = [](const auto& a, const auto& b) { return a.index < b.index; };
    const auto same = [](const auto& a, const auto& b) { return a.index == b.index; };
    dsw::sort(held.begin(), held.end(), before);
    dsw::sort(invalid.begin(), invalid.end(), before);
    invalid.erase(std::unique(invalid.begin(), invalid.end(), same), invalid.end());
  }
  uint64_t memory_bytes() const { return array_bytes(contacts) + array_bytes(held) + array_bytes(invalid); }
};

}  // namespace dsw
