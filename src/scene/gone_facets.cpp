#include "scene/gone_facets.h"

#include "base/search.h"

namespace dsw {
namespace {

constexpr size_t kMostNoted = size_t{1} << 14;  // facets that are noted before all bodies are brought up to date

template <int D>
size_t facets_of(const Edit<D>& edit) noexcept {
  size_t count = edit.link_count();
  for (const Cell c : edit.removed()) count += edit.environment().map.facets_of(c);
  return count;
}

}  // namespace

template <int D>
bool GoneFacets<D>::is_full() const noexcept {
  return words_.size() > kMostNoted;
}

template <int D>
void GoneFacets<D>::clear() noexcept {
  words_.clear();
  last_.clear();
}

template <int D>
void GoneFacets<D>::reserve(const Edit<D>& edit) {
  const size_t count = facets_of(edit);
  words_.reserve(count);
  reserve_more(last_, count);
}

template <int D>
void GoneFacets<D>::note(const Edit<D>& edit) noexcept {
  const Map<D>& map = edit.environment().map;
  ++number_;
  const auto add = [&](HalfFacet h) {
    const uint32_t i = words_.insert(h.word);
    if (i == last_.size()) last_.push_back(0);
    last_[i] = number_;
  };
  for (const Cell c : edit.removed()) {
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) add(map.half_facet(c, f));
  }
  for (size_t i = 0; i < edit.link_count(); ++i) add(edit.link(i));
}

template <int D>
bool GoneFacets<D>::are_in(const Corridor<D>& corridor, uint64_t since) const noexcept {
  return dsw::any_of(corridor.facets.begin(), corridor.facets.end(), [&](uint32_t word) {
    const uint32_t i = words_.find(word);
    return i != KeyTable::kNone && last_[i] > since;
  });
}

template class GoneFacets<2>;
template class GoneFacets<3>;

}  // namespace dsw
