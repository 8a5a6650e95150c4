#pragma once
// The facets that have one cell, with their loops, triangles and boxes.

#include "base/search.h"
#include "environment/box_pairs.h"
#include "environment/environment.h"

namespace dsw {

/** Items of a list in which they follow each other. */
struct VertexRange {
  const uint32_t *first, *last;
  const uint32_t* begin() const { return first; }
  const uint32_t* end() const { return last; }
  uint32_t size() const { return static_cast<uint32_t>(last - first); }
  uint32_t operator[](uint32_t i) const { return first[i]; }
  /** The item after number i, round the loop. */
  uint32_t after(uint32_t i) const { return first[i + 1 == size() ? 0 : i + 1]; }
};

/** Loops of vertices, one after the other. */
struct Loops {
  Array<uint32_t> vertices, first;  // first: of each loop, and where the last one ends

  explicit Loops(const Memory* memory) : vertices(memory), first(memory) { first.push_back(0); }
  uint32_t count() const { return static_cast<uint32_t>(first.size() - 1); }
  VertexRange operator[](uint32_t i) const { return {vertices.data() + first[i], vertices.data() + first[i + 1]}; }
  void clear() {
    vertices.clear();
    first.assign(1, 0);
  }
  void end_loop() { first.push_back(static_cast<uint32_t>(vertices.size())); }
  /** Takes all loops away but the first ones, so many. */
  void shrink(uint32_t loops) {
    first.resize(size_t{loops} + 1);
    vertices.resize(first.back());
  }
  void add(VertexRange loop) {
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    end_loop();
  }
};

template <int D>
class OuterFacets {
 public:
  /** In the order of cells. Throws std::bad_alloc. */
  explicit OuterFacets(const Environment<D>& env)
      : env_(env),
        facets_(env.memory),
        loop_first_(env.memory),
        loops_(env.memory),
        simplex_first_(env.memory),
        simplices_(env.memory),
        boxes_(env.memory) {
    const size_t count = env.map.boundary_facet_count;
    facets_.reserve(count);
    loop_first_.reserve(count + 1);
    loops_.reserve(count * (D == 3 ? 4 : 2));
    simplex_first_.reserve(count + 1);
    simplices_.reserve(count * (D == 3 ? 6 : 2));
    boxes_.reserve(count);
    for_each_cell(env.map, [&](Cell c) {
      for (uint32_t f = 0, facets = env.map.facets_of(c); f < facets; ++f) {
        const HalfFacet h = env.map.half_facet(c, f);
        if (!env.map.opposite(h).valid()) add(c, env.map.shape(c), f, h);
      }
    });
    loop_first_.push_back(static_cast<uint32_t>(loops_.size()));
    simplex_first_.push_back(static_cast<uint32_t>(simplices_.size()));
  }

  uint32_t count() const { return static_cast<uint32_t>(facets_.size()); }
  HalfFacet facet(uint32_t i) const { return facets_[i]; }
  Cell cell(uint32_t i) const { return env_.map.cell_of(facets_[i]); }
  /** The number of an outer facet. O(log n). */
  uint32_t find(HalfFacet h) const {
    const uint32_t wanted = env_.map.index(env_.map.cell_of(h));
    const auto first = std::partition_point(facets_.begin(), facets_.end(), [&](HalfFacet each) {
      return env_.map.index(env_.map.cell_of(each)) < wanted;
    });
    const auto at = dsw::find_if(first, facets_.end(), [h](HalfFacet each) { return each.word == h.word; });
    return static_cast<uint32_t>(at - facets_.begin());
  }
  /** Its vertices, counter-clockwise seen from outside; in the plane its two ends, the cell on the left. */
  VertexRange loop(uint32_t i) const { return range(loops_, loop_first_, i); }
  /** Its simplices, D vertices each. */
  VertexRange simplices(uint32_t i) const { return range(simplices_, simplex_first_, i); }
  const ClosedBox<D>& box(uint32_t i) const { return boxes_[i]; }
  /** Pairs of facets that may overlap. Throws std::bad_alloc. */
  BoxPairs<D> pairs() const {
    const auto box_of = [this](uint32_t i) -> const ClosedBox<D>& { return boxes_[i]; };
    return BoxPairs<D>(box_of, count(), 0, env_.memory);
  }
  /** Pairs of places among `chosen` facets, which may overlap, or would if one of them moved by `room`. Throws std::bad_alloc. */
  BoxPairs<D> pairs(const Array<uint32_t>& chosen, double room) const {
    const auto box_of = [&](uint32_t at) -> const ClosedBox<D>& { return boxes_[chosen[at]]; };
    return BoxPairs<D>(box_of, static_cast<uint32_t>(chosen.size()), room, env_.memory);
  }

 private:
  void add(Cell c, const Shape& shape, uint32_t f, HalfFacet h) {
    facets_.push_back(h);
    loop_first_.push_back(static_cast<uint32_t>(loops_.size()));
    simplex_first_.push_back(static_cast<uint32_t>(simplices_.size()));
    ClosedBox<D> box;
    for_each_facet_vertex<D>(shape, f, [&](uint32_t local) {
      const uint32_t vertex = env_.map.vertex(c, local);
      loops_.push_back(vertex);
      box.add(env_.point(vertex));
    });
    boxes_.push_back(box);
    for (uint32_t k = D * shape.simplex_first(f); k < D * shape.simplex_first(f + 1); ++k) {
      simplices_.push_back(env_.map.vertex(c, shape.simplices()[k]));
    }
  }
  static VertexRange range(const Array<uint32_t>& all, const Array<uint32_t>& first, uint32_t i) {
    return {all.data() + first[i], all.data() + first[i + 1]};
  }

  const Environment<D>& env_;
  Array<HalfFacet> facets_;
  Array<uint32_t> loop_first_, loops_, simplex_first_, simplices_;
  Array<ClosedBox<D>> boxes_;
};

}  // namespace dsw
