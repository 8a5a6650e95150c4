#pragma once
// What a change of the topology leaves for the host to read, whatever made the change.

#include "cutting/cut.h"
#include "dartsweep/carve.h"
#include "scene/edits.h"

namespace dsw {

/** Of the last change that has such results. */
struct ChangeResults {
  Array<dsw_volume_change> volumes;
  Array<dsw_cut_vertex> vertices;
  Array<dsw_cut_face> faces;
  Array<dsw_volume_id> whole, carved, unmended;

  explicit ChangeResults(const Memory* memory)
      : volumes(Allocator<dsw_volume_change>(memory)),
        vertices(Allocator<dsw_cut_vertex>(memory)),
        faces(Allocator<dsw_cut_face>(memory)),
        whole(Allocator<dsw_volume_id>(memory)),
        carved(Allocator<dsw_volume_id>(memory)),
        unmended(Allocator<dsw_volume_id>(memory)) {}
  uint64_t memory_bytes() const noexcept;
};

/** What is told of a change besides its volumes. Of what is null the results keep what they have. */
struct Told {
  const Array<NewVertex>* vertices = nullptr;
  const Array<CutFace>* faces = nullptr;
  const Array<Cell>*whole = nullptr, *carved = nullptr;
};

/** Where a change is made: an environment, the only scene that uses it or null, and what the host can read. */
template <int D>
struct Site {
  Environment<D>& env;
  Scene<D>* scene;
  ChangeResults& results;

  /** Carries out an edit that is prepared, as edits.h says, and tells of it. Returns whether the change stays. Throws
   * as carry_out_prepared and std::bad_alloc: then the results are as before. */
  bool change(Edit<D>& edit, const Told& told, const Meanwhile* meanwhile = nullptr) const;
};

}  // namespace dsw
