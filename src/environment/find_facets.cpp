#include "environment/find_facets.h"

#include "base/dimensions.h"
#include "base/sort.h"

#include <algorithm>

namespace dsw {
namespace {

constexpr uint32_t kNoQuery = 0xffffffffu;

/** Queries in a chain for each lowest vertex: one pass over the environment answers all. */
class Queries {
 public:
  Queries(uint32_t vertex_count, size_t count, const Memory* memory)
      : head_(vertex_count, kNoQuery, memory), next_(count, kNoQuery, head_.get_allocator()) {}

  void add(uint32_t query, uint32_t lowest) {
    next_[query] = head_[lowest];
    head_[lowest] = query;
  }
  uint32_t first(uint32_t lowest) const { return head_[lowest]; }
  uint32_t next(uint32_t query) const { return next_[query]; }

 private:
  Array<uint32_t> head_, next_;
};

}  // namespace

template <int D>
void find_facets(const Environment<D>& env, size_t count, const size_t* offsets, const uint32_t* indices,
                 HalfFacet* out, size_t* missing) {
  const Map<D>& map = env.map;
  Array<uint32_t> sorted{indices + offsets[0], indices + offsets[count], env.memory};
  const auto begin = [&](size_t i) { return sorted.begin() + static_cast<ptrdiff_t>(offsets[i] - offsets[0]); };
  Queries queries(map.vertex_count, count, env.memory);
  for (size_t i = 0; i < count; ++i) {
    out[i] = {};
    dsw::sort(begin(i), begin(i + 1));
    if (begin(i) != begin(i + 1) && *(begin(i + 1) - 1) < map.vertex_count)
      queries.add(static_cast<uint32_t>(i), *begin(i));
  }
  Array<uint32_t> face{env.memory};
  size_t found = 0;
  for_each_cell(map, [&](Cell cell) {
    const Shape shape = map.shape(cell);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(cell, f);
      if (canonical(map, h) != h) continue;
      face.clear();
      for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { face.push_back(map.vertex(cell, local)); });
      const uint32_t lowest = *std::min_element(face.begin(), face.end());
      if (queries.first(lowest) == kNoQuery) continue;
      dsw::sort(face.begin(), face.end());
      for (uint32_t i = queries.first(lowest); i != kNoQuery; i = queries.next(i)) {
        if (out[i].valid() || !std::equal(face.begin(), face.end(), begin(i), begin(i + 1))) continue;
        out[i] = h;
        ++found;
      }
    }
  });
  *missing = count - found;
}

DSW_INSTANTIATE(find_facets);

void find_edges(const Environment<3>& env, size_t count, const uint32_t* indices, Dart* out, size_t* missing) {
  const Map<3>& map = env.map;
  Queries queries(map.vertex_count, count, env.memory);
  for (size_t i = 0; i < count; ++i) {
    out[i] = {};
    const uint32_t a = std::min(indices[2 * i], indices[2 * i + 1]), b = std::max(indices[2 * i], indices[2 * i + 1]);
    if (a < b && b < map.vertex_count) queries.add(static_cast<uint32_t>(i), a);
  }
  size_t found = 0;
  for_each_cell(map, [&](Cell cell) {
    const Shape shape = map.shape(cell);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (shape.dart_beta2(d) < d) continue;
      const uint32_t u = map.vertex(cell, shape.dart_vertex(d)),
                     v = map.vertex(cell, shape.dart_vertex(shape.beta1(d)));
      for (uint32_t i = queries.first(std::min(u, v)); i != kNoQuery; i = queries.next(i)) {
        if (out[i].cell.valid() || std::max(indices[2 * i], indices[2 * i + 1]) != std::max(u, v)) continue;
        out[i] = {cell, d};
        ++found;
      }
    }
  });
  *missing = count - found;
}

}  // namespace dsw
