// Triangles side by side, one in each lane: the operations of `missed_triangles` in the same order, so the same bits.
// Included once for each instruction set, whose `Lanes` is a type of its own.

namespace dsw {

template <class Lanes>
class ShearLanes {
 public:
  explicit ShearLanes(Shear& shear) noexcept
      : shear_(shear), slope_i_(Lanes::all(shear.slopes_[0])), slope_j_(Lanes::all(shear.slopes_[1])) {}

  uint64_t missed(const FacetSpan<3>& triangles) noexcept {
    const size_t count = triangles.size();
    const Corner corners[3] = {corner(triangles, 0), corner(triangles, 1), corner(triangles, 2)};
    if (count < Lanes::kCount) return some_missed(corners, count);
    Vector largest = Lanes::all(shear_.largest_), lowest = Lanes::all(shear_.lowest_);
    uint64_t missed = 0;
    for (size_t next = 0; next < count; next += Lanes::kCount) {
      const size_t n = std::min(next, count - Lanes::kCount);  // the last ones may have been passed in part
      const Points a = read(corners[0], n), b = read(corners[1], n), c = read(corners[2], n);
      const Vector sides = least_side(a, b, c);
      missed |= uint64_t{Lanes::not_positive(sides)} << n;
      largest = Lanes::max(largest, largest_of(a, b, c));
      lowest = Lanes::min(lowest, Lanes::positive_or(sides, lowest));
    }
    shear_.largest_ = Lanes::largest(largest);
    shear_.lowest_ = Lanes::lowest(lowest);
    return missed;
  }

  /** Tells what Shear::passed_all tells, after `missed` has found no triangle. In range no number is undefined. */
  bool pass_all(const FacetSpan<3>& triangles) const noexcept {
    const size_t count = triangles.size();
    const Corner corners[3] = {corner(triangles, 0), corner(triangles, 1), corner(triangles, 2)};
    Vector largest = Lanes::all(shear_.largest_), lowest = Lanes::all(shear_.lowest_);
    if (count < Lanes::kCount) {
      const auto these = Lanes::first(count);
      const Points a = read_some(corners[0], these), b = read_some(corners[1], these), c = read_some(corners[2], these);
      lowest = Lanes::choose(these, least_side(a, b, c), lowest);
      largest = Lanes::max(Lanes::choose(these, largest_of(a, b, c), largest), largest);
    } else {
      for (size_t next = 0; next < count; next += Lanes::kCount) {
        const size_t n = std::min(next, count - Lanes::kCount);
        const Points a = read(corners[0], n), b = read(corners[1], n), c = read(corners[2], n);
        lowest = Lanes::min(lowest, least_side(a, b, c));
        largest = Lanes::max(largest, largest_of(a, b, c));
      }
    }
    const double most = Lanes::largest(largest);
    return shear_.is_in_range(most) && Lanes::lowest(lowest) > Shear::bound(most);
  }

 private:
  using Vector = typename Lanes::Vector;

  /** The rows of one corner, in the order of the shear's axes. */
  struct Corner {
    const double *i, *j, *k;
  };
  struct Points {
    Vector i, j, most;  // most: the largest component before the shear
  };

  Corner corner(const FacetSpan<3>& triangles, int n) const noexcept {
    return {triangles.row(n, shear_.i_), triangles.row(n, shear_.j_), triangles.row(n, shear_.k_)};
  }
  Points shear(Vector a, Vector b, Vector c) const noexcept {
    a = a - Lanes::all(shear_.p_[shear_.i_]);
    b = b - Lanes::all(shear_.p_[shear_.j_]);
    c = c - Lanes::all(shear_.p_[shear_.k_]);
    return {a - slope_i_ * c, b - slope_j_ * c,
            Lanes::max(Lanes::max(Lanes::absolute(a), Lanes::absolute(b)), Lanes::absolute(c))};
  }
  Points read(const Corner& corner, size_t n) const noexcept {
    return shear(Lanes::load(corner.i + n), Lanes::load(corner.j + n), Lanes::load(corner.k + n));
  }
  template <class Mask>
  Points read_some(const Corner& corner, Mask these) const noexcept {
    return shear(Lanes::load(corner.i, these), Lanes::load(corner.j, these), Lanes::load(corner.k, these));
  }
  /** Tests fewer triangles than there are lanes: the other lanes count as passed, by nothing. */
  uint64_t some_missed(const Corner (&corners)[3], size_t count) noexcept {
    const auto these = Lanes::first(count);
    const Points a = read_some(corners[0], these), b = read_some(corners[1], these), c = read_some(corners[2], these);
    const Vector none = Lanes::all(shear_.largest_), lowest = Lanes::all(shear_.lowest_);
    const Vector sides = Lanes::choose(these, least_side(a, b, c), lowest);
    const Vector most = Lanes::choose(these, largest_of(a, b, c), none);
    shear_.largest_ = Lanes::largest(Lanes::max(most, none));
    shear_.lowest_ = Lanes::lowest(Lanes::min(lowest, Lanes::positive_or(sides, lowest)));
    return Lanes::not_positive(sides) & ((1u << count) - 1);
  }
  static Vector side(const Points& a, const Points& b) noexcept { return a.i * b.j - a.j * b.i; }
  static Vector least_side(const Points& a, const Points& b, const Points& c) noexcept {
    return Lanes::min(Lanes::min(side(a, b), side(b, c)), side(c, a));
  }
  static Vector largest_of(const Points& a, const Points& b, const Points& c) noexcept {
    return Lanes::max(Lanes::max(a.most, b.most), c.most);
  }

  Shear& shear_;
  Vector slope_i_, slope_j_;
};

}  // namespace dsw
