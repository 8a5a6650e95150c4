#include "rigid.h"

#include "../timing.h"
#include "moving_pair_truth.h"
#include "turning_pair_cases.h"

#include <dartsweep/pairs.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace dsw::pairs {

namespace {

struct Tally {
  std::size_t queries = 0, touching = 0, missed = 0, invented = 0, late = 0, time_error = 0;
  std::vector<double> ns;
};

template <int D>
void ask(const TurningCase<D>& drawn, Tally& tally) {
  constexpr std::size_t kNumbers = 17;
  double from[D * (D + 1)], to[D * (D + 1)], motions[2][kNumbers];
  for (std::size_t i = 0; i <= D; ++i) {
    std::copy_n(drawn.points.start[i].data(), D, from + D * i);
    std::copy_n(drawn.points.end[i].data(), D, to + D * i);
  }
  std::uint32_t indices[2];
  for (std::size_t side = 0; side < 2; ++side) {
    TurningWay way = drawn.ways[side];
    if (D == 2) {
      for (auto* turn : {way.turn[0], way.turn[1]}) turn[0] = turn[1] = 0;
      way.centre[2] = way.place[0][2] = way.place[1][2] = 0;
    }
    std::copy_n(way.turn[0], kNumbers, motions[side]);
    indices[side] = drawn.turns[side] ? static_cast<std::uint32_t>(side) : UINT32_MAX;
  }
  const auto kind = static_cast<std::uint8_t>(drawn.points.kind);
  dsw_pair_touch touch{};
  double least = 0;
  for (int round = 0; round < 3; ++round) {
    const double ns = bench::time_ns([&] {
      if (dsw_sweep_rigid_pairs(nullptr, D, 1, &kind, from, to, 0, motions[0], 2, indices, 0, &touch) !=
          DSW_STATUS_OK) {
        throw std::runtime_error(dsw_last_error_message());
      }
    });
    least = round == 0 ? ns : std::min(least, ns);
  }
  const FirstTouch truth = true_first_touch(drawn.pair());
  ++tally.queries;
  tally.touching += truth.touches ? 1 : 0;
  tally.missed += truth.touches && touch.touches == 0 ? 1 : 0;
  tally.invented += !truth.touches && touch.touches != 0 ? 1 : 0;
  tally.late += truth.touches && touch.time > truth.time ? 1 : 0;
  tally.time_error += truth.touches && touch.time != truth.time ? 1 : 0;
  tally.ns.push_back(least);
}

Tally ask_all(bool both_turn, std::size_t count, std::uint64_t seed) {
  Tally tally;
  Random random{seed + (both_turn ? 1 : 0)};
  for (std::size_t i = 0; i < count; ++i) {
    // A fifth is drawn evenly, and a fifth lies in the plane, as in the sets of pairs that go straight.
    const bool is_random = i % 5 == 0, in_plane = i % 5 == 1;
    const auto family = is_random
                            ? TurningFamily::kRandom
                            : static_cast<TurningFamily>(1 + random.below(static_cast<int>(TurningFamily::kCount) - 1));
    const int turning = both_turn ? 3 : 1 + random.below(2);
    if (in_plane) {
      ask(draw_turning<2>(random, family, PairKind::kVertexEdge, turning), tally);
    } else {
      const PairKind kind = random.below(2) == 0 ? PairKind::kVertexFace : PairKind::kEdgeEdge;
      ask(draw_turning<3>(random, family, kind, turning), tally);
    }
  }
  return tally;
}

}  // namespace

bool report_rigid_pairs(bench::Report& report, std::size_t count, std::uint64_t seed) {
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  std::size_t missed = 0, invented = 0, late = 0, time_error = 0;
  for (const bool both : {false, true}) {
    const Tally tally = ask_all(both, count, seed);
    const std::string key = both ? "rigid.pairs.both_turn." : "rigid.pairs.one_turns.";
    report.set(key + "queries", number(tally.queries));
    report.set(key + "touching", number(tally.touching));
    report.set(key + "ns_median", bench::median(tally.ns));
    report.set(key + "ns_p999", bench::quantile(tally.ns, 0.999));
    missed += tally.missed;
    invented += tally.invented;
    late += tally.late;
    time_error += tally.time_error;
  }
  report.set("rigid.pairs.missed", number(missed));
  report.set("rigid.pairs.false", number(invented));
  report.set("rigid.pairs.late", number(late));
  report.set("rigid.pairs.time_error", number(time_error));
  return missed + invented + time_error == 0;
}

}  // namespace dsw::pairs
