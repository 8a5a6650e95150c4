#include "environment/general_records.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/sort.h"

namespace dsw {
namespace {

/** The place of a facet's vertex with the lowest rank. */
template <class Rank>
uint16_t lowest_of(const GeneralCell& cell, uint32_t facet, Rank rank) {
  const uint32_t first = cell.first[facet], end = cell.first[facet + 1];
  if (first == end) return 0;  // of a damaged stream
  uint32_t best = first;
  auto lowest = rank(cell.points[cell.vertices[first]]);
  for (uint32_t k = first + 1; k < end; ++k) {
    const auto here = rank(cell.points[cell.vertices[k]]);
    if (!(here < lowest)) continue;
    best = k;
    lowest = here;
  }
  return static_cast<uint16_t>(best - first);
}

}  // namespace

template <int D>
bool GeneralRecords<D>::write(uint32_t i, const GeneralCell& cell) {
  return D == 3 ? write_polyhedron(i, cell) : write_polygon(i, cell);
}

template <int D>
bool GeneralRecords<D>::write_polyhedron(uint32_t i, const GeneralCell& cell) {
  const uint32_t facets = cell.facet_count();
  base_.resize(facets);
  for (uint32_t f = 0; f < facets; ++f) base_[f] = base_of(cell, f);
  const auto table = static_cast<uint32_t>(map_.shape_tables.size());
  const FacetLoops loops{cell.vertices.data(), cell.first.data(), facets, static_cast<uint32_t>(cell.points.size())};
  if (append_polyhedron(loops, base_.data(), map_.shape_tables) != ShapeDefect::kNone) return false;
  map_.shape_offsets.push_back(table);
  write_record(i, static_cast<uint32_t>(map_.shape_offsets.size() - 1), cell);
  return true;
}

template <int D>
bool GeneralRecords<D>::write_polygon(uint32_t i, const GeneralCell& cell) {
  sorted_ = cell.points;
  dsw::sort(sorted_.begin(), sorted_.end());
  if (std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end()) return false;
  const uint32_t number = polygon_shape(cell.points.size());
  if (number == kNoShape) return false;
  write_record(i, number, cell);
  return true;
}

/** From which place of a facet it is cut: the lowest vertex, so that both sides agree. */
template <int D>
uint16_t GeneralRecords<D>::base_of(const GeneralCell& cell, uint32_t facet) const {
  if (poor_fans_ == nullptr || cell.first[facet + 1] - cell.first[facet] < 5) {
    return lowest_of(cell, facet, [](uint32_t v) { return v; });
  }
  return lowest_of(cell, facet, [this](uint32_t v) {
    const bool is_poor = ((*poor_fans_)[v / 64] >> v % 64 & 1) != 0;
    return is_poor ? uint64_t{v} + kVertexMask : v;  // behind all vertices
  });
}

/** The shape that all polygons with so many corners share; kNoShape: there is none. */
template <int D>
uint32_t GeneralRecords<D>::polygon_shape(size_t corners) {
  if (corners >= polygon_shapes_.size()) polygon_shapes_.resize(corners + 1, kNoShape);
  uint32_t& number = polygon_shapes_[corners];
  const auto table = static_cast<uint32_t>(map_.shape_tables.size());
  if (number == kNoShape && append_polygon(static_cast<uint32_t>(corners), map_.shape_tables) == ShapeDefect::kNone) {
    number = static_cast<uint32_t>(map_.shape_offsets.size());
    map_.shape_offsets.push_back(table);
  }
  return number;
}

template <int D>
void GeneralRecords<D>::write_record(uint32_t i, uint32_t number, const GeneralCell& cell) {
  uint32_t* const w = map_.record(map_.cell(i));
  const Shape shape(map_.shape_tables.data() + map_.shape_offsets[number]);
  const uint32_t facets = shape.facet_count(), vertices = shape.vertex_count();
  w[0] = (static_cast<uint32_t>(Form::kGeneral) << kFormShift) | number;
  write_continuations<D>(w, general_units<D>(facets, vertices));
  for (uint32_t f = 0; f < facets; ++f) w[item_word<D>(f)] = kNoFacet;
  for (uint32_t k = 0; k < vertices; ++k) w[item_word<D>(first_vertex_item<D>(facets) + k)] = cell.points[k];
}

template class GeneralRecords<2>;
template class GeneralRecords<3>;

}  // namespace dsw
