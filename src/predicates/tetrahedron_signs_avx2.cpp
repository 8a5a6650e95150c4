// Four corners side by side, then up to four edges.

#include "base/compiler.h"
#include "predicates/tetrahedron_signs.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace {

using Lanes = __m256d;

struct Lanes3 {
  Lanes x, y, z;
};

struct EdgeTable {
  PassingEdges of[16];
  alignas(32) std::int32_t a[16][8], b[16][8];  // the same, as a permutation of halves of lanes
};
constexpr EdgeTable make_edge_table() noexcept {
  EdgeTable table{};
  for (unsigned positive = 0; positive < 16; ++positive) {
    const PassingEdges edges = passing_edges(positive);
    table.of[positive] = edges;
    for (int k = 0; k < 8; ++k) {
      table.a[positive][k] = 2 * edges.a[k / 2] + k % 2;
      table.b[positive][k] = 2 * edges.b[k / 2] + k % 2;
    }
  }
  return table;
}
constexpr EdgeTable kEdges = make_edge_table();

inline Lanes all(double x) noexcept { return _mm256_set1_pd(x); }
inline Lanes3 all(const filter::Vec<3>& v) noexcept { return {all(v.x), all(v.y), all(v.z)}; }
inline Lanes3 minus(const Lanes3& a, const double* p) noexcept {
  return {a.x - all(p[0]), a.y - all(p[1]), a.z - all(p[2])};
}
inline Lanes absolute(Lanes a) noexcept { return _mm256_andnot_pd(all(-0.0), a); }
inline Lanes3 absolute(const Lanes3& a) noexcept { return {absolute(a.x), absolute(a.y), absolute(a.z)}; }
inline Lanes3 larger(const Lanes3& a, const Lanes3& b) noexcept {
  return {_mm256_max_pd(a.x, b.x), _mm256_max_pd(a.y, b.y), _mm256_max_pd(a.z, b.z)};
}
inline Lanes3 cross(const Lanes3& a, const Lanes3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes dot(const Lanes3& a, const Lanes3& b) noexcept { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Lanes permute(Lanes a, __m256i index) noexcept {
  return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), index));
}
inline Lanes3 permute(const Lanes3& a, __m256i index) noexcept {
  return {permute(a.x, index), permute(a.y, index), permute(a.z, index)};
}
inline unsigned bits(Lanes a) noexcept { return static_cast<unsigned>(_mm256_movemask_pd(a)); }
inline unsigned positive(Lanes a) noexcept { return bits(_mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_GT_OQ)); }

/** Determinants with what their vectors reach. */
struct Tested {
  Lanes det, bound;
  Lanes3 reach;

  Tested(Lanes value, const Lanes3& m) noexcept : det(value), bound(all(kPlaneFilter3) * m.x * m.y * m.z), reach(m) {}

  Lanes in_range(double least, double most) const noexcept {
    const Lanes low = _mm256_min_pd(_mm256_min_pd(reach.x, reach.y), reach.z),
                high = _mm256_max_pd(_mm256_max_pd(reach.x, reach.y), reach.z);
    return _mm256_and_pd(_mm256_cmp_pd(low, all(least), _CMP_GE_OQ), _mm256_cmp_pd(high, all(most), _CMP_LE_OQ));
  }
  unsigned certain() const noexcept {
    return bits(_mm256_and_pd(in_range(kFilterMin, kFilterMax), _mm256_cmp_pd(absolute(det), bound, _CMP_GT_OQ)));
  }
};

/** Tells in each lane what SweptTriangle::is_later tells, with b on the positive side. */
inline unsigned later(const Tested& first, const Tested& last, double end) noexcept {
  const Lanes det = all(1 - end) * first.det + all(end) * last.det,
              size = all(4 * kUnitRoundoff) * (absolute(first.det) + absolute(last.det)),
              bound = all(kTimeSlack) * ((first.bound + last.bound) + size);
  const Lanes in_range =
      _mm256_and_pd(first.in_range(kTimeFilterMin, kTimeFilterMax), last.in_range(kTimeFilterMin, kTimeFilterMax));
  return bits(_mm256_and_pd(in_range, _mm256_cmp_pd(_mm256_setzero_pd() - det, bound, _CMP_GT_OQ)));
}

