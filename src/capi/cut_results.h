#pragma once
// What a host can ask for after a cut, and what all kinds of cuts share.

#include "capi/convert.h"
#include "cutting/cut.h"

namespace dsw::capi {

/** The share of an edge's length within which a vertex stands for a crossing; throws unless it is allowed. */
double to_snap(double given);

/** `visited`: cells that were looked at. */
dsw_cut_report to_report(const CutRecord& record, uint32_t visited) noexcept;

/** What the host can ask for after a cut, an opening or a tear, with room for all of it. */
template <int D>
class CutResults {
 public:
  /** Before the edit is finished: what vertices come from may go then. What is given outlives this; of what is null the environment
   * keeps what it has. Throws std::bad_alloc. */
  CutResults(Edit<D>& edit, const Array<CutFace>& faces, const Array<NewVertex>* vertices, const Array<Cell>* whole);

  /** After it is finished: ids are new. */
  void give_to(dsw_environment& handle) noexcept;

 private:
  Edit<D>& edit_;
  const Array<CutFace>& of_faces_;
  const Array<NewVertex>* of_vertices_;
  const Array<Cell>* of_whole_;
  Array<dsw_volume_change> changes_;
  Array<dsw_cut_face> faces_;
  Array<dsw_cut_vertex> vertices_;
  Array<dsw_volume_id> whole_;
};

}  // namespace dsw::capi
