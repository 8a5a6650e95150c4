// The first touch of a pair from the curves of its volume, areas and differences of coordinates, as exact_touch.h explains. It
// answers where the signs of these curves are easy to tell, which is nearly always; else ExactTouch answers. Private to this
// folder.
#pragma once

#include <optional>

#include "predicates/bernstein.h"
#include "predicates/flat_pair.h"

namespace dsw {

// Curves: volume(), area(view, triangle) and difference(axis, i, j) return curves in the sense of bernstein.h, or references to
// them. i and j are points of two features. volume_at_start() and area_at_start(view, triangle) are signs at time 0, which take less:
// pairs that touch from the start on are common.
template <int D, class Curves>
class QuickTouch {
 public:
  QuickTouch(Curves& curves, PairKind kind) noexcept : curves_(curves), kind_(kind) {}

  // Whether the answer is known: *first is it then.
  bool find_first(FirstTouch* first) {
    if (curves_.volume_at_start() == 0 && touches_at_start()) return answer(kStart, first);
    const auto& volume = curves_.volume();
    if (bernstein::is_zero(volume)) return find_first_change(first);
    Place places[bernstein::kMostDegree];
    int count = 0;
    if (!find_roots(volume, places, &count)) {
      *first = {false, 0};
      return consider_factors(volume, first);
    }
    for (int i = 0; i < count; ++i) {
      const Answer here = touches(places[i], volume);
      if (here == Answer::kOpen) return false;
      if (here == Answer::kYes) return answer(places[i], first);
    }
    if (volume.sign(volume.degree()) == 0 && touches(kEnd, volume) == Answer::kYes) return answer(kEnd, first);
    *first = {false, 0};
    return true;
  }

 private:
  using Place = bernstein::Place;
  enum class Answer { kNo, kYes, kOpen };
  static constexpr Place kStart = {0, true}, kEnd = {1, true};
  static constexpr int kViews = D == 3 ? 3 : 1;

  struct AreaSigns {
    int of[kViews][4];
    AreaSigns() noexcept {
      for (auto& view : of) view[0] = view[1] = view[2] = view[3] = kOpenSign;
    }
  };

  static bool answer(const Place& place, FirstTouch* first) {
    *first = {true, place.floor, place.is_exact};
    return true;
  }

  // Whether the pair touches at the start, where the volume is 0.
  bool touches_at_start() {
    return exact_touch::flat_pair_touches<D>(
        kind_, [this](int view, int i) { return curves_.area_at_start(view, i); },
        [this](int axis, int i, int j) { return curves_.difference(axis, i, j).sign(0); });
  }

  // Whether the pair touches at a root of a curve, where the volume is 0.
  template <class Curve>
  Answer touches(const Place& place, const Curve& of) {
    AreaSigns signs;
    const Answer first = touches(place, of, false, signs);
    return first == Answer::kOpen ? touches(place, of, true, signs) : first;
  }

  // The sign of a curve at a root of another one; with_ties also where it may be 0.
  template <class Curve, class Other>
  int sign_at(const Curve& curve, const Place& place, const Other& of, bool with_ties) {
    if (static_cast<const void*>(&curve) == &of) return 0;
    const int sign = bernstein::sign_at(curve, place);
    return sign == kOpenSign && with_ties ? curve.sign_at_root(of, place) : sign;
  }

  // with_ties: signs that are still open are asked again.
  template <class Curve>
  Answer touches(const Place& place, const Curve& of, bool with_ties, AreaSigns& signs) {
    if constexpr (D == 3) {
      bool all_zero = true;
      for (int view = 0; view < 3; ++view) {
        int(&sign)[4] = signs.of[view];
        bool any = false, is_open = false;
        for (int i = 3; i >= 0; --i) {  // the triangle of a vertex and a triangle first
          if (sign[i] == kOpenSign) {
            const auto& area = curves_.area(view, i);
            sign[i] = with_ties ? area.sign_at_root(of, place) : sign_at(area, place, of, false);
          }
          if (known_areas_part(sign)) return Answer::kNo;
          is_open = is_open || sign[i] == kOpenSign;
          any = any || (sign[i] != 0 && sign[i] != kOpenSign);
        }
        all_zero = all_zero && !any && !is_open;
        if (any && !is_open) return exact_touch::areas_part(kind_, sign) ? Answer::kNo : Answer::kYes;
      }
      if (!all_zero) return Answer::kOpen;
    }
    return touches_in_line(place, of, with_ties);
  }

