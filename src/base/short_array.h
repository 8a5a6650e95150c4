#pragma once
// An array of few numbers, which lie in place: only one that grows beyond takes memory. Otherwise as Array.

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <utility>

#include "base/memory.h"

namespace dsw {

template <class T, uint32_t N>
class ShortArray {
  static_assert(std::is_trivially_copyable<T>::value, "elements are copied as bytes");

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  ShortArray(Allocator<T> allocator) : allocator_(allocator) {}
  ShortArray(const Memory* memory) : allocator_(memory) {}
  ShortArray(const ShortArray& other) : allocator_(other.allocator_) { assign(other.begin(), other.end()); }
  ShortArray(ShortArray&& other) noexcept : allocator_(other.allocator_) { take(other); }
  /** The memory of an array is that of its first value. */
  ShortArray& operator=(const ShortArray& other) {
    if (this != &other) assign(other.begin(), other.end());
    return *this;
  }
  ShortArray& operator=(ShortArray&& other) noexcept {
    if (this == &other) return *this;
    release();
    allocator_ = other.allocator_;
    take(other);
    return *this;
  }
  ~ShortArray() { release(); }

  Allocator<T> get_allocator() const { return allocator_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  const T& back() const { return data_[size_ - 1]; }
  bool operator==(const ShortArray& o) const { return std::equal(begin(), end(), o.begin(), o.end()); }
  bool operator<(const ShortArray& o) const { return std::lexicographical_compare(begin(), end(), o.begin(), o.end()); }

  void reserve(size_t count) {
    if (count > room_) grow(count);
  }
  void clear() { size_ = 0; }
  void resize(size_t count) {
    reserve(count);
    if (count > size_) std::fill(data_ + size_, data_ + count, T{});
    size_ = static_cast<uint32_t>(count);
  }
  void push_back(T value) {
    if (size_ == room_) grow(size_t{size_} + 1);
    data_[size_++] = value;
  }
  void pop_back() { --size_; }
  void assign(const T* first, const T* last) {
    clear();
    append(first, last);
  }
  void assign(size_t count, T value) {
    clear();
    reserve(count);
    std::fill_n(data_, count, value);
    size_ = static_cast<uint32_t>(count);
  }
  void assign(std::initializer_list<T> values) { assign(values.begin(), values.end()); }
  /** Adds what is not of this array. */
  void append(const T* first, const T* last) { std::copy(first, last, extend(static_cast<size_t>(last - first))); }
  /** Adds elements, which have to be written. */
  T* extend(size_t count) {
    reserve(size_ + count);
    T* const added = end();
    size_ += static_cast<uint32_t>(count);
    return added;
  }
  void insert(const T* before, T value) {
    const auto at = before - data_;
    push_back(value);
    std::rotate(begin() + at, end() - 1, end());
  }
  void erase(T* first, T* last) { size_ = static_cast<uint32_t>(std::move(last, end(), first) - data_); }
  void erase(T* at) { erase(at, at + 1); }

 private:
  void grow(size_t count) {
    const size_t room = std::max(count, 2 * size_t{room_});
    T* const block = allocator_.allocate(room);
    std::copy(begin(), end(), block);
    release();
    data_ = block;
    room_ = static_cast<uint32_t>(room);
  }
  void release() noexcept {
    if (data_ != few_) allocator_.deallocate(data_, room_);
  }
  /** What another one has, which is empty then; this one holds no memory. */
  void take(ShortArray& other) noexcept {
    size_ = other.size_;
    if (other.data_ == other.few_) {
      data_ = few_;
      room_ = N;
      std::copy_n(other.few_, size_, few_);
    } else {
      data_ = other.data_;
      room_ = other.room_;
      other.data_ = other.few_;
      other.room_ = N;
    }
    other.size_ = 0;
  }

  T* data_ = few_;
  uint32_t size_ = 0, room_ = N;
  Allocator<T> allocator_;
  T few_[N];
};

}  // namespace dsw
