#pragma once
// Memory through the host's hooks: an allocator, and the array that every container of the library uses.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/compiler.h"
#include "dartsweep/context.h"

namespace dsw {

/** Where memory comes from. Lives in the context; a null pointer to it means the C++ runtime. */
struct Memory {
  void* user = nullptr;
  dsw_allocate_fn allocate = nullptr;
  dsw_release_fn release = nullptr;
};

/** Blocks for small objects start at multiples of this. Every type's alignment divides it. */
constexpr size_t kBlockAlignment = alignof(std::max_align_t) > 16 ? alignof(std::max_align_t) : 16;

/** Throws std::bad_alloc when the hook returns null. */
void* allocate_bytes(const Memory* memory, size_t size_bytes, size_t alignment_bytes);
void release_bytes(const Memory* memory, void* block, size_t size_bytes, size_t alignment_bytes) noexcept;

/** Blocks of a page and more start on a cache line, so that records of 32 and 64 bytes never straddle two. */
constexpr size_t block_alignment(size_t bytes) { return bytes >= 4096 ? 64 : kBlockAlignment; }

template <class T>
struct Allocator {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  const Memory* memory = nullptr;

  Allocator() = default;
  Allocator(const Memory* source) : memory(source) {}
  template <class U>
  Allocator(const Allocator<U>& other) : memory(other.memory) {}

  T* allocate(size_t count) {
    static_assert(alignof(T) <= kBlockAlignment, "small blocks are aligned like this");
    if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
    const size_t bytes = count * sizeof(T);
    return static_cast<T*>(allocate_bytes(memory, bytes, block_alignment(bytes)));
  }
  void deallocate(T* block, size_t count) noexcept {
    const size_t bytes = count * sizeof(T);
    release_bytes(memory, block, bytes, block_alignment(bytes));
  }
  template <class U>
  bool operator==(const Allocator<U>& other) const {
    return memory == other.memory;
  }
  template <class U>
  bool operator!=(const Allocator<U>& other) const {
    return memory != other.memory;
  }
};

/** Memory for `count` elements. Throws std::bad_alloc. */
void* allocate_elements(const Memory* memory, size_t count, size_t element_bytes);
/** The room of an array of `size` elements that grows by `more`: at least twice as much. Throws std::bad_alloc. */
size_t grown_room(size_t size, size_t more, size_t element_bytes);

/** What an array of elements that are plain bytes does to make room, the same code for all of them. Throws std::bad_alloc and changes
 * nothing. */
class ByteArray {
 protected:
  ByteArray() = default;
  explicit ByteArray(const Memory* memory) : memory_(memory) {}
  ByteArray(const ByteArray&) = default;
  ByteArray& operator=(const ByteArray&) = default;
  ~ByteArray() = default;

  size_t size_bytes() const { return static_cast<size_t>(static_cast<char*>(last_) - static_cast<char*>(first_)); }
  size_t room_bytes() const { return static_cast<size_t>(static_cast<char*>(room_) - static_cast<char*>(first_)); }
  /** Gives the block back, if there is one, and points to it still. A call takes half the code of what it does. */
  void release_block() noexcept;
  /** Moves to a block of so many elements, with the first `kept_bytes`. */
  void move_bytes(size_t room, size_t kept_bytes, size_t element_bytes);
  /** Makes room for `more` elements. */
  void grow_bytes(size_t more, size_t element_bytes);
  /** Makes room, and adds an element. @return where. */
  void* push_bytes(const void* element, size_t element_bytes);

  void* first_ = nullptr;
  void* last_ = nullptr;
  void* room_ = nullptr;
  const Memory* memory_ = nullptr;
};

/**
 * Does what std::vector does with an Allocator, in less code: several hundred types had a copy each of what makes room, and
 * compiling them took a fifth of the time of some modules. Iterators are pointers. If memory runs out for elements that are
 * added, the array keeps those that it had.
 */
template <class T>
class Array : private ByteArray {
  static constexpr bool kIsBytes = std::is_trivially_copyable_v<T>;
  template <class It>
  using IfIterator = typename std::iterator_traits<It>::iterator_category;

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

  Array() = default;
  explicit Array(const Allocator<T>& allocator) : ByteArray(allocator.memory) {}
  explicit Array(size_t count, const Allocator<T>& allocator = {}) : Array(allocator) { resize(count); }
  Array(size_t count, const T& value, const Allocator<T>& allocator = {}) : Array(allocator) { assign(count, value); }
  template <class It, class = IfIterator<It>>
  Array(It first, It last, const Allocator<T>& allocator = {}) : Array(allocator) {
    assign(first, last);
  }
  Array(std::initializer_list<T> values, const Allocator<T>& allocator = {}) : Array(allocator) {
    assign(values.begin(), values.end());
  }
  Array(const Array& other) : Array(other, Allocator<T>(other.memory_)) {}
  Array(const Array& other, const Allocator<T>& allocator) : Array(allocator) { assign(other.begin(), other.end()); }
  Array(Array&& other) noexcept : ByteArray(other) { other.first_ = other.last_ = other.room_ = nullptr; }
  ~Array() { drop(); }

