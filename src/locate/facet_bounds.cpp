#include "locate/facet_bounds.h"

#include "base/dimensions.h"
#include "base/processor.h"

namespace dsw {
namespace facet_bounds_portable {
namespace {

struct Four {
  double x[4];

  template <class Of>
  static Four each(Of of) noexcept {
    return {{of(0), of(1), of(2), of(3)}};
  }
  static Four all(double a) noexcept { return {{a, a, a, a}}; }
  // As the processors' instructions: the second if they are not ordered.
  static Four min(const Four& a, const Four& b) noexcept {
    return each([&](int i) { return a.x[i] < b.x[i] ? a.x[i] : b.x[i]; });
  }
  static Four max(const Four& a, const Four& b) noexcept {
    return each([&](int i) { return a.x[i] > b.x[i] ? a.x[i] : b.x[i]; });
  }
  static Four if_positive(const Four& a, const Four& yes, const Four& no) noexcept {
    return each([&](int i) { return a.x[i] > 0 ? yes.x[i] : no.x[i]; });
  }
  template <int A, int B, int C, int D>
  Four turned() const noexcept {
    return {{x[A], x[B], x[C], x[D]}};
  }
};

inline Four operator+(const Four& a, const Four& b) noexcept {
  return Four::each([&](int i) { return a.x[i] + b.x[i]; });
}
inline Four operator-(const Four& a, const Four& b) noexcept {
  return Four::each([&](int i) { return a.x[i] - b.x[i]; });
}
inline Four operator*(const Four& a, const Four& b) noexcept {
  return Four::each([&](int i) { return a.x[i] * b.x[i]; });
}
inline Four operator/(const Four& a, const Four& b) noexcept {
  return Four::each([&](int i) { return a.x[i] / b.x[i]; });
}
inline Four absolute(const Four& a) noexcept {
  return Four::each([&](int i) { return std::fabs(a.x[i]); });
}
inline Four root(const Four& a) noexcept {
  return Four::each([&](int i) { return std::sqrt(a.x[i]); });
}
inline void store(const Four& a, double* out) noexcept { std::copy_n(a.x, 4, out); }

template <int D>
void read(const double* const* points, Four& x, Four& y, Four& z) noexcept {
  for (int i = 0; i < 4; ++i) {
    x.x[i] = points[i][0];
    y.x[i] = points[i][1];
    z.x[i] = D == 3 ? points[i][D - 1] : 0;
  }
}

#include "locate/facet_bounds.inl"

}  // namespace
}  // namespace facet_bounds_portable

template <int D>
BoundsKernel<D> portable_bounds() noexcept {
  return facet_bounds_portable::this_kernel<D>();
}

template <int D>
const BoundsKernel<D>& bounds_kernel() noexcept {
#if defined(__x86_64__)
  static const BoundsKernel<D> kernel = has_avx2() ? avx2_bounds<D>() : portable_bounds<D>();
#else
  static const BoundsKernel<D> kernel = portable_bounds<D>();
#endif
  return kernel;
}

SegmentFrame::SegmentFrame(const Vec& from, const Vec& along, double point_scale) : scale(point_scale) {
  const Vec ahead = unit(along);
  const bool is_point = is_zero(ahead);
  const Vec t = is_point ? Vec::UnitX() : ahead;
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(t[k]) < std::fabs(t[least])) least = k;
  }
  const Vec u = unit(t.cross(Vec::Unit(least))), v = t.cross(u);
  store<3>(from, first);
  store<3>(t, axes[0]);
  store<3>(u, axes[1]);
  store<3>(v, axes[2]);
  length = is_point ? 0 : dsw::length(along);
}

DSW_INSTANTIATE(portable_bounds);
DSW_INSTANTIATE(bounds_kernel);

}  // namespace dsw
