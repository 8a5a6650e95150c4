#pragma once
// The container of the library: what std::vector is, with elements that are moved as bytes by one function for all types.
// A vector is half of what the compiler reads and optimizes in most sources; this takes a fraction of that time.

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/allocator.h"

namespace dsw {

/** A block of elements: which bytes of it are used, and where it comes from. */
struct ArrayBlock {
  const Memory* memory = nullptr;
  char *first = nullptr, *last = nullptr, *limit = nullptr;

  size_t used() const noexcept { return static_cast<size_t>(last - first); }
  size_t room() const noexcept { return static_cast<size_t>(limit - first); }
};

// These throw std::bad_alloc, and std::length_error for more bytes than there are addresses.
/** Twice the `count`, or as many as are needed for `more`. */
size_t grown_count(size_t count, size_t more, size_t element_bytes);
/** The same bytes in another block, which has room for `count` elements. */
void move_block(ArrayBlock& array, size_t count, size_t element_bytes);
/** A larger block, with room for `more` elements. */
void grow_block(ArrayBlock& array, size_t more, size_t element_bytes);
void release_block(const ArrayBlock& array) noexcept;

template <class T>
class Array : private ArrayBlock {
  static constexpr bool kAreBytes = std::is_trivially_copyable_v<T>;
  template <class I>
  using IfIterator = typename std::iterator_traits<I>::iterator_category;

 public:
  using value_type = T;
  using size_type = size_t;
  using difference_type = std::ptrdiff_t;
  using reference = T&;
  using const_reference = const T&;
  using pointer = T*;
  using const_pointer = const T*;
  using iterator = T*;
  using const_iterator = const T*;
  using allocator_type = Allocator<T>;

