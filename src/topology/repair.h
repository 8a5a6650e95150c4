#pragma once
// Invalid cells disappear, with a few of their neighbours, into cells that are valid.

#include <optional>

#include "topology/patch.h"

namespace dsw {

struct RepairSettings {
  uint32_t radius = 1;       // a patch keeps to so many rings of cells round invalid ones, by vertices
  uint32_t most_faces = 48;  // round a patch, at most kMostRim
  bool only_valid = false;   // cells that are invalid now stay: what goes then fills the same space as what comes
};

/** What a repair did. */
struct RepairRecord {
  uint32_t wanted = 0;  // cells that had to be repaired
  uint32_t patches = 0, gone = 0, made = 0, most_faces = 0;
  Array<Cell> left;  // of those wanted, as they were; by index

  explicit RepairRecord(const Memory* memory) : left(memory) {}
};

/** Whether a cell is valid with these positions, exactly. */
bool is_valid_with(Environment<3>& env, const double* points, Cell c) noexcept;

class Repair {
 public:
  /** `next`: positions in which cells have to be valid besides the present ones, or null. Makes the map ready to
   * change. Throws std::bad_alloc, as all that follows. */
  Repair(Environment<3>& env, const double* next, const RepairSettings& settings);

  /** Wants a cell repaired, if it is invalid now or next. */
  void want(Cell c);
  /** Wants all cells repaired that are invalid now or next. O(cells). */
  void want_all();
  /** Looks for what repairs them, the lowest index first, and prepares an edit that does; none if nothing was found.
   * Throws as Edit::prepare, but for what is wrong with cells. */
  void prepare(std::optional<Edit<3>>& edit);
  const RepairRecord& record() const noexcept { return record_; }

 private:
  /** Into what a patch is to come near. */
  enum class Aim { kTetrahedra, kOneCell };
  static constexpr uint32_t kNoPatch = 0xffffffffu;

  bool may_go(Cell c, Cell seed);
  bool is_kept(HalfFacet h) const;
  void find_ring(Cell seed);
  uint32_t patch_of(Cell c) const;
  bool repair(Cell seed);
  bool start(Cell seed);
  bool surround(Cell seed);
  bool grow(Cell seed, uint32_t first);
  bool grow(Cell seed, uint32_t first, Aim aim);
  void keep_grown();
  bool extend(const Patch& patch, Cell seed, Cell by);
  Patch::Filling find_filling(Patch& patch);
  bool write(Edit<3>& edit);

  Environment<3>& env_;
  Geometry geometry_;
  RepairSettings settings_;
  RepairRecord record_;
  RimSurface surface_;
  CellQueue ring_{env_.memory}, around_;
  Patch grown_, trial_, best_;
  Array<Cell> wanted_{env_.memory};
  Array<Patch> patches_{env_.memory};   // those without a filling are no more
  KeyTable repaired_{env_.memory};      // cells of patches, by unit
  Array<uint32_t> patch_{env_.memory};  // of each
};

}  // namespace dsw
