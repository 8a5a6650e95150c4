#pragma once
// The points of a pair at the time at which it touches, and its normal.

#include <algorithm>

#include "base/position.h"
#include "base/vec.h"
#include "contact/normals.h"
#include "predicates/moving_pair.h"

namespace dsw {

/** A place on a segment, as a share of it. */
inline double clamped_share(double along, double whole) noexcept {
  return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0;
}

/** Where on a segment from p to q it is nearest to the one from a to b, as a share. */
inline double nearest_share(const Vec& p, const Vec& q, const Vec& a, const Vec& b) noexcept {
  const Vec d = q - p, e = b - a, w = p - a;
  const double dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dw = dot(d, w), ew = dot(e, w);
  const double share = clamped_share(de * ew - ee * dw, dd * ee - de * de);
  const double other = clamped_share(ew + share * de, ee);
  return clamped_share(other * de - dw, dd);
}

/** Where the points of a pair are when it touches, and how they move. */
template <int D>
struct TouchMoment {
  Vec at[D + 1], way[D + 1];

  TouchMoment(const MovingPair<D>& pair, double time) noexcept {
    for (int i = 0; i <= D; ++i) {
      double place[D];
      point_at<D>(pair.start[i], pair.end[i], time, place);
      at[i] = to_vec<D>(place);
      way[i] = difference<D>(pair.end[i], pair.start[i]);
    }
  }

  /** The unit normal from the second side to the first, from which it comes. */
  Vec normal([[maybe_unused]] PairKind kind) const noexcept {
    if constexpr (D == 2) {
      const Vec edge = at[2] - at[1], edge_way = way[2] - way[1];
      return of(turned(edge), turned(edge_way), 1);
    } else if (kind == PairKind::kVertexFace) {
      const Vec e = at[2] - at[1], f = at[3] - at[1], we = way[2] - way[1], wf = way[3] - way[1];
      return of(e.cross(f), we.cross(f) + e.cross(wf), 1);
    } else {
      const Vec e = at[1] - at[0], f = at[3] - at[2], we = way[1] - way[0], wf = way[3] - way[2];
      return of(e.cross(f), we.cross(f) + e.cross(wf), 2);
    }
  }

 private:
  /** The sides are on two sides of the plane with the normal `across`, which turns as `turn` says. They come together there:
   * what leads from the second side's point `second` to the first's. */
  Vec of(const Vec& across, const Vec& turn, int second) const noexcept {
    const Vec gap = at[0] - at[second], together = way[0] - way[second];
    if (is_zero(across)) {
      // Parallel edges that go alike: some unit vector.
      const Vec& way_of_one = is_zero(way[0]) ? way[second] : way[0];
      const Vec any = is_zero(way_of_one) ? Vec(1, 0, 0) : way_of_one;
      return against(Vec::Zero(), is_zero(together) ? any : together);
    }
    return (dot(across, together) + dot(turn, gap) > 0 ? -1.0 : 1.0) * unit(across);
  }
};

}  // namespace dsw
