#include "predicates/turning_pair_filter.h"

#include "predicates/filter_bounds.h"
#include "predicates/turning_terms.h"

namespace dsw {

namespace {

constexpr double kTurningError = 320 * kUnitRoundoff;
constexpr double kTurningRootError = 0x1p-88, kMostRootSteps = 63;

// A polynomial as the sum of c[i] s^(N-i) t^i with s = 1 - t.
template <int N>
struct Form {
  double c[N + 1];

  Form() noexcept : c{} {}
  explicit Form(double x) noexcept : c{x} { static_assert(N == 0, "a constant"); }
  Form(double start, double end) noexcept : c{start, end} { static_assert(N == 1, "a line"); }

  template <int M>
  explicit Form(const Form<M>& f) noexcept {
    static_assert(M <= N, "a form is raised only");
    for (int i = 0; i <= M; ++i) c[i] = f.c[i];
    DSW_UNROLL(8)
    for (int m = M; m < N; ++m) {
      c[m + 1] = c[m];
      DSW_UNROLL(8)
      for (int i = m; i > 0; --i) c[i] += c[i - 1];
    }
  }
};

template <int A, int B>
DSW_HOT Form<A + B> operator*(const Form<A>& a, const Form<B>& b) noexcept {
  Form<A + B> r;
  DSW_UNROLL(8)
  for (int i = 0; i <= A; ++i) {
    DSW_UNROLL(8)
    for (int j = 0; j <= B; ++j) r.c[i + j] += a.c[i] * b.c[j];
  }
  return r;
}
template <int A, int B>
DSW_HOT auto operator+(const Form<A>& a, const Form<B>& b) noexcept {
  constexpr int N = A > B ? A : B;
  Form<N> r(a);
  const Form<N> other(b);
  DSW_UNROLL(8)
  for (int i = 0; i <= N; ++i) r.c[i] += other.c[i];
  return r;
}
template <int A, int B>
DSW_HOT auto operator-(const Form<A>& a, const Form<B>& b) noexcept {
  constexpr int N = A > B ? A : B;
  Form<N> r(a);
  const Form<N> other(b);
  DSW_UNROLL(8)
  for (int i = 0; i <= N; ++i) r.c[i] -= other.c[i];
  return r;
}

// A number at one time.
struct Precise {
  dd::Number x;
};
DSW_HOT Precise operator*(const Precise& a, const Precise& b) noexcept { return {dd::multiply(a.x, b.x)}; }
DSW_HOT Precise operator+(const Precise& a, const Precise& b) noexcept { return {dd::add(a.x, b.x)}; }
DSW_HOT Precise operator-(const Precise& a, const Precise& b) noexcept { return {dd::add(a.x, dd::negative(b.x))}; }

// B stands (kDegree 3), or goes straight, or turns.
template <int kDegree, int kOfB>
struct FormNumbers {
  using Q = Form<1>;
  using X = Form<0>;
  using Y = Form<kOfB>;
  using C = Form<1>;
  using Value = Form<kDegree>;
};
struct PreciseNumbers {
  using Q = Precise;
  using X = Precise;
  using Y = Precise;
  using C = Precise;
  using Value = Precise;
};

enum class Other { kStands, kGoes, kTurns };

// The pair in doubles, how large its lengths are, and the same at one time in double-double.
template <int D, Other kOther>
class TurningFilter {
 public:
  static constexpr int kDegree = kOther == Other::kStands ? 3 : 5;
  static constexpr bool kTwo = kOther == Other::kTurns;

  explicit TurningFilter(const TurningPair<D>& pair) noexcept
      : pair_(pair), way_(*pair.way[pair.way[0] != nullptr ? 0 : 1]), search_(pair.kind) {
    terms_.kind = pair.kind;
    terms_.a_is_first = pair.way[0] != nullptr;
  }

