#include "environment/replaced_cells.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/error.h"
#include "environment/general_records.h"

namespace dsw {
namespace {

template <int D>
class Rewriting {
 public:
  Rewriting(Environment<D>& env, const ReplacedCells<D>& cells)
      : old_(env.map), cells_(cells), made_(env.memory), local_of_point_(env.memory) {
    made_.cell_count = old_.cell_count;
    made_.vertex_count = old_.vertex_count;
    local_of_point_.assign(D == 3 ? made_.vertex_count : 0, UINT16_MAX);
  }

  /** Returns how many sides have no link. */
  size_t run(BuildReport& report) {
    lay_out();
    GeneralRecords<D> general(made_, &cells_.poor_fans);
    GeneralCell cell;
    uint32_t k = 0;
    for (uint32_t i = 0; i < made_.cell_count; ++i) {
      if (!is_rewritten(i, k)) {
        const uint32_t* const from = old_.record(old_.cell(i));
        std::copy_n(from, size_t{units_of(i)} * kUnitWords<D>, made_.record(made_.cell(i)));
      } else {
        read(k, cell);
        if (!fits(i, cell) || !general.write(i, cell)) fail_at(i, report);
        ++k;
      }
      link(i);
    }
    std::swap(old_.words, made_.words);
    std::swap(old_.shape_tables, made_.shape_tables);
    std::swap(old_.shape_offsets, made_.shape_offsets);
    std::swap(old_.unit_of_cell, made_.unit_of_cell);
    std::swap(old_.cell_of_unit, made_.cell_of_unit);
    old_.units_per_cell = 0;
    return open_sides_;
  }

 private:
  bool is_rewritten(uint32_t i, uint32_t k) const { return k < cells_.cells.size() && cells_.cells[k] == i; }
  /** How many units a cell of standard form has. */
  uint32_t units_of(uint32_t i) const { return old_.form(old_.cell(i)) == Form::kSimplex ? 1 : 2; }

  /** Places of records, and room for shapes. A sphere has as many vertices as V - E + F = 2 says. */
  void lay_out() {
    made_.unit_of_cell.resize(made_.cell_count);
    uint64_t units = 0, shape_words = 0;
    for (uint32_t i = 0, k = 0; i < made_.cell_count; ++i) {
      made_.unit_of_cell[i] = static_cast<uint32_t>(std::min(units, kMostUnits));
      if (!is_rewritten(i, k)) {
        units += units_of(i);
        continue;
      }
      const uint32_t first = cells_.first_loop[k], last = cells_.first_loop[k + 1];
      const uint32_t ends = cells_.loops.first[last] - cells_.loops.first[first];
      const uint32_t facets = D == 3 ? last - first : ends;
      const uint32_t vertices = D == 3 ? std::max(ends / 2 + 2, facets) - facets : ends;
      units += general_units<D>(facets, vertices);
      if (D == 3) shape_words += Shape::kHeader + 2 * (facets + 1) + 8 * uint64_t{ends} - 8 * uint64_t{facets};
      ++k;
    }
    if (units >= kMostUnits) {
      fail(DSW_STATUS_TOO_LARGE, "the cells need %llu records, more than 2^28", static_cast<unsigned long long>(units));
    }
    made_.words.assign(static_cast<size_t>(units) * kUnitWords<D>, 0);
    made_.cell_of_unit.assign(static_cast<size_t>(units), kNoCell);
    for (uint32_t i = 0; i < made_.cell_count; ++i) made_.cell_of_unit[made_.unit_of_cell[i]] = i;
    made_.shape_tables.reserve(static_cast<size_t>(shape_words));
    made_.shape_offsets.reserve(cells_.cells.size());
  }

  void read(uint32_t k, GeneralCell& cell) {
    cell.clear();
    for (uint32_t f = cells_.first_loop[k]; f < cells_.first_loop[k + 1]; ++f) {
      const VertexRange loop = cells_.loops[f];
      if (D == 2) {
        cell.points.assign(loop.begin(), loop.end());
        return;
      }
      for (const uint32_t v : loop) {
        if (local_of_point_[v] == UINT16_MAX) {
          local_of_point_[v] = static_cast<uint16_t>(cell.points.size());
          cell.points.push_back(v);
        }
        cell.vertices.push_back(local_of_point_[v]);
      }
      cell.end_facet();
    }
    for (const uint32_t v : cell.points) local_of_point_[v] = UINT16_MAX;
  }

  /** Whether the record of a cell has the size that it needs, and no number of it is too large for its shape. */
  bool fits(uint32_t i, const GeneralCell& cell) const {
    const auto vertices = static_cast<uint32_t>(cell.points.size());
    const uint32_t end = i + 1 < made_.cell_count ? made_.unit_of_cell[i + 1]
                                                  : static_cast<uint32_t>(made_.words.size() / kUnitWords<D>);
    const uint32_t facets = D == 3 ? cell.facet_count() : vertices;
    return general_units<D>(facets, vertices) == end - made_.unit_of_cell[i] && cell.vertices.size() < UINT16_MAX;
  }

  [[noreturn]] void fail_at(uint32_t i, BuildReport& report) const {
    report.offenders = {};
    report.offenders.add(i);
    fail(DSW_STATUS_BAD_CELL, "cell %u repeats a point once points are merged, or its faces do not close a sphere", i);
  }

  /** Links the facets of a cell as they were, unless one of the two cells changes. */
  void link(uint32_t i) {
    const Cell c = made_.cell(i), was = old_.cell(i);
    const bool changes = cells_.has_changed(i);
    for (uint32_t f = 0, count = made_.facets_of(c); f < count; ++f) {
      uint32_t& link = made_.words[made_.half_facet(c, f).word];
      const HalfFacet o = changes ? HalfFacet{} : old_.opposite(old_.half_facet(was, f));
      const Cell beyond = o.valid() ? old_.cell_of(o) : Cell{};
      if (!o.valid() || cells_.has_changed(old_.index(beyond))) {
        link = kNoFacet;
        ++open_sides_;
        continue;
      }
      // The links of a record that does not change stay where they are in it.
      link = o.word + (made_.unit_of_cell[old_.index(beyond)] - beyond.unit) * kUnitWords<D>;
    }
  }

  Map<D>& old_;
  const ReplacedCells<D>& cells_;
  Map<D> made_;
  Array<uint16_t> local_of_point_;  // of each point, in the cell that is read
  size_t open_sides_ = 0;
};

}  // namespace

template <int D>
size_t rewrite_records(Environment<D>& env, const ReplacedCells<D>& cells, BuildReport& report) {
  return Rewriting<D>(env, cells).run(report);
}

DSW_INSTANTIATE(rewrite_records);

}  // namespace dsw
