#include "generated.h"

#include "moving_pair_cases.h"
#include "moving_pair_truth.h"

#include <algorithm>

namespace dsw::pairs {

namespace {

template <int D>
FirstTouch truth_of(const Query& query) {
  MovingPair<D> pair{static_cast<PairKind>(query.kind), {}, {}};
  for (std::size_t i = 0; i <= D; ++i) {
    pair.start[i] = query.start[i].data();
    pair.end[i] = query.end[i].data();
  }
  return true_first_touch(pair);
}

template <int D>
Query draw_query(Random& random, MovingFamily family, PairKind kind) {
  MovingCase<D> drawn;
  draw(random, family, kind, drawn);
  Query query{};
  query.kind = static_cast<std::uint8_t>(kind);
  for (std::size_t i = 0; i <= D; ++i) {
    std::copy(drawn.start[i].begin(), drawn.start[i].end(), query.start[i].begin());
    std::copy(drawn.end[i].begin(), drawn.end[i].end(), query.end[i].begin());
  }
  return query;
}

using Families = std::vector<MovingFamily>;

QuerySet draw_set(const std::string& name, const Families& families, std::size_t count, Random& random, bool plane) {
  QuerySet set{name, false, {}};
  set.list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const MovingFamily family = families[static_cast<std::size_t>(random.below(static_cast<int>(families.size())))];
    const PairKind kind = i % 2 == 0 ? PairKind::kVertexFace : PairKind::kEdgeEdge;
    set.list.push_back(plane ? draw_query<2>(random, family, PairKind::kVertexEdge)
                             : draw_query<3>(random, family, kind));
  }
  return set;
}

}  // namespace

Truth exact_truth(const Query& query) {
  const FirstTouch touch =
      query.kind == static_cast<std::uint8_t>(PairKind::kVertexEdge) ? truth_of<2>(query) : truth_of<3>(query);
  return {touch.touches, touch.time};
}

std::vector<QuerySet> generate_sets(std::size_t count, std::uint64_t seed) {
  Random random{seed};
  const Families uniform = {MovingFamily::kUniform};
  const Families structured = {MovingFamily::kLattice,      MovingFamily::kTouchAtStart, MovingFamily::kTouchAtEnd,
                               MovingFamily::kTouchBetween, MovingFamily::kNearMiss,     MovingFamily::kRounded,
                               MovingFamily::kOffset,       MovingFamily::kPointSet};
  Families all, degenerate;
  for (int i = 0; i < static_cast<int>(MovingFamily::kCount); ++i) {
    const auto family = static_cast<MovingFamily>(i);
    const auto is_in = [family](const Families& some) {
      return std::find(some.begin(), some.end(), family) != some.end();
    };
    all.push_back(family);
    if (!is_in(uniform) && !is_in(structured)) degenerate.push_back(family);
  }
  const std::size_t some = count / 5;
  std::vector<QuerySet> sets;
  sets.push_back(draw_set("random", uniform, some, random, false));
  sets.push_back(draw_set("structured", structured, some, random, false));
  sets.push_back(draw_set("degenerate", degenerate, count - 3 * some, random, false));
  sets.push_back(draw_set("in the plane", all, some, random, true));
  return sets;
}

}  // namespace dsw::pairs
