#pragma once
// Searches in a range. Those of the standard library are unrolled, and hold seven copies of what they are given.

namespace dsw {

template <class It, class Predicate>
inline It find_if(It first, It last, Predicate holds) {
  while (first != last && !holds(*first)) ++first;
  return first;
}
template <class It, class Value>
inline It find(It first, It last, const Value& value) {
  while (first != last && !(*first == value)) ++first;
  return first;
}
template <class It, class Predicate>
inline bool any_of(It first, It last, Predicate holds) {
  for (; first != last; ++first) {
    if (holds(*first)) return true;
  }
  return false;
}
template <class It, class Predicate>
inline bool none_of(It first, It last, Predicate holds) {
  return !dsw::any_of(first, last, holds);
}
template <class It, class Predicate>
inline bool all_of(It first, It last, Predicate holds) {
  for (; first != last; ++first) {
    if (!holds(*first)) return false;
  }
  return true;
}

}  // namespace dsw
