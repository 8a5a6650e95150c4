#pragma once
// What a mending and a deformation that mends have in common.

#include "capi/handle.h"
#include "remesh/mending.h"
#include "scene/edits.h"

namespace dsw::capi {

/** 0 means the default. Throws OUT_OF_RANGE. */
MendSettings to_mend_settings(uint32_t radius, uint32_t max_faces);

/** What the host can ask for afterwards, with room for all of it. */
class MendResults {
 public:
  /** `edit` is null if nothing changes. Throws std::bad_alloc. */
  MendResults(const Environment<3>& env, const MendRecord& record, const Edit<3>* edit);
  /** After the edit is finished. */
  void move_to(dsw_environment& handle, Edit<3>* edit) noexcept;

 private:
  Array<dsw_volume_change> changes_;
  Array<dsw_volume_id> unmended_;
};

}  // namespace dsw::capi
