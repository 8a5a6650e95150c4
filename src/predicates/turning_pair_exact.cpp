#include "predicates/turning_pair_exact.h"

namespace dsw {

namespace {

// The lowest bit that is in use, as integer_of takes it.
class Lowest {
 public:
  void add(const double* x, int count) noexcept {
    for (int i = 0; i < count; ++i) {
      const integers::Decoded d = integers::decode(x[i]);
      if (d.magnitude == 0) continue;
      const int low = d.exponent + static_cast<int>(lowest_bit(d.magnitude));
      bit_ = low < bit_ ? low : bit_;
    }
  }
  int bit() const noexcept { return bit_ == kNone ? 0 : bit_; }

 private:
  static constexpr int kNone = 4096;
  int bit_ = kNone;
};

Polynomial constant(const Integer& x) {
  Polynomial p;
  p.c[0] = x;
  p.degree = 0;
  p.trim();
  return p;
}
Polynomial line(const Integer& start, const Integer& end) {
  Polynomial p;
  p.c[0] = start;
  p.c[1] = end - start;
  p.degree = 1;
  p.trim();
  return p;
}

// In the plane the last two components of a quaternion are in use, else all.
template <int D>
void add_turn(const TurningWay& way, Lowest* low) noexcept {
  constexpr int first = D == 3 ? 0 : 2;
  for (const double* turn : way.turn) low->add(turn + first, 4 - first);
}

template <int D>
turning::Quaternion<Polynomial, D> quaternion(IntegerPool& pool, const TurningWay& way) {
  Lowest low;
  add_turn<D>(way, &low);
  const auto part = [&](int k) {
    return line(integer_of(pool, way.turn[0][k], low.bit()), integer_of(pool, way.turn[1][k], low.bit()));
  };
  turning::Quaternion<Polynomial, D> q;
  constexpr int first = D == 3 ? 0 : 2;
  for (int k = first; k < 3; ++k) q.v[k - first] = part(k);
  q.w = part(3);
  return q;
}

// The points of one feature, and its centre, as polynomials.
template <int D>
class ExactPoints {
 public:
  ExactPoints(IntegerPool& pool, const TurningPair<D>& pair) : pool_(pool), pair_(pair) {
    for (int i = 0; i <= D; ++i) {
      low_.add(pair.start[i], D);
      if (way_of(i) == nullptr) low_.add(pair.end[i], D);
    }
    for (const TurningWay* way : pair.way) {
      if (way == nullptr) continue;
      low_.add(way->centre, D);
      for (const double* place : way->place) low_.add(place, D);
    }
  }

  const TurningWay* way_of(int point) const noexcept {
    return pair_.way[point < (pair_.kind == PairKind::kEdgeEdge ? 2 : 1) ? 0 : 1];
  }

  turning::Row<Polynomial, D> from_centre(int point) const {
    turning::Row<Polynomial, D> r;
    for (int k = 0; k < D; ++k) r.at[k] = constant(of(pair_.start[point][k]) - of(way_of(point)->centre[k]));
    return r;
  }
  turning::Row<Polynomial, D> straight(int point) const {
    turning::Row<Polynomial, D> r;
    for (int k = 0; k < D; ++k) r.at[k] = line(of(pair_.start[point][k]), of(pair_.end[point][k]));
    return r;
  }
  turning::Row<Polynomial, D> place(const TurningWay& way) const {
    turning::Row<Polynomial, D> r;
    for (int k = 0; k < D; ++k) r.at[k] = line(of(way.place[0][k]), of(way.place[1][k]));
    return r;
  }

 private:
  Integer of(double x) const { return integer_of(pool_, x, low_.bit()); }

  IntegerPool& pool_;
  const TurningPair<D>& pair_;
  Lowest low_;
};

// Whether doubles say that a quaternion is never 0: its ends point to one side, or not along one line.
template <int D>
bool surely_turns(const TurningWay& way) noexcept {
  double first = 0, last = 0, between = 0, size = 0;
  for (int k = D == 3 ? 0 : 2; k < 4; ++k) {
    const double a = way.turn[0][k], b = way.turn[1][k];
    first += a * a;
    last += b * b;
    between += a * b;
    size += std::fabs(a * b);
  }
  if (!(first >= 0x1p-400 && first <= 0x1p400 && last >= 0x1p-400 && last <= 0x1p400)) return false;
  return between > 0x1p-48 * size || first * last - between * between > 0x1p-44 * (first * last);
}

}  // namespace

template <int D>
bool has_turn(const TurningWay& way) {
  if (surely_turns<D>(way)) return true;
  IntegerPool pool;
  const auto q = quaternion<D>(pool, way);
  const Polynomial n = turning::turn_of(q).n;
  Root roots[Polynomial::kMostDegree];
  return n.degree >= 0 && find_roots(pool, n, roots) == 0;
}

template <int D, bool kTwo>
ExactTurningPair<D, kTwo>::ExactTurningPair(IntegerPool& pool, const TurningPair<D>& pair, int displaced_along)
    : Base(pool, pair.kind) {
  terms_.kind = pair.kind;
  terms_.a_is_first = pair.way[0] != nullptr;
  const ExactPoints<D> points(pool, pair);
  for (int i = 0; i <= D; ++i) {
    const int at = terms_.at(i);
    if (terms_.is_of_a(i)) {
      terms_.a[at] = terms_.given_a[at] = points.from_centre(i);
    } else if constexpr (kTwo) {
      terms_.b[at] = terms_.given_b[at] = points.from_centre(i);
    } else {
      terms_.given_b[at] = points.straight(i);
    }
  }
  const TurningWay& way = *pair.way[terms_.a_is_first ? 0 : 1];
  const auto place = points.place(way);
  const auto q = quaternion<D>(pool, way);
  if constexpr (kTwo) {
    terms_.between = place - points.place(*pair.way[1]);
    terms_.set_turns(q, quaternion<D>(pool, *pair.way[1]));
  } else {
    for (int i = 0; i <= D; ++i) {
      if (terms_.is_of_a(i)) continue;
      auto& offset = terms_.offset[terms_.at(i)];
      offset = place - terms_.given_b[terms_.at(i)];
      if (displaced_along < 0) continue;
      Polynomial& along = offset.at[displaced_along];
      along = along + constant(integer_of(pool, std::uint64_t{1}));
    }
    terms_.set_turn(q);
  }
}

template <int D, bool kTwo>
Polynomial ExactTurningPair<D, kTwo>::difference(int axis, int i, int j) const {
  return terms_.way_between(i, j).at[axis];
}

template <int D, bool kTwo>
const Polynomial& ExactTurningPair<D, kTwo>::area(int view, int triangle) {
  Polynomial& r = area_[view][triangle];
  if (!has_area_[view][triangle]) {
    has_area_[view][triangle] = true;
    const auto [a, b, c] = exact_touch::kTriangle[triangle];
    r = terms_.area_of(view, a, b, c);
  }
  return r;
}

template <int D, bool kTwo>
Polynomial ExactTurningPair<D, kTwo>::volume() {
  if constexpr (D == 3) {
    return terms_.volume();
  } else {
    return area(0, 0);
  }
}

template bool has_turn<2>(const TurningWay&);
template bool has_turn<3>(const TurningWay&);
template class ExactTurningPair<2, false>;
template class ExactTurningPair<2, true>;
template class ExactTurningPair<3, false>;
template class ExactTurningPair<3, true>;

}  // namespace dsw