  /** Keeps its own memory, as a vector does. */
  Array& operator=(const Array& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  Array& operator=(Array&& other) noexcept {
    if (this == &other) return *this;
    drop();
    ByteArray::operator=(other);
    other.first_ = other.last_ = other.room_ = nullptr;
    return *this;
  }
  Array& operator=(std::initializer_list<T> values) {
    assign(values.begin(), values.end());
    return *this;
  }
  void swap(Array& other) noexcept {
    std::swap(first_, other.first_);
    std::swap(last_, other.last_);
    std::swap(room_, other.room_);
    std::swap(memory_, other.memory_);
  }
  friend void swap(Array& a, Array& b) noexcept { a.swap(b); }

  Allocator<T> get_allocator() const { return memory_; }
  size_t size() const { return static_cast<size_t>(end() - begin()); }
  size_t capacity() const { return static_cast<size_t>(static_cast<T*>(room_) - begin()); }
  static constexpr size_t max_size() { return static_cast<size_t>(PTRDIFF_MAX) / sizeof(T); }
  bool empty() const { return first_ == last_; }

  T* data() { return static_cast<T*>(first_); }
  const T* data() const { return static_cast<T*>(first_); }
  T* begin() { return static_cast<T*>(first_); }
  const T* begin() const { return static_cast<T*>(first_); }
  T* end() { return static_cast<T*>(last_); }
  const T* end() const { return static_cast<T*>(last_); }
  T& operator[](size_t i) { return begin()[i]; }
  const T& operator[](size_t i) const { return begin()[i]; }
  T& front() { return *begin(); }
  const T& front() const { return *begin(); }
  T& back() { return end()[-1]; }
  const T& back() const { return end()[-1]; }

  void clear() { destroy_from(begin()); }
  void pop_back() { destroy_from(end() - 1); }
  void reserve(size_t count) {
    if (count > capacity()) set_room(count);
  }
  /** Where memory runs out nothing changes. */
  void shrink_to_fit() {
    if (last_ == room_) return;
    if (empty()) return Array(get_allocator()).swap(*this);
    try {
      set_room(size());
    } catch (const std::bad_alloc&) {
    }
  }
  void resize(size_t count) {
    if (count < size()) return destroy_from(begin() + count);
    if (count > capacity()) grow(count - size());
    append_each(count - size(), [](void* place) { ::new (place) T(); });
  }
  void resize(size_t count, const T& value) {
    if (count < size()) return destroy_from(begin() + count);
    append_copies(count - size(), value);
  }

  void push_back(const T& value) {
    if (last_ == room_) return push_grown(T(value)), void();
    ::new (last_) T(value);
    last_ = end() + 1;
  }
  void push_back(T&& value) { emplace_back(std::move(value)); }
  template <class... Arguments>
  T& emplace_back(Arguments&&... arguments) {
    if (last_ == room_) return push_grown(T(std::forward<Arguments>(arguments)...));
    T* const place = ::new (last_) T(std::forward<Arguments>(arguments)...);
    last_ = place + 1;
    return *place;
  }

  void assign(size_t count, const T& value) {
    const T kept(value);  // it may be an element
    if (count > capacity()) {
      if constexpr (kIsBytes) {
        move_bytes(count, 0, sizeof(T));
      } else {
        Array other(get_allocator());
        other.set_room(count);
        other.append_copies(count, kept);
        return swap(other);
      }
    }
    clear();
    append_copies(count, kept);
  }
  template <class It, class = IfIterator<It>>
  void assign(It first, It last) {
    const size_t count = static_cast<size_t>(std::distance(first, last));
    if constexpr (std::is_convertible_v<It, const T*> && kIsBytes) {
      if (count > capacity()) move_bytes(count, 0, sizeof(T));  // so it is no part of this array
      if (count != 0) std::memmove(first_, first, count * sizeof(T));
      last_ = begin() + count;
    } else if (count > capacity()) {
      Array other(get_allocator());
      other.set_room(count);
      other.append(first, count);
      swap(other);
    } else {  // what elements own is used again
      T* to = begin();
      for (; to != last_ && first != last; ++to, ++first) *to = *first;
      destroy_from(to);
      append(first, count - static_cast<size_t>(to - begin()));
    }
  }
  void assign(std::initializer_list<T> values) { assign(values.begin(), values.end()); }

  T* insert(const T* place, const T& value) {
    const T kept(value);
    return insert(place, &kept, &kept + 1);
  }
  T* insert(const T* place, std::initializer_list<T> values) { return insert(place, values.begin(), values.end()); }
  T* insert(const T* place, size_t count, const T& value) {
    const size_t at = static_cast<size_t>(place - begin()), before = size();
    append_copies(count, value);
    return rotate(at, before);
  }
  /** What is inserted is no part of this array. */
  template <class It, class = IfIterator<It>>
  T* insert(const T* place, It first, It last) {
    const size_t at = static_cast<size_t>(place - begin()), before = size();
    const size_t count = static_cast<size_t>(std::distance(first, last));
    if (count > capacity() - before) grow(count);
    append(first, count);
    return rotate(at, before);
  }
  T* erase(const T* place) { return erase(place, place + 1); }
  T* erase(const T* first, const T* last) {
    T* const at = begin() + (first - begin());
    if (first != last) destroy_from(move_down(at, begin() + (last - begin()), end()));
    return at;
  }

  friend bool operator==(const Array& a, const Array& b) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i) {
      if (!(a[i] == b[i])) return false;
    }
    return true;
  }
  friend bool operator!=(const Array& a, const Array& b) { return !(a == b); }

