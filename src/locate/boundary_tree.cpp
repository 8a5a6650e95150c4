#include "locate/boundary_tree.h"

namespace dsw {
namespace {

template <int D>
Vec middle_of(const Environment<D>& env, const OuterSimplex<D>& simplex) {
  Vec sum;
  for (const uint32_t v : simplex.vertices) sum += to_vec<D>(env.point(v));
  return sum;
}

/** The normal of a simplex, as long as it is large. */
Vec normal_of(const Environment<3>& env, const OuterSimplex<3>& simplex) {
  const double* const a = env.point(simplex.vertices[0]);
  return difference<3>(env.point(simplex.vertices[1]), a).cross(difference<3>(env.point(simplex.vertices[2]), a));
}
Vec normal_of(const Environment<2>& env, const OuterSimplex<2>& simplex) {
  return turned(difference<2>(env.point(simplex.vertices[1]), env.point(simplex.vertices[0])));
}

}  // namespace

template <int D>
BoundaryTree<D>::BoundaryTree(const Environment<D>& env) : simplices_(env.memory), groups_(env.memory) {
  gather(env);
  double lower[D], upper[D], size = 0;
  std::fill_n(lower, D, HUGE_VAL);
  std::fill_n(upper, D, -HUGE_VAL);
  for (const OuterSimplex<D>& each : simplices_) {
    for (const uint32_t v : each.vertices) {
      for (int k = 0; k < D; ++k) {
        lower[k] = std::min(lower[k], env.point(v)[k]);
        upper[k] = std::max(upper[k], env.point(v)[k]);
      }
    }
  }
  for (int k = 0; k < D; ++k) {
    middle_[k] = lower[k] / 2 + upper[k] / 2;
    size = std::max(size, upper[k] / 2 - lower[k] / 2);
  }
  scale_ = size > 0x1p-500 && size < 0x1p+500 ? 1 / size : 0;
  if (scale_ > 0) arrange(env);
}

template <int D>
void BoundaryTree<D>::gather(const Environment<D>& env) {
  simplices_.reserve(env.map.boundary_facet_count * (D == 3 ? 2 : 1));
  for_each_cell(env.map, [&](Cell c) {
    for (uint32_t f = 0, facets = env.map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = env.map.half_facet(c, f);
      if (env.map.opposite(h).valid()) continue;
      const Shape shape = env.map.shape(c);
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        OuterSimplex<D> simplex;
        for (uint32_t k = 0; k < D; ++k) simplex.vertices[k] = env.map.vertex(c, shape.simplices()[s * D + k]);
        simplex.facet = h;
        simplices_.push_back(simplex);
      }
    }
  });
}

/** Halves ranges along their longest axis, the first part as large as a power of two of leaves. So what a group of any
 * level holds follows each other. */
template <int D>
void BoundaryTree<D>::arrange(const Environment<D>& env) {
  struct Item {
    Vec middle;
    OuterSimplex<D> simplex;
  };
  Array<Item> items(env.memory);
  items.reserve(simplices_.size());
  for (const OuterSimplex<D>& each : simplices_) items.push_back({middle_of(env, each), each});
  struct Range {
    size_t first, end;
  } ranges[64];
  uint32_t depth = 0;
  ranges[depth++] = {0, items.size()};
  while (depth != 0) {
    const Range range = ranges[--depth];
    if (range.end - range.first <= kLeaf) continue;
    Vec lower = items[range.first].middle, upper = lower;
    for (size_t i = range.first; i < range.end; ++i) {
      const Vec& at = items[i].middle;
      lower = {std::min(lower.x(), at.x()), std::min(lower.y(), at.y()), std::min(lower.z(), at.z())};
      upper = {std::max(upper.x(), at.x()), std::max(upper.y(), at.y()), std::max(upper.z(), at.z())};
    }
    const Vec width = upper - lower;
    const int axis = width.x() >= width.y() && width.x() >= width.z() ? 0 : width.y() >= width.z() ? 1 : 2;
    size_t half = kLeaf;
    while (2 * half < range.end - range.first) half *= 2;
    Item* const begin = items.data() + range.first;
    std::nth_element(begin, begin + half, items.data() + range.end,
                     [axis](const Item& a, const Item& b) { return a.middle[axis] < b.middle[axis]; });
    ranges[depth++] = {range.first + half, range.end};
    ranges[depth++] = {range.first, range.first + half};
  }
  for (size_t i = 0; i < items.size(); ++i) simplices_[i] = items[i].simplex;
  size_t boxes = (simplices_.size() + kLeaf - 1) / kLeaf, held = kLeaf;
  do {
    const size_t groups = (boxes + kWidth - 1) / kWidth;
    level_first_[level_count_++] = groups_.size();
    groups_.resize(groups_.size() + groups);
    for (size_t i = 0; i < groups * kWidth; ++i) {
      const size_t first = std::min(i * held, simplices_.size()), end = std::min(first + held, simplices_.size());
      enclose(env, first, end, groups_[level_first_[level_count_ - 1] + i / kWidth], static_cast<uint32_t>(i % kWidth));
    }
    boxes = groups;
    held *= kWidth;
  } while (boxes > 1);
}

/** Fits one box of a group. */
template <int D>
void BoundaryTree<D>::enclose(const Environment<D>& env, size_t first, size_t end, Group& group, uint32_t lane) const {
  Vec normal;
  for (size_t i = first; i < end; ++i) normal += scale_ * (scale_ * normal_of(env, simplices_[i]));
  const Vec up = is_zero(unit(normal)) ? Vec::Unit(0) : unit(normal);
  const Vec sizes = up.magnitudes();
  const int least = sizes.x() <= sizes.y() && sizes.x() <= sizes.z() ? 0 : sizes.y() <= sizes.z() ? 1 : 2;
  const Vec across = D == 2 ? turned(up) : unit(up.cross(Vec::Unit(least)));
  const Vec axes[3] = {up, across, D == 2 ? Vec::Unit(2) : up.cross(across)};
  Vec middle;
  double low[3], high[3];
  std::fill_n(low, 3, HUGE_VAL);
  std::fill_n(high, 3, -HUGE_VAL);
  for (size_t i = first; i < end; ++i) {
    for (const uint32_t v : simplices_[i].vertices) {
      const Vec at = scale_ * (to_vec<D>(env.point(v)) - to_vec<D>(middle_));
      for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], dot(at, axes[a]));
        high[a] = std::max(high[a], dot(at, axes[a]));
      }
    }
  }
  if (first < end) {
    for (int a = 0; a < 3; ++a) middle += (low[a] + high[a]) / 2 * axes[a];
  }
  for (int a = 0; a < 3; ++a) {
    group.middle[a][lane] = static_cast<float>(middle[a]);
    for (int k = 0; k < 3; ++k) group.axes[a][k][lane] = static_cast<float>(axes[a][k]);
    group.halves[a][lane] = first < end ? static_cast<float>((high[a] - low[a]) / 2 + 0x1p-19) : -1;
  }
}

template class BoundaryTree<2>;
template class BoundaryTree<3>;

}  // namespace dsw
