// When a feature that turns first enters another one that stands or goes straight, by integers: touching counts only where the pair also touches
// under the shift, by which the feature that turns is displaced. Private to this folder.
//
// 1. Let V be the volume of the pair, a polynomial in time. The shift e = (e1, e2, e3) makes it V + e1 V1 + e2 V2 + e3 V3, where
//    e2 is much smaller than any power of e1, and e3 than any of e2.
// 2. The first of these polynomials that is not 0 at all times leads. The shifted pair can touch only beside a root of the leading
//    polynomial where the pair touches.
// 3. Near a root, list V, V1, V2, V3. Skip each polynomial whose order there is not lower than that of all before it. Stop at the
//    first that is not 0 there. Each one left gives its sign on each side: the first one furthest from the root, the last one at it.
// 4. At time 0 there is nothing before, and at time 1 nothing after.
// 5. If all these signs are equal, the shifted pair is apart: the motion only touches, or leaves, or slides. If they differ, the
//    shifted pair is in one plane at a time beside the root.
//
// There it touches if it touches strictly at the root. If an area A is 0 there and the root is simple, the root goes with
// e_m by s = -V_m / V', and A changes by A_m + A' s. If A_m and A' are 0, it changes by A_m' s + A'' s s / 2 to the second order. If
// V_m and A_m are 0 at the root, or A and A_m at all times, e_m changes nothing, and the next one decides. What this leaves open
// counts as entering, but at time 0 find_first sets *is_open instead.
#pragma once

#include "predicates/polynomial_parts.h"
#include "predicates/turning_pair_exact.h"

namespace dsw {

template <int D>
class ExactCrossing {
 public:
  ExactCrossing(IntegerPool& pool, const TurningPair<D>& pair) : pool_(pool), plain_(pool, pair), pair_(pair) {}

  // Whether the shifted feature enters the other one; *first is then when. *is_open is set if the rule does not say what
  // happens at time 0.
  bool find_first(Root* first, bool* is_open) {
    volume_[0] = plain_.volume();
    for (int m = 1; m <= D; ++m) volume_[m] = shifted(m).volume() - volume_[0];
    leading_ = 0;
    while (leading_ <= D && volume_[leading_].degree < 0) ++leading_;
    if (leading_ > D) return false;
    Root roots[Polynomial::kMostDegree];
    const int count = find_roots(pool_, volume_[leading_], roots);
    for (int i = 0; i < count; ++i) {
      if (!plain_.touches(roots[i])) continue;
      const Answer answer = judge(roots[i]);
      if (answer == Answer::kApart) continue;
      if (answer == Answer::kOpen && is_at(roots[i], 0)) {
        *is_open = true;
        continue;
      }
      *first = roots[i];
      return true;
    }
    return false;
  }

 private:
  using Pair = ExactTurningPair<D, false>;
  enum class Answer { kApart, kEnters, kOpen };

  Pair& shifted(int m) {
    if (!shifted_[m - 1]) shifted_[m - 1] = std::make_unique<Pair>(pool_, pair_, m - 1);
    return *shifted_[m - 1];
  }

  // Whether a root is 0, or 1.
  bool is_at(const Root& root, std::uint64_t time) {
    Polynomial line;
    line.degree = 1;
    line.c[0] = integer_of(pool_, time, true);
    line.c[1] = integer_of(pool_, std::uint64_t{1});
    return sign_at(line, root) == 0;
  }

  // The order of a root of p, or 0 if it is none, and the sign of p after it.
  struct Order {
    int order, after;
  };
  Order order_at(Polynomial p, const Root& root) {
    Order r{0, sign_at(p, root)};
    for (; r.after == 0; ++r.order) {
      p = derivative_of(p);
      r.after = sign_at(p, root);
    }
    return r;
  }

  Answer judge(const Root& root) {
    const bool begins = is_at(root, 0), ends = is_at(root, 1);
    const Order leading = order_at(volume_[leading_], root);
    bool signs[3] = {};  // which of -1, 0 and 1 there are
    const auto note = [&](const Order& order) {
      if (!ends || order.order == 0) signs[1 + order.after] = true;
      if (!begins || order.order == 0) signs[1 + (order.order % 2 == 0 ? order.after : -order.after)] = true;
    };
    note(leading);
    int lowest = leading.order;
    for (int m = leading_ + 1; m <= D && lowest > 0; ++m) {
      if (volume_[m].degree < 0) continue;
      const Order order = order_at(volume_[m], root);
      if (order.order >= lowest) continue;
      lowest = order.order;
      note(order);
    }
    // Two edges in one plane at all times are parallel then, and the shift takes them off each other.
    if (lowest > 0 && leading_ > 0 && leading.order == 1) return Answer::kApart;
    if (!(signs[0] && signs[2])) return lowest == 0 ? Answer::kApart : Answer::kOpen;
    return judge_border(root, leading.order == 1 && leading_ == 0);
  }

