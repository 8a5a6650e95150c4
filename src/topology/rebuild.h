#pragma once
// Private: the environment of merged cells.

#include "topology/merging.h"

namespace dsw {

/** Writes cells, links, labels and marks; `new_index` as for coarsen(). */
void rebuild(const Environment<3>& source, Merging& merging, Environment<3>& target, Array<uint32_t>& new_index);

}  // namespace dsw
