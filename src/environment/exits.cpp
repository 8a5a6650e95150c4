#include "environment/exits.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace dsw {

/** The first exit that is not before a facet. */
size_t Exits::find(uint32_t cell, uint32_t local) const noexcept {
  return static_cast<size_t>(std::lower_bound(all_.begin(), all_.end(), Exit{cell, local, 0}) - all_.begin());
}

uint32_t Exits::patch(uint32_t cell, uint32_t local) const noexcept {
  const size_t at = find(cell, local);
  return at != all_.size() && all_[at].cell == cell && all_[at].local == local ? all_[at].patch : 0;
}

bool Exits::has_cell(uint32_t cell) const noexcept {
  const size_t at = find(cell, 0);
  return at != all_.size() && all_[at].cell == cell;
}

void Exits::set(const Exit* exits, size_t count) noexcept {
  const auto end = static_cast<ptrdiff_t>(all_.size());
  for (size_t i = 0; i < count; ++i) {
    // Exits before `end` are sorted; new ones come behind them.
    const auto at = std::lower_bound(all_.begin(), all_.begin() + end, exits[i]);
    if (at != all_.begin() + end && !(exits[i] < *at)) {
      at->patch = exits[i].patch;
    } else if (exits[i].patch != 0) {
      all_.push_back(exits[i]);
    }
  }
  remove_if([](const Exit& exit) { return exit.patch == 0; });
  dsw::sort(all_.begin(), all_.end());
  const auto is_same = [](const Exit& a, const Exit& b) { return !(a < b); };
  all_.erase(std::unique(all_.begin(), all_.end(), is_same), all_.end());
}

bool Exits::restore(Array<Exit>&& exits) noexcept {
  for (size_t i = 0; i < exits.size(); ++i) {
    if (exits[i].patch == 0 || (i != 0 && !(exits[i - 1] < exits[i]))) return false;
  }
  all_ = std::move(exits);
  return true;
}

}  // namespace dsw