  // The shifted pair is in one plane beside the root: whether it touches there.
  Answer judge_border(const Root& root, bool is_simple) {
    if constexpr (D == 3) {
      for (int view = 0; view < 3; ++view) {
        int sign[4];
        bool any = false, all = true;
        for (int i = 0; i < 4; ++i) {
          sign[i] = sign_at(plain_.area(view, i), root);
          any = any || sign[i] != 0;
          all = all && sign[i] != 0;
        }
        if (!any) continue;
        for (int i = 0; i < 4 && !all; ++i) {
          if (sign[i] != 0) continue;
          if (is_simple) {
            sign[i] = shifted_sign(root, plain_.area(view, i),
                                   [&](int m) { return shifted(m).area(view, i) - plain_.area(view, i); });
          }
          if (sign[i] == 0) return Answer::kOpen;
        }
        return exact_touch::areas_part(plain_.kind(), sign) ? Answer::kApart : Answer::kEnters;
      }
      return Answer::kOpen;
    } else {
      for (int axis = 0; axis < 2; ++axis) {
        int sign[2];
        for (int i = 0; i < 2; ++i) sign[i] = sign_at(plain_.difference(axis, 0, i + 1), root);
        if (sign[0] == 0 && sign[1] == 0) continue;
        for (int i = 0; i < 2; ++i) {
          if (sign[i] != 0) continue;
          const Polynomial plain = plain_.difference(axis, 0, i + 1);
          if (is_simple) {
            sign[i] = shifted_sign(root, plain, [&](int m) { return shifted(m).difference(axis, 0, i + 1) - plain; });
          }
          if (sign[i] == 0) return Answer::kOpen;
        }
        return sign[0] == sign[1] ? Answer::kApart : Answer::kEnters;
      }
      return Answer::kOpen;
    }
  }

  // The sign, where the shifted volume is 0, of what is 0 at a simple root of the volume; 0 if it is left open. by(m) is
  // what e_m changes of it.
  template <class By>
  int shifted_sign(const Root& root, const Polynomial& of, By by) {
    const Polynomial slope = derivative_of(volume_[0]), own_slope = derivative_of(of);
    bool is_first = true;
    for (int m = 1; m <= D; ++m) {
      const Polynomial change = by(m);
      if (of.degree < 0 && change.degree < 0) continue;
      if (sign_at(volume_[m], root) == 0 && sign_at(change, root) == 0) {
        is_first = false;
        continue;
      }
      const int along = -sign_at(volume_[m], root) * sign_at(slope, root);  // the sign of s
      if (sign_at(change, root) == 0 && sign_at(own_slope, root) == 0) {
        if (!is_first) return 0;
        const Polynomial twice = derivative_of(change) + derivative_of(change);
        return along * sign_of(twice, slope, derivative_of(own_slope), volume_[m], root) * sign_at(slope, root);
      }
      return sign_of(change, slope, own_slope, volume_[m], root) * sign_at(slope, root);
    }
    return 0;
  }

  Polynomial derivative_of(const Polynomial& p) {
    return p.degree > 0 ? polynomials::derivative(pool_, p) : Polynomial();
  }

  // The sign of a b - c d, or 0 if its degree may be too large.
  static int sign_of(const Polynomial& a, const Polynomial& b, const Polynomial& c, const Polynomial& d,
                     const Root& root) {
    if (a.degree + b.degree > Polynomial::kMostDegree || c.degree + d.degree > Polynomial::kMostDegree) return 0;
    return sign_at(a * b - c * d, root);
  }

  IntegerPool& pool_;
  Pair plain_;
  const TurningPair<D>& pair_;
  std::unique_ptr<Pair> shifted_[D];
  Polynomial volume_[D + 1];  // and what each component of the shift changes of it
  int leading_ = 0;
};

}  // namespace dsw
