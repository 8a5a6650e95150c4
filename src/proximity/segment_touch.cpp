// Exact tests of a segment and the parts of a body that lie near it. The segment is looked at in pieces, so that a long
// one that lies across the axes does not look at all that its box holds.

#include "proximity/segment_touch.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/dimensions.h"
#include "base/points.h"
#include "base/position.h"
#include "body/near_simplices.h"
#include "predicates/hull_gap.h"

namespace dsw {
namespace {

constexpr uint32_t kPieces = 8;
constexpr size_t kWorthPieces = 64;  // parts of a body

/** The parts of a segment that can be within a box, as shares of it; first > last: none. */
template <int D>
struct Span {
  double first = 0, last = 1;

  Span(const double* from, const double* to, const Box<D>& box) noexcept {
    for (int k = 0; k < D; ++k) {
      const double way = to[k] - from[k];
      if (from[k] == to[k]) {
        if (from[k] < box.lower[k] || from[k] > box.upper[k]) first = 2;
        continue;
      }
      double enters = (box.lower[k] - from[k]) / way, leaves = (box.upper[k] - from[k]) / way;
      if (enters > leaves) std::swap(enters, leaves);
      // What is no number bounds nothing.
      if (enters - kSlack > first) first = enters - kSlack;
      if (leaves + kSlack < last) last = leaves + kSlack;
    }
  }
  static constexpr double kSlack = 0x1p-40;
};

template <int D>
class Meeting {
 public:
  Meeting(const Partner<D>& partner, const double* from, const double* to, SegmentEnds ends, SegmentTouch<D>& first)
      : partner_(partner), body_(*partner.body), from_(from), to_(to), ends_(ends), first_(first) {}

  void run() {
    if (body_.boxes.empty()) {
      for_each_outer(body_, [&](const Simplex& part) { return look(part); });
      return;
    }
    const double room = body_.radius + 0x1p-45 * largest_coordinate<D>(from_, to_);
    const Span<D> span(from_, to_, widened(body_.boxes[0].bounds, room));
    if (!(span.first <= span.last)) return;
    const size_t parts = body_.vertices.size() + body_.edges.size() + body_.faces.size();
    const uint32_t pieces = parts < kWorthPieces ? 1 : kPieces;
    for (uint32_t i = 0; i < pieces; ++i) {
      const double begin = span.first + (span.last - span.first) * i / pieces,
                   end = span.first + (span.last - span.first) * (i + 1) / pieces;
      if (begin - Span<D>::kSlack > first_.time) return;
      visit(widened(piece(begin, end), room));
    }
  }

 private:
  Box<D> piece(double begin, double end) const {
    Box<D> box;
    for (const double share : {begin, end}) {
      double at[D];
      for (int k = 0; k < D; ++k) at[k] = from_[k] + share * (to_[k] - from_[k]);
      if (!is_finite<D>(at)) return Box<D>::everything();
      box.add(at);
    }
    return box;
  }

  void visit(const Box<D>& box) {
    for_each_outer_near(body_, box, [this](const Simplex& part) { return look(part); });
  }

  bool look(const Simplex& part) {
    const SimplexCorners<D> corners(body_, part);
    const double* at[3] = {};
    for (uint32_t k = 0; k < corners.count; ++k) at[k] = body_.position(corners.vertices[k]);
    SegmentTouch<D> touch;
    touch.other = partner_;
    touch.other_part = part;
    if (body_.radius > 0) {
      come_near(at, corners.count, touch);
    } else if (ends_ == SegmentEnds::kClosed || inside_touches<D>(from_, to_, at, corners.count)) {
      const EdgeTouch met = point_touch<D>(from_, to_, at, corners.count);
      touch.time = met.time;
      touch.place = met.place;
    }
    if (touch.time != kNever && touch.comes_before(first_)) first_ = touch;
    return true;
  }

  /** When a point comes as near as the radius. */
  void come_near(const double* const* at, uint32_t count, SegmentTouch<D>& touch) const {
    ConvexHull point, part;
    point.points[0] = from_;
    point.count = 1;
    std::copy_n(at, count, part.points);
    part.count = count;
    HullGap gap;
    const double time = time_apart<D>(point, to_, part, body_.radius, &gap);
    if (time == 1) return;
    touch.time = time;
    touch.away = gap.normal;
    touch.is_thick = true;
  }

  const Partner<D>& partner_;
  const Body<D>& body_;
  const double *from_, *to_;
  SegmentEnds ends_;
  SegmentTouch<D>& first_;
};

}  // namespace

template <int D>
bool SegmentTouch<D>::comes_before(const SegmentTouch& o) const noexcept {
  const auto key = [](const SegmentTouch& t) {
    return std::make_tuple(t.time, t.other.index, t.other_part.kind, t.other_part.index);
  };
  return key(*this) < key(o);
}

template <int D>
void meet_segment(const Partner<D>& partner, const double* from, const double* to, SegmentEnds ends,
                  SegmentTouch<D>& first) noexcept {
  Meeting<D>(partner, from, to, ends, first).run();
}

template struct SegmentTouch<2>;
template struct SegmentTouch<3>;
DSW_INSTANTIATE(meet_segment);

}  // namespace dsw
