#pragma once
// A tuple as an aggregate. It takes a small part of the compile time of std::tuple, which checks what it is made from.

#include <cstddef>
#include <utility>

namespace dsw::capi {

/** The element of a pack at a position. */
template <size_t I, class T>
struct Slot {
  T value;
};
template <size_t I, class T>
constexpr T& get(Slot<I, T>& slot) {
  return slot.value;
}
template <size_t I, class T>
constexpr const T& get(const Slot<I, T>& slot) {
  return slot.value;
}

template <class Positions, class... All>
struct Slots;
template <size_t... I, class... All>
struct Slots<std::index_sequence<I...>, All...> : Slot<I, All>... {
  static constexpr size_t size = sizeof...(All);

  /** Returns use(each...) of all elements. */
  template <class Use>
  constexpr auto apply(const Use& use) const {
    return use(get<I>(*this)...);
  }
  /** Calls use(each) for all elements. */
  template <class Use>
  constexpr void for_each([[maybe_unused]] const Use& use) const {
    (use(get<I>(*this)), ...);
  }
};
template <class... All>
using Pack = Slots<std::index_sequence_for<All...>, All...>;

template <class... All>
constexpr Pack<All...> pack(All... all) {
  return {{all}...};
}

}  // namespace dsw::capi
