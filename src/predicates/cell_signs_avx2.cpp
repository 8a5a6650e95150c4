// Four corners side by side, then up to four edges.

#include "base/compiler.h"
#include "predicates/cell_signs.h"

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
/** In each lane that of the next one, in the last that of the first. */
inline Lanes3 next(const Lanes3& a) noexcept {
  return {_mm256_permute4x64_pd(a.x, 0x39), _mm256_permute4x64_pd(a.y, 0x39), _mm256_permute4x64_pd(a.z, 0x39)};
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

/** The corners of four lines relative to both places of the vertex that moves. */
struct FourLines {
  Lanes3 start_a, start_b, end_a, end_b;
};

/** What SweptTriangle::outside tells of four lines, a bit each. */
struct Outside {
  unsigned known;  // the filter decides all of it
  unsigned of[3];  // of each side of the triangle
  unsigned later;

  /** @param above the lines with b on the positive side. */
  DSW_HOT Outside(const SweptTriangle& triangle, const FourLines& lines, unsigned above) noexcept {
    const Lanes3 at_start = cross(lines.start_a, lines.start_b), at_end = cross(lines.end_a, lines.end_b),
                 reach_start = larger(absolute(lines.start_a), absolute(lines.start_b)),
                 reach_end = larger(absolute(lines.end_a), absolute(lines.end_b));
    const Lanes3 move = all(triangle.move()), old_edge = all(triangle.old_edge()), new_edge = all(triangle.new_edge());
    const Tested along(dot(at_start, move), larger(absolute(move), reach_start)),
        last(dot(at_end, new_edge), larger(absolute(new_edge), reach_end)),
        first(dot(at_start, old_edge), larger(absolute(old_edge), reach_start));
    known = along.certain() & last.certain() & first.certain();
    of[0] = positive(along.det) ^ above;
    of[1] = positive(last.det) ^ above;
    of[2] = ~(positive(first.det) ^ above);
    later = triangle.end() < 1 ? find_later(first, last, triangle.end(), above) : 0;
  }
  unsigned of_line(unsigned k) const noexcept {
    return (of[0] >> k & 1u) | (of[1] >> k & 1u) << 1 | (of[2] >> k & 1u) << 2 |
           (later >> k & 1u) * SweptTriangle::kLater;
  }

 private:
  /** Tells in each lane what SweptTriangle::is_later tells. */
  static DSW_HOT unsigned find_later(const Tested& first, const Tested& last, double end, unsigned above) noexcept {
    const Lanes det = all(1 - end) * first.det + all(end) * last.det,
                size = all(4 * kUnitRoundoff) * (absolute(first.det) + absolute(last.det)),
                bound = all(kTimeSlack) * ((first.bound + last.bound) + size);
    const unsigned in_range = bits(
        _mm256_and_pd(first.in_range(kTimeFilterMin, kTimeFilterMax), last.in_range(kTimeFilterMin, kTimeFilterMax)));
    const unsigned low = bits(_mm256_cmp_pd(_mm256_setzero_pd() - det, bound, _CMP_GT_OQ)),
                   high = bits(_mm256_cmp_pd(det, bound, _CMP_GT_OQ));
    return in_range & ((low & above) | (high & ~above));
  }
};

/** The sides of four corners, and those that are on the positive side, a bit each. */
struct Sides {
  unsigned above;
  bool differ;

  DSW_NOINLINE Sides(const SweptTriangle& triangle, const double* const* corners, const Lanes3& start,
                     std::int8_t (&side)[5]) noexcept {
    const Tested sides(dot(all(triangle.normal()), start), larger(absolute(start), all(triangle.reach())));
    above = positive(sides.det);
    const unsigned sure = sides.certain();
    for (unsigned i = 0; i < 4; ++i) side[i] = static_cast<std::int8_t>(2 * static_cast<int>(above >> i & 1u) - 1);
    for (unsigned open = ~sure & 15u; open != 0; open &= open - 1) {
      const auto i = lowest_bit(open);
      side[i] = static_cast<std::int8_t>(triangle.side(corners[i]));
      above = (above & ~(1u << i)) | static_cast<unsigned>(side[i] > 0) << i;
    }
    differ = side[0] != side[1] || side[0] != side[2] || side[0] != side[3];
  }
};

}  // namespace

bool find_tetrahedron_signs_avx2(const SweptTriangle& triangle, const double* const* corners,
                                 CellSigns& signs) noexcept {
  const EdgeMotion& m = triangle.motion();
  const Lanes3 at = read(corners), start = minus(at, m.p);
  const Sides sides(triangle, corners, start, signs.side);
  if (!sides.differ) return false;
  const Lanes3 end = minus(at, m.to);
  const __m256i a = _mm256_load_si256(reinterpret_cast<const __m256i*>(kEdges.a[sides.above])),
                b = _mm256_load_si256(reinterpret_cast<const __m256i*>(kEdges.b[sides.above]));
  const Outside outside(triangle, {permute(start, a), permute(start, b), permute(end, a), permute(end, b)}, 15);
  const PassingEdges& edges = kEdges.of[sides.above];
  for (unsigned k = 0; k < edges.count; ++k) {
    const std::uint8_t i = edges.a[k], j = edges.b[k];
    const bool known = (outside.known >> k & 1u) != 0;
    const unsigned of_line = known ? outside.of_line(k) : triangle.outside(corners[i], corners[j], 1);
    signs.lines[i][j] = signs.lines[j][i] = static_cast<std::uint8_t>(of_line);
  }
  return true;
}

bool find_pyramid_signs_avx2(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept {
  const EdgeMotion& m = triangle.motion();
  const double* const tip = corners[4];
  const Lanes3 at = read(corners), start = minus(at, m.p);
  const Sides sides(triangle, corners, start, signs.side);
  const int tip_side = triangle.side(tip);
  signs.side[4] = static_cast<std::int8_t>(tip_side);
  if (!sides.differ && tip_side == signs.side[0]) return false;
  const Lanes3 end = minus(at, m.to);
  FourLines lines{start, all(filter::difference<3>(tip, m.p)), end, all(filter::difference<3>(tip, m.to))};
  unsigned above = tip_side > 0 ? 15u : 0u;
  for (unsigned of_base = 0; of_base < 2; ++of_base) {
    unsigned which = sides.above ^ above;
    if (which != 0) {
      const Outside outside(triangle, lines, above);
      for (; which != 0; which &= which - 1) {
        const unsigned i = lowest_bit(which), j = of_base != 0 ? (i + 1) % 4 : 4;
        const bool known = (outside.known >> i & 1u) != 0;
        const unsigned of_line = known ? outside.of_line(i) : triangle.outside(corners[i], corners[j], signs.side[j]);
        signs.lines[i][j] = signs.lines[j][i] = static_cast<std::uint8_t>(of_line);
      }
    }
    lines.start_b = next(start);
    lines.end_b = next(end);
    above = sides.above >> 1 | (sides.above & 1u) << 3;
  }
  for (unsigned i = 0; i < 4; ++i) signs.lines[i][i ^ 2u] = CellSigns::kNotAsked;
  return true;
}

}  // namespace dsw

DSW_END_TARGET

#endif