  Filtered first_touch(const Asked& asked, double* time) noexcept {
    if (!find_scale(way_, &scale_[0], &largest_[0])) return Filtered::kUnknown;
    if (kTwo && !find_scale(*pair_.way[1], &scale_[1], &largest_[1])) return Filtered::kUnknown;
    set_terms<Numbers>(
        terms_, [](double start, double end) { return Form<1>(start, end); }, Differences{});
    if (!find_bounds()) return Filtered::kUnknown;
    if (!asked.is_near && is_apart_on_axis()) return Filtered::kApart;
    if (!(volume_bound_ >= 0x1p-400)) return Filtered::kUnknown;
    put(volume_of(terms_), &search_.whole.volume);
    search_.volume_error = kTurningError * volume_bound_;
    search_.root_error = kTurningRootError * volume_bound_;
    search_.most_steps = kMostRootSteps;
    search_.end_at(touch_search::end_after(asked.until));
    return search_.first_touch([this] { find_conditions(); }, [this](double t) { return volume_at(t); }, time);
  }

 private:
  using Numbers = FormNumbers<kDegree, kOther == Other::kGoes ? 1 : 0>;
  template <class N>
  using Terms = turning::Pair<D, std::conditional_t<kTwo, turning::TwoTurns<D, N>, turning::OneTurn<D, N>>>;
  static constexpr int kFirstOfTurn = D == 3 ? 0 : 2;  // the first component of quaternions that is in use

  // The power of two that takes the largest component of a way's quaternions near 1.
  static bool find_scale(const TurningWay& way, double* scale, double* largest) noexcept {
    double most = 0;
    for (const auto& turn : way.turn) {
      for (int k = kFirstOfTurn; k < 4; ++k) raise(turn[k], &most);
    }
    if (!(most >= 0x1p-900 && most <= 0x1p900)) return false;
    *scale = integers::of_bits((std::uint64_t{2046} - (integers::bits_of(most) >> 52)) << 52);
    *largest = *scale * most;
    return true;
  }

  static void raise(double x, double* bound) noexcept { *bound = std::fabs(x) > *bound ? std::fabs(x) : *bound; }

  // Numbers out of differences of doubles: rounded, or exact.
  struct Differences {
    Form<0> constant(double x) const noexcept { return Form<0>(x); }
    Form<0> difference(double x, double from) const noexcept { return Form<0>(x - from); }
    Form<1> difference(double x, double from, double later, double later_from) const noexcept {
      return {x - from, later - later_from};
    }
  };
  struct At {
    dd::Number rest, part;

    Precise constant(double x) const noexcept { return {{x, 0}}; }
    Precise difference(double x, double from) const noexcept { return {dd::sum(x, -from)}; }
    Precise difference(double x, double from, double later, double later_from) const noexcept {
      return between(dd::sum(x, -from), dd::sum(later, -later_from));
    }
    Precise between(const dd::Number& start, const dd::Number& end) const noexcept {
      return {dd::add(dd::multiply(start, rest), dd::multiply(end, part))};
    }
  };

  // In space volumes read no other points of A and offsets than the first ones.
  template <class N, class Line, class Make>
  DSW_HOT void set_terms(Terms<N>& terms, Line line, const Make& make) const noexcept {
    constexpr bool kVolumeOnly = D == 3 && std::is_same_v<N, PreciseNumbers>;
    for (int i = 0; i <= D; ++i) {
      const int at = terms.at(i);
      const bool of_a = terms.is_of_a(i);
      const double *const start = pair_.start[i], *const end = pair_.end[i];
      for (int k = 0; k < D; ++k) {
        if (of_a) {
          if (at == 0 || !kVolumeOnly) terms.a[at].at[k] = make.difference(start[k], way_.centre[k]);
          terms.given_a[at].at[k] = make.constant(start[k]);
        } else if constexpr (kTwo) {
          terms.b[at].at[k] = make.difference(start[k], pair_.way[1]->centre[k]);
          terms.given_b[at].at[k] = make.constant(start[k]);
        } else {
          if constexpr (kOther == Other::kStands) {
            terms.given_b[at].at[k] = make.constant(start[k]);
          } else {
            terms.given_b[at].at[k] = line(start[k], end[k]);
          }
          if (at == 0 || !kVolumeOnly)
            terms.offset[at].at[k] = make.difference(way_.place[0][k], start[k], way_.place[1][k], end[k]);
        }
      }
    }
    const auto q = quaternion<N>(way_, scale_[0], line);
    if constexpr (kTwo) {
      const TurningWay& other = *pair_.way[1];
      for (int k = 0; k < D; ++k) {
        terms.between.at[k] = make.difference(way_.place[0][k], other.place[0][k], way_.place[1][k], other.place[1][k]);
      }
      terms.set_turns(q, quaternion<N>(other, scale_[1], line));
    } else {
      terms.set_turn(q);
    }
  }

