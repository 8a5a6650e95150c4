#pragma once
// What a host can ask for after a cut, and what all kinds of cuts share.

#include "capi/convert.h"
#include "cutting/cut.h"

namespace dsw::capi {

/** The share of an edge's length within which a vertex stands for a crossing; throws unless it is allowed. */
double to_snap(double given);

/** `visited`: cells that were looked at. */
dsw_cut_report to_report(const CutRecord& record, uint32_t visited) noexcept;

/** What the host can ask for after a cut, with room for all of it. */
struct CutResults {
  Array<dsw_volume_change> changes;
  Array<dsw_cut_vertex> vertices;
  Array<dsw_cut_face> faces;
  Array<dsw_volume_id> whole;

  CutResults(const Memory* memory, const CutRecord& record, const Edit& edit);

  /** After the edit is finished: ids are new. */
  void fill(const Map<3>& map, const CutRecord& record, Edit& edit);

  /** What a tear gives. */
  void move_faces_to(dsw_environment& handle) noexcept;
  void move_to(dsw_environment& handle) noexcept;
};

/** An array that an environment keeps for the host. */
template <class T>
void hand_out(const Array<T>& array, const T** items, size_t* count, const char* name) {
  require(items, name);
  require(count, "count");
  *items = array.data();
  *count = array.size();
}

}  // namespace dsw::capi
