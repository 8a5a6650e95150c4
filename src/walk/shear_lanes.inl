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
      const Vector sides = Lanes::min(Lanes::min(side(a, b), side(b, c)), side(c, a));
      missed |= uint64_t{Lanes::not_positive(sides)} << n;
      largest = Lanes::max(largest, Lanes::max(Lanes::max(a.most, b.most), c.most));
      lowest = Lanes::min(lowest, Lanes::positive_or(sides, lowest));
    }
    shear_.largest_ = Lanes::largest(largest);
    shear_.lowest_ = Lanes::lowest(lowest);
    return missed;
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
  Points read(const Corner& corner, size_t n) const noexcept {
    const Vector a = Lanes::load(corner.i + n) - Lanes::all(shear_.p_[shear_.i_]),
                 b = Lanes::load(corner.j + n) - Lanes::all(shear_.p_[shear_.j_]),
                 c = Lanes::load(corner.k + n) - Lanes::all(shear_.p_[shear_.k_]);
    return {a - slope_i_ * c, b - slope_j_ * c,
            Lanes::max(Lanes::max(Lanes::absolute(a), Lanes::absolute(b)), Lanes::absolute(c))};
  }
  /** Of fewer triangles than lanes: the others count as passed, by nothing. */
  uint64_t some_missed(const Corner (&corners)[3], size_t count) noexcept {
    const auto these = Lanes::first(count);
    const auto read = [&](const Corner& corner) {
      const Vector a = Lanes::load(corner.i, these) - Lanes::all(shear_.p_[shear_.i_]),
                   b = Lanes::load(corner.j, these) - Lanes::all(shear_.p_[shear_.j_]),
                   c = Lanes::load(corner.k, these) - Lanes::all(shear_.p_[shear_.k_]);
      return Points{a - slope_i_ * c, b - slope_j_ * c,
                    Lanes::max(Lanes::max(Lanes::absolute(a), Lanes::absolute(b)), Lanes::absolute(c))};
    };
    const Points a = read(corners[0]), b = read(corners[1]), c = read(corners[2]);
    const Vector none = Lanes::all(shear_.largest_), lowest = Lanes::all(shear_.lowest_);
    const Vector sides = Lanes::choose(these, Lanes::min(Lanes::min(side(a, b), side(b, c)), side(c, a)), lowest);
    const Vector most = Lanes::choose(these, Lanes::max(Lanes::max(a.most, b.most), c.most), none);
    shear_.largest_ = Lanes::largest(Lanes::max(most, none));
    shear_.lowest_ = Lanes::lowest(Lanes::min(lowest, Lanes::positive_or(sides, lowest)));
    return Lanes::not_positive(sides) & ((1u << count) - 1);
  }
  static Vector side(const Points& a, const Points& b) noexcept { return a.i * b.j - a.j * b.i; }

  Shear& shear_;
  Vector slope_i_, slope_j_;
};

}  // namespace dsw