  template <class N, class Line>
  static auto quaternion(const TurningWay& way, double scale, Line line) noexcept {
    turning::Quaternion<typename N::Q, D> q;
    for (int k = kFirstOfTurn; k < 3; ++k) q.v[k - kFirstOfTurn] = line(scale * way.turn[0][k], scale * way.turn[1][k]);
    q.w = line(scale * way.turn[0][3], scale * way.turn[1][3]);
    return q;
  }

  template <class T>
  static auto volume_of(const T& terms) noexcept {
    if constexpr (D == 3) {
      return terms.volume();
    } else {
      return terms.area_of(0, 0, 1, 2);
    }
  }

  dd::Number volume_at(double t) const noexcept {
    Terms<PreciseNumbers> terms;
    terms.kind = terms_.kind;
    terms.a_is_first = terms_.a_is_first;
    const At at{dd::sum(1, -t), {t, 0}};
    set_terms<PreciseNumbers>(
        terms,
        [&at](double start, double end) {
          return at.between({start, 0}, {end, 0});
        },
        at);
    return volume_of(terms).x;
  }

  // The largest component of an edge of one feature, whose points are `points`.
  template <class Row>
  static double longest(const Row* points, int count) noexcept {
    double most = 0;
    for (int i = 1; i < count; ++i) {
      for (int j = 0; j < i; ++j) {
        for (int k = 0; k < D; ++k) {
          const auto edge = points[i].at[k] - points[j].at[k];
          for (const double x : edge.c) raise(x, &most);
        }
      }
    }
    return most;
  }
  template <class Row>
  static double farthest(const Row* points, int count) noexcept {
    double most = 0;
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < D; ++k) {
        for (const double x : points[i].at[k].c) raise(x, &most);
      }
    }
    return most;
  }

  // The bounds T of the header. False: lengths are out of range.
  bool find_bounds() noexcept {
    const int count_a = terms_.a_is_first ? terms_.first_count() : D + 1 - terms_.first_count(),
              count_b = D + 1 - count_a;
    const double x = farthest(terms_.a, count_a), edge_a = longest(terms_.given_a, count_a),
                 edge_b = longest(terms_.given_b, count_b);
    double part = largest_[0] * largest_[0], lengths = 0, mixed = 0;
    if constexpr (kTwo) {
      const double y = farthest(terms_.b, count_b), between = farthest(&terms_.between, 1);
      part *= largest_[1] * largest_[1];
      lengths = x + y + between;
      way_bound_ = 16 * part * (12 * x + 3 * between + y);
      mixed = 384 * part * edge_a * lengths;
    } else {
      const double offset = farthest(terms_.offset, count_b);
      lengths = x + offset;
      way_bound_ = 4 * part * (3 * x + offset);
      mixed = 24 * part * edge_a * lengths;
    }
    const double of_b = 2 * edge_b * (way_bound_ > edge_b ? way_bound_ : edge_b);
    if constexpr (D == 2) {
      volume_bound_ = terms_.a_is_first ? of_b : mixed;
      area_bound_ = way_bound_;
    } else if (terms_.kind == PairKind::kEdgeEdge) {
      volume_bound_ = 3 * edge_b * mixed;
      area_bound_ = mixed > of_b ? mixed : of_b;
    } else if (terms_.a_is_first) {
      volume_bound_ = 6 * edge_b * edge_b * way_bound_;
      area_bound_ = of_b;
    } else {
      const double own = 24 * part * edge_a * edge_a;
      volume_bound_ = 3 * edge_a * mixed;
      area_bound_ = mixed > own ? mixed : own;
    }
    search_.condition_error = kTurningError * area_bound_;
    return lengths >= 0x1p-100 && lengths <= 0x1p100 && edge_a <= 0x1p100 && edge_b <= 0x1p100;
  }