inline Lanes3 read(const double* const* corners) noexcept {
  // Masked, so that the last point of the host's array is not read past.
  const __m256i mask = _mm256_setr_epi64x(-1, -1, -1, 0);
  const Lanes a = _mm256_maskload_pd(corners[0], mask), b = _mm256_maskload_pd(corners[1], mask),
              c = _mm256_maskload_pd(corners[2], mask), d = _mm256_maskload_pd(corners[3], mask);
  const Lanes xz01 = _mm256_unpacklo_pd(a, b), xz23 = _mm256_unpacklo_pd(c, d), y01 = _mm256_unpackhi_pd(a, b),
              y23 = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(xz01, xz23, 0x20), _mm256_permute2f128_pd(y01, y23, 0x20),
          _mm256_permute2f128_pd(xz01, xz23, 0x31)};
}

}  // namespace

void find_tetrahedron_signs_avx2(const SweptTriangle& triangle, const double* const* corners,
                                 TetrahedronSigns& signs) noexcept {
  const EdgeMotion& m = triangle.motion();
  const Lanes3 at = read(corners), start = minus(at, m.p);
  const Tested sides(dot(all(triangle.normal()), start), larger(absolute(start), all(triangle.reach())));
  unsigned above = positive(sides.det);
  const unsigned sure = sides.certain();
  for (unsigned i = 0; i < 4; ++i) signs.side[i] = static_cast<std::int8_t>(2 * static_cast<int>(above >> i & 1u) - 1);
  for (unsigned open = ~sure & 15u; open != 0; open &= open - 1) {
    const auto i = lowest_bit(open);
    const int side = triangle.side(corners[i]);
    signs.side[i] = static_cast<std::int8_t>(side);
    above = (above & ~(1u << i)) | static_cast<unsigned>(side > 0) << i;
  }
  if (!signs.passes_plane()) return;

  const Lanes3 end = minus(at, m.to);
  const __m256i a = _mm256_load_si256(reinterpret_cast<const __m256i*>(kEdges.a[above])),
                b = _mm256_load_si256(reinterpret_cast<const __m256i*>(kEdges.b[above]));
  const Lanes3 start_a = permute(start, a), start_b = permute(start, b), end_a = permute(end, a),
               end_b = permute(end, b);
  const Lanes3 at_start = cross(start_a, start_b), at_end = cross(end_a, end_b),
               reach_start = larger(absolute(start_a), absolute(start_b)),
               reach_end = larger(absolute(end_a), absolute(end_b));
  const Lanes3 move = all(triangle.move()), old_edge = all(triangle.old_edge()), new_edge = all(triangle.new_edge());
  const Tested along(dot(at_start, move), larger(absolute(move), reach_start)),
      last(dot(at_end, new_edge), larger(absolute(new_edge), reach_end)),
      first(dot(at_start, old_edge), larger(absolute(old_edge), reach_start));
  const unsigned known = along.certain() & last.certain() & first.certain();
  const unsigned beyond[3] = {~positive(along.det), ~positive(last.det), positive(first.det)};
  const unsigned after = triangle.end() < 1 ? later(first, last, triangle.end()) : 0;
  const PassingEdges& edges = kEdges.of[above];
  for (unsigned k = 0; k < edges.count; ++k) {
    const std::uint8_t i = edges.a[k], j = edges.b[k];
    unsigned outside = (beyond[0] >> k & 1u) | (beyond[1] >> k & 1u) << 1 | (beyond[2] >> k & 1u) << 2 |
                       (after >> k & 1u) * SweptTriangle::kLater;
    if ((known >> k & 1u) == 0) outside = triangle.outside(corners[i], corners[j], 1);
    signs.lines[i][j] = signs.lines[j][i] = static_cast<std::uint8_t>(outside);
  }
}

}  // namespace dsw

DSW_END_TARGET

#endif
