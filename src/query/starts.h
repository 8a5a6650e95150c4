#pragma once
// Where free casts and sweeps start.

#include "query/report.h"
#include "query/segments.h"
#include "walk/prefetch.h"

namespace dsw {

/** Whether a cast can start there. */
template <int D>
inline bool is_passable(const Environment<D>& env, Cell start) noexcept {
  return start.valid() && !is_closed(env, start);
}

/** Where casts start: known, or located with or without a hint. */
template <int D>
class Starts {
 public:
  Starts(const Environment<D>& env, const dsw_volume_id* ids, bool known) noexcept
      : env_(env), ids_(ids), known_(known && ids != nullptr) {}

  Cell find(size_t i, const double* from) const noexcept {
    if (known_ && !is_null(ids_[i])) return env_.map.cell(ids_[i].index);
    return locate_point(env_, from, ids_ == nullptr ? dsw_volume_id{0, 0} : ids_[i]);
  }
  void prefetch(size_t i) const noexcept {
    if (known_ && !is_null(ids_[i])) prefetch_record(env_, env_.map.cell(ids_[i].index));
  }

 private:
  const Environment<D>& env_;
  const dsw_volume_id* ids_;
  bool known_;
};

}  // namespace dsw
