#include "predicates/certified_hit.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "base/processor.h"
#include "predicates/certified_hit_bounds.h"

namespace dsw {
namespace {

using dd::Number;

struct Vector {
  Number x, y, z;
};

Vector difference(const double* a, const double* b) noexcept {
  return {dd::sum(a[0], -b[0]), dd::sum(a[1], -b[1]), dd::sum(a[2], -b[2])};
}

// ai bj - aj bi.
Number minor(const Number& ai, const Number& aj, const Number& bi, const Number& bj) noexcept {
  const Number left = dd::product(ai, bj), right = dd::product(aj, bi);
  const Number top = dd::sum(left.high, -right.high);
  return dd::sum(top.high, top.low + (left.low - right.low));
}

Number dot(const Vector& a, const Vector& b) noexcept {
  const Number x = dd::product(a.x, b.x), y = dd::product(a.y, b.y), z = dd::product(a.z, b.z);
  const Number xy = dd::sum(x.high, y.high), xyz = dd::sum(xy.high, z.high);
  return dd::sum(xyz.high, (xy.low + xyz.low) + ((x.low + y.low) + z.low));
}

double extent(const Number& a, const Number& b, const Number& c, const Number& d) noexcept {
  return std::max(std::max(std::fabs(a.high), std::fabs(b.high)), std::max(std::fabs(c.high), std::fabs(d.high)));
}

// Whether the component, known as n with the error of the products of its minor, rounds to one double; also when it is
// exactly 0 because all its products are.
bool round_component(const Number& n, const Number& ai, const Number& aj, const Number& bi, const Number& bj,
                     double* out) noexcept {
  *out = n.high;
  const double left = ai.high * bj.high, right = aj.high * bi.high;
  const double products = std::fabs(left) + std::fabs(right), error = kNormalError * products;
  if (products >= kLeastProducts) return (n.high + (n.low - error) == n.high) & (n.high + (n.low + error) == n.high);
  return (ai.high == 0 || bj.high == 0) && (aj.high == 0 || bi.high == 0);
}

using Certify = bool (*)(const double*, const double*, const double* const*, bool, CertifiedHit*) noexcept;

using CertifySeveral = uint32_t (*)(const PlaneFlight<3>*, PlaneHit<3>*) noexcept;

struct Choice {
  Certify one = certified_hit_without_fma;
  CertifySeveral several = [](const PlaneFlight<3>*, PlaneHit<3>*) noexcept -> uint32_t { return 0; };
};

Choice choose() noexcept {
  Choice choice;
#if DSW_X86_64
  if (has_avx2_and_fma()) {
    choice = {certified_hit_with_fma, certified_hits_with_fma};
  }
#endif
  return choice;
}

const Choice kChoice = choose();

}  // namespace

bool certified_hit_without_fma(const double* p, const double* q, const double* const* triangle, bool with_normal,
                               CertifiedHit* hit) noexcept {
  const Vector u = difference(q, p), w = difference(triangle[0], p);
  const Vector a = difference(triangle[1], triangle[0]), b = difference(triangle[2], triangle[0]);
  const double mx = extent(u.x, w.x, a.x, b.x), my = extent(u.y, w.y, a.y, b.y), mz = extent(u.z, w.z, a.z, b.z);
  if (!(std::min(std::min(mx, my), mz) >= kTimeFilterMin && std::max(std::max(mx, my), mz) <= kTimeFilterMax))
    return false;
  const Vector n = {minor(a.y, a.z, b.y, b.z), minor(a.z, a.x, b.z, b.x), minor(a.x, a.y, b.x, b.y)};
  if (with_normal) {
    const bool x = round_component(n.x, a.y, a.z, b.y, b.z, hit->normal);
    const bool y = round_component(n.y, a.z, a.x, b.z, b.x, hit->normal + 1);
    const bool z = round_component(n.z, a.x, a.y, b.x, b.y, hit->normal + 2);
    if (!(x && y && z)) return false;
  }
  return floor_ratio<dd::Split>(dot(n, w), dot(n, u), mx * my * mz, &hit->time);
}

bool certified_hit(const double* p, const double* q, const double* const* triangle, bool with_normal,
                   CertifiedHit* hit) noexcept {
  return kChoice.one(p, q, triangle, with_normal, hit);
}

uint32_t certified_hits(const PlaneFlight<3>* flights, PlaneHit<3>* hits) noexcept {
  return kChoice.several(flights, hits);
}

}  // namespace dsw