 private:
  void destroy_from(T* place) {
    if constexpr (!std::is_trivially_destructible_v<T>) {
      while (last_ != place) {
        T* const gone = end() - 1;
        last_ = gone;
        gone->~T();
      }
    } else {
      last_ = place;
    }
  }
  void drop() {
    if constexpr (!std::is_trivially_destructible_v<T>) destroy_from(begin());
    release_block();
  }
  /** The end of what has been moved. */
  static T* move_down(T* to, T* first, T* last) {
    if constexpr (kIsBytes) {
      const size_t count = static_cast<size_t>(last - first);
      if (count != 0) std::memmove(static_cast<void*>(to), first, count * sizeof(T));
      return to + count;
    } else {
      for (; first != last; ++first, ++to) *to = std::move(*first);
      return to;
    }
  }

  void grow(size_t more) {
    if constexpr (kIsBytes) {
      grow_bytes(more, sizeof(T));
    } else {
      set_room(grown_room(size(), more, sizeof(T)));
    }
  }
  /** Moves to a block of so many elements, which has room for all. */
  void set_room(size_t room) {
    if constexpr (kIsBytes) {
      move_bytes(room, size_bytes(), sizeof(T));
    } else {
      move_elements(room);
    }
  }
  DSW_COLD void move_elements(size_t room) {
    static_assert(std::is_nothrow_move_constructible_v<T>, "an array that can't grow stays as it was");
    const size_t count = size();
    T* const block = static_cast<T*>(allocate_elements(memory_, room, sizeof(T)));
    for (size_t i = 0; i < count; ++i) ::new (static_cast<void*>(block + i)) T(std::move(begin()[i]));
    drop();
    first_ = block;
    last_ = block + count;
    room_ = block + room;
  }
  T& push_grown(T&& value) {
    if constexpr (kIsBytes) {
      return *static_cast<T*>(push_bytes(&value, sizeof(T)));
    } else {
      return push_moved(std::move(value));
    }
  }
  DSW_COLD T& push_moved(T&& value) {
    move_elements(grown_room(size(), 1, sizeof(T)));
    T* const place = ::new (last_) T(std::move(value));
    last_ = place + 1;
    return *place;
  }
  /** There is room. */
  template <class It>
  void append(It first, size_t count) {
    if constexpr (std::is_convertible_v<It, const T*> && kIsBytes) {
      if (count != 0) std::memcpy(last_, first, count * sizeof(T));
      last_ = end() + count;
    } else {
      append_each(count, [&](void* place) { ::new (place) T(*first), ++first; });
    }
  }
  template <class Make>
  void append_each(size_t count, Make make) {
    if constexpr (kIsBytes) {  // a loop that the compiler knows
      T* place = end();
      for (T* const behind = place + count; place != behind; ++place) make(place);
      last_ = place;
    } else {
      const size_t before = size();
      try {
        for (; count != 0; --count, last_ = end() + 1) make(last_);
      } catch (...) {
        destroy_from(begin() + before);
        throw;
      }
    }
  }
  void append_copies(size_t count, const T& value) {
    const T kept(value);
    if (count > capacity() - size()) grow(count);
    append_each(count, [&](void* place) { ::new (place) T(kept); });
  }
  /** Takes the elements from `before` on to `at`; returns where they are. */
  T* rotate(size_t at, size_t before) {
    T* const place = begin() + at;
    if (at != before) reverse(place, begin() + before), reverse(begin() + before, end()), reverse(place, end());
    return place;
  }
  static void reverse(T* first, T* last) {
    while (first < last && first < --last) {
      using std::swap;
      swap(*first++, *last);
    }
  }
};

/** One bit each. */
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
