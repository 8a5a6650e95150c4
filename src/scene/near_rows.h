#pragma once
// Near rows of a body, as a host reads them, and what is kept from one call to the next.

#include "dartsweep/near.h"
#include "proximity/near_search.h"

namespace dsw {

template <int D>
struct Scene;
template <int D>
struct BodyRecord;

/** Compressed sparse rows. */
struct NearJacobian {
  Array<uint32_t> offsets, columns;
  Array<double> values;

  explicit NearJacobian(const Memory* memory) : offsets(memory), columns(memory), values(memory) {}
  void clear() noexcept {
    offsets.clear();
    columns.clear();
    values.clear();
  }
};

template <int D>
struct NearRecord {
  NearNotes<D> notes;
  Array<dsw_near_row> rows, last;        // of this call and of the one before
  uint64_t last_version = ~uint64_t{0};  // Environment::change_version when the last rows were found
  NearJacobian jacobian;                 // of the rows, if it has been asked for; else empty

  explicit NearRecord(const Memory* memory) : notes(memory), rows(memory), last(memory), jacobian(memory) {}
  uint64_t memory_bytes() const {
    return sizeof(*this) + notes.memory_bytes() + array_bytes(rows) + array_bytes(last) +
           array_bytes(jacobian.offsets) + array_bytes(jacobian.columns) + array_bytes(jacobian.values);
  }
};

struct NearSettings {
  double margin = 0;
  double radius = 0;  // added to the body's
  bool jacobian = false;
};

/** Throws std::bad_alloc; then there are no rows. */
template <int D>
void find_near_rows(Scene<D>& scene, BodyRecord<D>& of, const NearSettings& settings);

}  // namespace dsw