  Array() noexcept = default;
  explicit Array(Allocator<T> allocator) noexcept { memory = allocator.memory; }
  explicit Array(size_t count, Allocator<T> allocator = {}) : Array(allocator) {
    take_room(count);
    append_values(count);
  }
  Array(size_t count, const T& value, Allocator<T> allocator = {}) : Array(allocator) {
    take_room(count);
    append_copies(count, value);
  }
  template <class I, class = IfIterator<I>>
  Array(I from, I to, Allocator<T> allocator = {}) : Array(allocator) {
    take_room(static_cast<size_t>(std::distance(from, to)));
    append(from, to);
  }
  Array(std::initializer_list<T> values, Allocator<T> allocator = {})
      : Array(values.begin(), values.end(), allocator) {}
  Array(const Array& other) : Array(other.begin(), other.end(), other.get_allocator()) {}
  Array(const Array& other, Allocator<T> allocator) : Array(other.begin(), other.end(), allocator) {}
  Array(Array&& other) noexcept : ArrayBlock(other) { other.first = other.last = other.limit = nullptr; }
  /** The memory of an array is that of its first value. */
  Array& operator=(const Array& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  Array& operator=(Array&& other) noexcept {
    Array taken(std::move(other));
    swap(taken);
    return *this;
  }
  Array& operator=(std::initializer_list<T> values) {
    assign(values.begin(), values.end());
    return *this;
  }
  ~Array() { release(); }

  Allocator<T> get_allocator() const noexcept { return Allocator<T>(memory); }
  size_t size() const noexcept { return static_cast<size_t>(end() - begin()); }
  size_t capacity() const noexcept { return room() / sizeof(T); }
  static constexpr size_t max_size() noexcept { return SIZE_MAX / 2 / sizeof(T); }
  bool empty() const noexcept { return first == last; }
  T* data() noexcept { return begin(); }
  const T* data() const noexcept { return begin(); }
  T* begin() noexcept { return reinterpret_cast<T*>(first); }
  T* end() noexcept { return reinterpret_cast<T*>(last); }
  const T* begin() const noexcept { return reinterpret_cast<const T*>(first); }
  const T* end() const noexcept { return reinterpret_cast<const T*>(last); }
  const T* cbegin() const noexcept { return begin(); }
  const T* cend() const noexcept { return end(); }
  auto rbegin() noexcept { return std::make_reverse_iterator(end()); }
  auto rend() noexcept { return std::make_reverse_iterator(begin()); }
  auto rbegin() const noexcept { return std::make_reverse_iterator(end()); }
  auto rend() const noexcept { return std::make_reverse_iterator(begin()); }
  T& operator[](size_t i) noexcept { return begin()[i]; }
  const T& operator[](size_t i) const noexcept { return begin()[i]; }
  T& front() noexcept { return *begin(); }
  const T& front() const noexcept { return *begin(); }
  T& back() noexcept { return end()[-1]; }
  const T& back() const noexcept { return end()[-1]; }

  void swap(Array& other) noexcept { std::swap<ArrayBlock>(*this, other); }
  void clear() noexcept { cut(begin()); }
  void pop_back() noexcept { cut(end() - 1); }
  void reserve(size_t count) {
    if (count > capacity()) move_to(count);
  }
  /** If memory runs out the array keeps its room. */
  void shrink_to_fit() {
    if (last == limit) return;
    try {
      Array(std::make_move_iterator(begin()), std::make_move_iterator(end()), get_allocator()).swap(*this);
    } catch (const std::bad_alloc&) {
    }
  }
  void resize(size_t count) {
    if (count <= size()) return cut(begin() + count);
    make_room(count - size());
    append_values(count - size());
  }
  void resize(size_t count, const T& value) {
    if (count <= size()) return cut(begin() + count);
    const T kept(value);
    make_room(count - size());
    append_copies(count - size(), kept);
  }
  void assign(size_t count, const T& value) {
    const T kept(value);
    start_again(count);
    append_copies(count, kept);
  }
  /** Of values that are not in the array. Elements that are not bytes keep what they hold, and take the values. */
  template <class I, class = IfIterator<I>>
  void assign(I from, I to) {
    const auto count = static_cast<size_t>(std::distance(from, to));
    if constexpr (kAreBytes) {
      start_again(count);
    } else if (count > capacity()) {
      start_again(count);
    } else {
      const size_t common = std::min(size(), count);
      cut(begin() + common);
      for (T& element : *this) element = *from++;
    }
    append(from, to);
  }
  void assign(std::initializer_list<T> values) { assign(values.begin(), values.end()); }

  void push_back(const T& value) { emplace_back(value); }
  void push_back(T&& value) { emplace_back(std::move(value)); }
  template <class... Arguments>
  T& emplace_back(Arguments&&... arguments) {
    if (last == limit) {
      T made(std::forward<Arguments>(arguments)...);  // which may refer to an element
      make_room(1);
      return add(std::move(made));
    }
    return add(std::forward<Arguments>(arguments)...);
  }
  /** Of values that are not in the array. */
  template <class I, class = IfIterator<I>>
  T* insert(const T* before, I from, I to) {
    const auto at = before - begin();
    const size_t old = size(), count = static_cast<size_t>(std::distance(from, to));
    make_room(count);
    append(from, to);
    return turn(at, old);
  }
  T* insert(const T* before, std::initializer_list<T> values) { return insert(before, values.begin(), values.end()); }
  T* insert(const T* before, size_t count, const T& value) {
    const auto at = before - begin();
    const size_t old = size();
    const T kept(value);
    make_room(count);
    append_copies(count, kept);
    return turn(at, old);
  }
  T* insert(const T* before, const T& value) { return insert(before, size_t{1}, value); }
  T* erase(const T* from, const T* to) noexcept {
    T* const at = begin() + (from - begin());
    if (from != to) cut(std::move(begin() + (to - begin()), end(), at));
    return at;
  }
  T* erase(const T* at) noexcept { return erase(at, at + 1); }

  friend bool operator==(const Array& a, const Array& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }
  friend bool operator!=(const Array& a, const Array& b) { return !(a == b); }
  friend bool operator<(const Array& a, const Array& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }
  friend void swap(Array& a, Array& b) noexcept { a.swap(b); }

 private:
  /** Where there is room. */
  template <class... Arguments>
  T& add(Arguments&&... arguments) {
    T* const made = new (static_cast<void*>(last)) T(std::forward<Arguments>(arguments)...);
    last += sizeof(T);
    return *made;
  }
  template <class I>
  void append(I from, I to) {
    end_at(std::uninitialized_copy(from, to, end()));
  }
  void append_values(size_t count) { end_at(std::uninitialized_value_construct_n(end(), count)); }
  void append_copies(size_t count, const T& value) { end_at(std::uninitialized_fill_n(end(), count, value)); }
  void end_at(T* at) noexcept { last = reinterpret_cast<char*>(at); }
  /** Elements from here on go. */
  void cut(T* from) noexcept {
    if constexpr (!std::is_trivially_destructible_v<T>) {
      for (T* at = from; at != end(); ++at) at->~T();
    }
    end_at(from);
  }
  void release() noexcept {
    if (first == nullptr) return;
    clear();
    release_block(*this);
  }
  /** For an array that has no block. */
  void take_room(size_t count) {
    if (count != 0) move_block(*this, count, sizeof(T));
  }
  /** Empty, with room for so many, in another block if the one that there is has less. */
  void start_again(size_t count) {
    if (count <= capacity()) return clear();
    Array fresh(get_allocator());
    fresh.take_room(count);
    swap(fresh);
  }
  void make_room(size_t more) {
    if (more * sizeof(T) <= static_cast<size_t>(limit - last)) return;
    if constexpr (kAreBytes) {
      grow_block(*this, more, sizeof(T));
    } else {
      move_to(grown_count(size(), more, sizeof(T)));
    }
  }
  void move_to(size_t count) {
    if constexpr (kAreBytes) {
      move_block(*this, count, sizeof(T));
    } else {
      static_assert(std::is_nothrow_move_constructible_v<T>, "elements move where the array grows");
      Array fresh(get_allocator());
      fresh.take_room(count);
      for (T& element : *this) fresh.add(std::move(element));
      swap(fresh);
    }
  }
  /** Elements from `old` on come before those from `at` on. */
  T* turn(std::ptrdiff_t at, size_t old) {
    if (static_cast<size_t>(at) != old) std::rotate(begin() + at, begin() + old, end());
    return begin() + at;
  }
};

/** Bits. */
template <>
class Array<bool> : public std::vector<bool, Allocator<bool>> {
 public:
  using vector::vector;
};

template <class T>
uint64_t array_bytes(const Array<T>& array) {
  return static_cast<uint64_t>(array.capacity()) * sizeof(T);
}

}  // namespace dsw