  // Whether all ways from points of B to points of A go to one side of an axis at all times.
  bool is_apart_on_axis() const noexcept {
    const double error = kTurningError * (kDegree == 3 ? 3 : 10) * way_bound_;
    const int first_of_second = terms_.first_count();
    bool below[D], above[D];
    for (int k = 0; k < D; ++k) below[k] = above[k] = true;
    for (int i = 0; i < first_of_second; ++i) {
      for (int j = first_of_second; j <= D; ++j) {
        const auto way = terms_.way_between(i, j);
        bool is_open = false;
        for (int k = 0; k < D; ++k) {
          for (const double c : way.at[k].c) {
            below[k] = below[k] && c < -error;
            above[k] = above[k] && c > error;
          }
          is_open = is_open || below[k] || above[k];
        }
        if (!is_open) return false;
      }
    }
    return true;
  }

  // The basis of Bernstein has binomial coefficients.
  template <int N>
  static void put(const Form<N>& f, touch_search::Curve<kDegree + 1>* curve) noexcept {
    constexpr double over[2][6] = {{1, 3, 3, 1, 1, 1}, {1, 5, 10, 10, 5, 1}};
    const Form<kDegree> raised(f);
    for (int i = 0; i <= kDegree; ++i) curve->c[i] = raised.c[i] / over[kDegree == 3 ? 0 : 1][i];
  }

  void find_conditions() noexcept {
    auto& condition = search_.whole.condition;
    if constexpr (D == 3) {
      const int view = best_view();
      for (int i = 0; i < 4; ++i) {
        constexpr int triangle[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
        put(terms_.area_of(view, triangle[i][0], triangle[i][1], triangle[i][2]), &condition[i]);
      }
    } else {
      // The axis along which the edge is longer, half way.
      const auto first = terms_.way_between(0, 1), second = terms_.way_between(0, 2);
      double apart[2];
      for (int k = 0; k < 2; ++k) apart[k] = std::fabs(half_way(first.at[k]) - half_way(second.at[k]));
      const int axis = apart[0] >= apart[1] ? 0 : 1;
      put(first.at[axis], &condition[0]);
      put(second.at[axis], &condition[1]);
    }
  }

  template <int N>
  static double half_way(const Form<N>& f) noexcept {
    double sum = 0;
    for (const double c : f.c) sum += c;
    return sum;
  }

  // The axis along which areas are largest, half way.
  int best_view() const noexcept {
    turning::Row<Form<0>, 3> u[2];
    const bool edges = terms_.kind == PairKind::kEdgeEdge;
    const int of_b = edges ? 1 : terms_.a_is_first ? 2 : 0;
    for (int i = 0; i < 2; ++i) {
      const bool is_of_b = i >= 2 - of_b;
      const int to = edges ? 1 : i + 1;
      for (int k = 0; k < 3; ++k) {
        u[i].at[k].c[0] = is_of_b ? half_way(terms_.given_b[to].at[k] - terms_.given_b[0].at[k])
                                  : half_way(terms_.given_a[to].at[k] - terms_.given_a[0].at[k]);
      }
      if (is_of_b) continue;
      turning::Row<Form<0>, 3> turned;
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          turned.at[k].c[0] += half_way(terms_.turn.row[k].at[l]) * u[i].at[l].c[0];
        }
      }
      u[i] = turned;
    }
    int best = 0;
    double most = -1;
    for (int k = 0; k < 3; ++k) {
      const double size = std::fabs(turning::cross(k, u[0], u[1]).c[0]);
      if (size > most) {
        most = size;
        best = k;
      }
    }
    return best;
  }

  const TurningPair<D>& pair_;
  const TurningWay& way_;
  Terms<Numbers> terms_;
  double scale_[2] = {1, 1}, largest_[2] = {1, 1};
  double way_bound_ = 0, area_bound_ = 0, volume_bound_ = 0;
  touch_search::Search<kDegree, kDegree, D == 3 ? 4 : 2> search_;
};

