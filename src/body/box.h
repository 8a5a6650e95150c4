#pragma once
// An axis-parallel box that grows. It is closed, so that what lies apart from it stays apart whatever the shift.

namespace dsw {

struct Box {
  double lower[3], upper[3];

  Box() noexcept;
  static Box everything() noexcept;
  void add(const double* point) noexcept;
  void add(const Box& other) noexcept {
    add(other.lower);
    add(other.upper);
  }
  bool empty() const noexcept { return !(lower[0] <= upper[0]); }
  bool contains(const double* point) const noexcept;
  bool overlaps(const Box& other) const noexcept;
  /** Whether it overlaps the box of these points. */
  bool overlaps(const double* const* points, int count) const noexcept;
};

}  // namespace dsw
