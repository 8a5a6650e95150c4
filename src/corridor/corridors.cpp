#include "corridor/corridors.h"

namespace dsw {

template <int D>
Corridors<D>::Corridors(const Corridors& other) : at_(other.at_.get_allocator()), common_(other.common_) {
  at_.resize(other.size(), common_.data());
  try {
    for (size_t e = 0; e < other.size(); ++e) {
      at_[e] = other.is_common(other.at_[e]) ? common_.data() + (other.at_[e] - other.common_.data())
                                             : copy_of(*other.at_[e]);
    }
  } catch (...) {
    release(0);
    throw;
  }
}

template <int D>
void Corridors<D>::resize(size_t count) {
  if (common_.empty() && count != 0) {
    Array<Corridor<D>> made(2, Corridor<D>(at_.get_allocator()), at_.get_allocator());
    made[1].forget();
    common_.swap(made);
  }
  if (count < size()) release(count);
  at_.resize(count, common_.data());
}

template <int D>
uint64_t Corridors<D>::memory_bytes() const noexcept {
  const auto of_arrays = [](const Corridor<D>& each) {
    return array_bytes(each.facets) + array_bytes(each.kept) + each.rows.memory_bytes();
  };
  uint64_t bytes = array_bytes(at_) + array_bytes(common_);
  for (const Corridor<D>& each : common_) bytes += of_arrays(each);
  for (const Corridor<D>* each : at_) {
    if (!is_common(each)) bytes += sizeof *each + of_arrays(*each);
  }
  return bytes;
}

template <int D>
Corridor<D>& Corridors<D>::make(size_t edge, uint64_t version) {
  Corridor<D>* const made = copy_of(*at_[edge]);
  if (made->facets.empty()) made->portal.version = version;
  at_[edge] = made;
  return *made;
}

template <int D>
Corridor<D>* Corridors<D>::copy_of(const Corridor<D>& corridor) const {
  Allocator<Corridor<D>> allocator(at_.get_allocator());
  Corridor<D>* const place = allocator.allocate(1);
  try {
    return ::new (static_cast<void*>(place)) Corridor<D>(corridor);
  } catch (...) {
    allocator.deallocate(place, 1);
    throw;
  }
}

/** Lets the corridors from edge `from` on be empty. */
template <int D>
void Corridors<D>::release(size_t from) noexcept {
  Allocator<Corridor<D>> allocator(at_.get_allocator());
  for (size_t e = from; e < size(); ++e) {
    if (is_common(at_[e])) continue;
    at_[e]->~Corridor();
    allocator.deallocate(at_[e], 1);
    at_[e] = common_.data();
  }
}

template class Corridors<2>;
template class Corridors<3>;

}  // namespace dsw
