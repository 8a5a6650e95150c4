#pragma once
// What a change of the topology leaves for the host to read, whatever made the change.

#include "cutting/cut.h"
#include "scene/change_results.h"
#include "scene/edits.h"

namespace dsw {

/** What is told of a change besides its volumes. */
struct Told {
  dsw_change numbers{};  // without arrays
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

  /** Carries out an edit that is prepared, as edits.h says, and tells of it. Returns whether the change stays; if not,
   * the results are empty. Throws as carry_out_prepared and std::bad_alloc: then the results are as before. */
  bool change(Edit<D>& edit, const Told& told, const Meanwhile* meanwhile = nullptr) const;
};

}  // namespace dsw
