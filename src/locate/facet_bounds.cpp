#include "locate/facet_bounds.h"

#include "base/compiler.h"
#include "base/dimensions.h"
#include "base/processor.h"

namespace dsw {
namespace facet_bounds_portable {
namespace {

struct Lanes {
  float x[8];

  template <class Of>
  static Lanes each(Of of) noexcept {
    Lanes all;
    for (int i = 0; i < 8; ++i) all.x[i] = of(i);
    return all;
  }
  static Lanes all(float a) noexcept {
    return each([&](int) { return a; });
  }
  // Lanes take the minimum as the processors' instructions do: the second number if the two are not ordered.
  static Lanes min(const Lanes& a, const Lanes& b) noexcept {
    return each([&](int i) { return a.x[i] < b.x[i] ? a.x[i] : b.x[i]; });
  }
  static Lanes max(const Lanes& a, const Lanes& b) noexcept {
    return each([&](int i) { return a.x[i] > b.x[i] ? a.x[i] : b.x[i]; });
  }
  /** Lanes in another order, within each four. */
  template <int A, int B, int C, int D>
  Lanes turned() const noexcept {
    return {{x[A], x[B], x[C], x[D], x[4 + A], x[4 + B], x[4 + C], x[4 + D]}};
  }
};

inline Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
  return Lanes::each([&](int i) { return a.x[i] + b.x[i]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
  return Lanes::each([&](int i) { return a.x[i] - b.x[i]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
  return Lanes::each([&](int i) { return a.x[i] * b.x[i]; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
  return Lanes::each([&](int i) { return a.x[i] / b.x[i]; });
}
inline Lanes absolute(const Lanes& a) noexcept {
  return Lanes::each([&](int i) { return std::fabs(a.x[i]); });
}
/** Zero elsewhere. */
inline Lanes where_above(const Lanes& a, float limit, const Lanes& yes) noexcept {
  return Lanes::each([&](int i) { return a.x[i] > limit ? yes.x[i] : 0; });
}
inline Lanes where_not_above(const Lanes& a, float limit, const Lanes& yes) noexcept {
  return Lanes::each([&](int i) { return a.x[i] > limit ? 0 : yes.x[i]; });
}
inline Lanes root(const Lanes& a) noexcept {
  return Lanes::each([&](int i) { return std::sqrt(a.x[i]); });
}
inline void store(const Lanes& a, float* out) noexcept { std::copy_n(a.x, 8, out); }

/** Eight points: scaled differences from the segment's first one. */
template <int D>
void read(const SegmentFrame<D>& frame, const double* const* points, Lanes& x, Lanes& y, Lanes& z) noexcept {
  const auto coordinate = [&](int k) {
    return Lanes::each([&](int i) { return static_cast<float>((points[i][k] - frame.first[k]) * frame.scale); });
  };
  x = coordinate(0);
  y = coordinate(1);
  z = D == 3 ? coordinate(D - 1) : Lanes::all(0);
}

#include "locate/facet_bounds.inl"

}  // namespace
}  // namespace facet_bounds_portable

template <int D>
BoundsKernel<D> portable_bounds() noexcept {
  return {facet_bounds_portable::triangle_bounds<D>, facet_bounds_portable::tetrahedra_bounds};
}

template <int D>
const BoundsKernel<D>& bounds_kernel() noexcept {
#if DSW_X86_64
  static const BoundsKernel<D> kernel = has_avx2() ? avx2_bounds<D>() : portable_bounds<D>();
#else
  static const BoundsKernel<D> kernel = portable_bounds<D>();
#endif
  return kernel;
}

template <int D>
SegmentFrame<D>::SegmentFrame(const double* from, const Vec& along, double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  scale = std::ldexp(1.0, -exponent);
  std::copy_n(from, D, first);
  const Vec ahead = unit(along);
  const Vec t = is_zero(ahead) ? Vec(Vec::Unit(0)) : ahead;
  int least = D == 2 ? 2 : 0;  // in the plane, u is the axis across that lies in it
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(t[k]) < std::fabs(t[least])) least = k;
  }
  const Vec u = unit(t.cross(Vec::Unit(least))), v = t.cross(u);
  for (int k = 0; k < 3; ++k) {
    axes[0][k] = static_cast<float>(t[k]);
    axes[1][k] = static_cast<float>(u[k]);
    axes[2][k] = static_cast<float>(v[k]);
  }
  half = static_cast<float>(length(along) * scale / 2);
}

template struct SegmentFrame<2>;
template struct SegmentFrame<3>;
DSW_INSTANTIATE(portable_bounds);
DSW_INSTANTIATE(bounds_kernel);

}  // namespace dsw
