#pragma once
// The whole way of a deformation, or the largest part of it that nothing stops.

#include "motion/halving.h"
#include "walls/settings.h"

namespace dsw {

/** kLimited: as kStopped, and no other way is tried. */
enum class Went { kThrough, kStopped, kInvalid, kRefused, kLimited };

/** Tries the whole way; where it is stopped half of it, a quarter, ... and at last none. try_way(way) tells how it
 * went; take_back() puts the environment to where it was, this the occupants. Whether one was made: `record` has its
 * fraction, and what stopped the one before. `whole`: see Occupants::save. */
template <int D, class TryWay, class TakeBack>
bool find_way(Occupants<D>& all, bool whole, WallRecord& record, TryWay try_way, TakeBack take_back) {
  Array<dsw_wall_contact> contacts(record.contacts.get_allocator());
  Array<dsw_volume_id> invalid(record.invalid.get_allocator());
  Halving halving;
  for (double way = 1;;) {
    record.clear();
    all.save(whole);
    const Went went = try_way(way);
    if (went == Went::kThrough) {
      if (way != 1) record.contacts.swap(contacts);
      if (!invalid.empty()) record.invalid.swap(invalid);
      record.fraction = way;
      return true;
    }
    take_back();
    all.restore();
    if (went == Went::kRefused || way == 0) {
      record.contacts.clear();
      record.pushed = 0;
      record.fraction = 0;
      record.outcome = DSW_DEFORM_REFUSED;
      return false;
    }
    contacts.swap(record.contacts);
    invalid.swap(record.invalid);
    way = went != Went::kLimited && halving.next() ? halving.way : 0;
  }
}

}  // namespace dsw