// Whether the feature that does not turn stands.
template <int D>
bool stands(const TurningPair<D>& pair) noexcept {
  const int first_count = pair.kind == PairKind::kEdgeEdge ? 2 : 1;
  for (int i = 0; i <= D; ++i) {
    if (pair.way[i < first_count ? 0 : 1] != nullptr) continue;
    for (int k = 0; k < D; ++k) {
      if (pair.start[i][k] != pair.end[i][k]) return false;
    }
  }
  return true;
}

// The pair with all lengths times one power of two, so that the largest coordinate is near 1. What underflows then is less than
// 2^-970 of the bounds.
template <int D>
class ScaledPair {
 public:
  TurningPair<D> pair;

  explicit ScaledPair(const TurningPair<D>& given) noexcept : pair(given) {
    const int first_count = given.kind == PairKind::kEdgeEdge ? 2 : 1;
    const auto raise = [this](const double* point) {
      for (int k = 0; k < D; ++k) most_ = std::fabs(point[k]) > most_ ? std::fabs(point[k]) : most_;
    };
    for (int i = 0; i <= D; ++i) {
      raise(given.start[i]);
      if (given.way[i < first_count ? 0 : 1] == nullptr) raise(given.end[i]);
    }
    for (const TurningWay* const way : given.way) {
      if (way == nullptr) continue;
      raise(way->centre);
      raise(way->place[0]);
      raise(way->place[1]);
    }
    if (!is_far_from_1()) return;
    const double scale = integers::of_bits((std::uint64_t{2046} - (integers::bits_of(most_) >> 52)) << 52);
    for (int i = 0; i <= D; ++i) {
      const bool turns = given.way[i < first_count ? 0 : 1] != nullptr;
      for (int k = 0; k < D; ++k) {
        points_[0][i][k] = scale * given.start[i][k];
        points_[1][i][k] = turns ? 0 : scale * given.end[i][k];
      }
      pair.start[i] = points_[0][i];
      pair.end[i] = points_[1][i];
    }
    for (int side = 0; side < 2; ++side) {
      if (given.way[side] == nullptr) continue;
      TurningWay& way = ways_[side] = *given.way[side];
      for (int k = 0; k < D; ++k) {
        way.centre[k] *= scale;
        way.place[0][k] *= scale;
        way.place[1][k] *= scale;
      }
      pair.way[side] = &way;
    }
  }
  ScaledPair(const ScaledPair&) = delete;
  ScaledPair& operator=(const ScaledPair&) = delete;

  // Whether lengths may be out of the filter's range though their ratios are not.
  bool is_far_from_1() const noexcept {
    return (most_ < 0x1p-90 && most_ >= 0x1p-1000) || (most_ > 0x1p90 && most_ <= 0x1p1020);
  }

 private:
  double most_ = 0;
  double points_[2][D + 1][D];
  TurningWay ways_[2];
};

template <int D>
Filtered filter_in_range(const TurningPair<D>& pair, const Asked& asked, double* time) noexcept {
  if (pair.way[0] != nullptr && pair.way[1] != nullptr) {
    return TurningFilter<D, Other::kTurns>(pair).first_touch(asked, time);
  }
  if (stands(pair)) return TurningFilter<D, Other::kStands>(pair).first_touch(asked, time);
  return TurningFilter<D, Other::kGoes>(pair).first_touch(asked, time);
}

template <int D>
DSW_COLD Filtered filter_scaled(const TurningPair<D>& pair, const Asked& asked, double* time) noexcept {
  const ScaledPair<D> scaled(pair);
  return scaled.is_far_from_1() ? filter_in_range(scaled.pair, asked, time) : Filtered::kUnknown;
}

}  // namespace

template <int D>
Filtered filter_first_touch(const TurningPair<D>& pair, const Asked& asked, double* time) noexcept {
  const Filtered answer = filter_in_range(pair, asked, time);
  return answer == Filtered::kUnknown ? filter_scaled(pair, asked, time) : answer;
}

template Filtered filter_first_touch(const TurningPair<2>&, const Asked&, double*) noexcept;
template Filtered filter_first_touch(const TurningPair<3>&, const Asked&, double*) noexcept;

}  // namespace dsw