  // areas_part where some signs are open.
  bool known_areas_part(const int (&sign)[4]) const noexcept {
    const auto product = [&](int i, int j) {
      return sign[i] == kOpenSign || sign[j] == kOpenSign ? 0 : sign[i] * sign[j];
    };
    if (kind_ == PairKind::kEdgeEdge) return product(0, 1) > 0 || product(2, 3) > 0;
    return product(2, 3) < 0 || product(1, 3) > 0 || product(0, 3) < 0;
  }

  template <class Curve>
  Answer touches_in_line(const Place& place, const Curve& of, bool with_ties) {
    const exact_touch::Opposite& pairs = exact_touch::opposite(kind_);
    bool is_open = false;
    for (int k = 0; k < D; ++k) {
      int first = 0;
      bool apart = true, may_be_apart = true;
      for (int i = 0; i < pairs.count && may_be_apart; ++i) {
        const int sign = sign_at(curves_.difference(k, pairs.pair[i][0], pairs.pair[i][1]), place, of, with_ties);
        if (sign == kOpenSign) {
          apart = false;
          continue;
        }
        if (first == 0) first = sign;
        may_be_apart = sign != 0 && sign == first;
      }
      if (may_be_apart && apart) return Answer::kNo;
      is_open = is_open || may_be_apart;
    }
    return is_open ? Answer::kOpen : Answer::kYes;
  }

  // The volume is always 0, and the pair does not touch at the start.
  bool find_first_change(FirstTouch* first) {
    *first = {false, 0};
    if constexpr (D == 3) {
      for (int k = 0; k < 3; ++k) {
        bool seen = false;
        for (int i = 0; i < 4; ++i) seen = seen || !bernstein::is_zero(curves_.area(k, i));
        if (!seen) continue;
        for (int i = 0; i < 4; ++i) {
          if (!consider(curves_.area(k, i), first)) return false;
        }
        return true;
      }
    }
    const exact_touch::Opposite& pairs = exact_touch::opposite(kind_);
    for (int k = 0; k < D; ++k) {
      for (int i = 0; i < pairs.count; ++i) {
        if (!consider(curves_.difference(k, pairs.pair[i][0], pairs.pair[i][1]), first)) return false;
      }
    }
    return true;
  }

  // Whether it is known at which of the curve's roots after the start the pair first touches, if this is before *first.
  template <class Curve>
  bool consider(const Curve& curve, FirstTouch* first) {
    if (bernstein::is_zero(curve)) return true;
    Place places[bernstein::kMostDegree + 1];
    int count = 0;
    if (!find_roots(curve, places, &count)) return consider_factors(curve, first);
    if (curve.sign(curve.degree()) == 0) places[count++] = kEnd;
    for (int i = 0; i < count; ++i) {
      const Place& place = places[i];
      if (first->touches && (place.floor > first->time || (place.floor == first->time && first->is_exact))) return true;
      const Answer here = touches(place, curve);
      if (here == Answer::kOpen) return false;
      if (here == Answer::kYes) return answer(place, first);
    }
    return true;
  }

  // Roots strictly inside of [0,1]. False: there may be repeated ones.
  template <class Curve>
  bool find_roots(const Curve& curve, Place* places, int* count) {
    bernstein::Isolation<Curve> isolation(curve, places);
    bool is_known = isolation.find();
    *count = isolation.found();
    if (is_known) return true;
    const int discriminant = curves_.discriminant(curve);
    if (discriminant == 0 || discriminant == kOpenSign) return false;
    bernstein::Isolation<Curve> again(curve, places, discriminant);
    is_known = again.find();
    *count = again.found();
    return is_known;
  }

  template <class Curve>
  bool consider_factors(const Curve& curve, FirstTouch* first) {
    std::optional<Curve> lines[2];
    const int count = curves_.factors(curve, lines);
    for (int i = 0; i < count; ++i) {
      if (!consider(*lines[i], first)) return false;
    }
    return count > 0;
  }

  Curves& curves_;
  PairKind kind_;
};

}  // namespace dsw
