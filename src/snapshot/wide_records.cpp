#include "snapshot/wide_records.h"

#include "map/integrity.h"
#include "snapshot/block.h"

namespace dsw {
namespace {

constexpr uint32_t kWideItems = kWideUnitWords - 1;

constexpr uint32_t wide_units_for(uint32_t items) { return (items + kWideItems - 1) / kWideItems; }
constexpr uint32_t wide_item_word(uint32_t item) { return item / kWideItems * kWideUnitWords + 1 + item % kWideItems; }

class Narrowing {
 public:
  explicit Narrowing(Map<2>& map) : map_(map), wide_(map.words), unit_at_(wide_.get_allocator()) {}

  void run() {
    lay_out();
    for (uint32_t wide = 0; wide < unit_at_.size(); ++wide) {
      if (unit_at_[wide] != kNoCell) copy_record(wide, {unit_at_[wide]});
    }
    for (uint32_t wide = 0; wide < unit_at_.size(); ++wide) {
      if (unit_at_[wide] == kNoCell) continue;
      const Cell c{unit_at_[wide]};
      for (uint32_t f = 0, count = map_.facets_of(c); f < count; ++f) {
        map_.words[map_.half_facet(c, f).word] = link(wide_[size_t{wide} * kWideUnitWords + wide_link_word(c, f)]);
      }
    }
  }

 private:
  /** Finds where each record begins, and is going to. */
  void lay_out() {
    const auto wide_units = static_cast<uint32_t>(wide_.size() / kWideUnitWords);
    unit_at_.assign(wide_units, kNoCell);
    uint32_t units = 0;
    for (uint32_t wide = 0; wide < wide_units;) {
      const uint32_t word0 = wide_[size_t{wide} * kWideUnitWords], n = record_units(map_, word0);
      if (n == 0) fail_corrupt("a record's form");
      const bool general = form_of(word0) == Form::kGeneral;
      const uint32_t wide_n = general ? 2 * wide_units_for(map_.general_shape(word0).facet_count()) : n;
      if (wide_n > wide_units - wide) fail_corrupt("a record's form");
      unit_at_[wide] = units;
      units += n;
      wide += wide_n;
    }
    map_.words = Array<uint32_t>(size_t{units} * kUnitWords<2>, 0u, wide_.get_allocator());
  }

  /** All but its links. */
  void copy_record(uint32_t wide, Cell c) {
    const uint32_t* const from = wide_.data() + size_t{wide} * kWideUnitWords;
    uint32_t* const to = map_.record(c);
    to[0] = from[0];
    const uint32_t vertices = map_.vertices_of(c);
    if (map_.form(c) != Form::kGeneral) {
      const bool apart = map_.form(c) != Form::kSimplex;
      std::copy_n(from + (apart ? kWideUnitWords : 0), vertices, to + (apart ? kUnitWords<2> : 0));
      return;
    }
    const uint32_t sides = vertices;  // as many
    write_continuations<2>(to, general_units<2>(sides, vertices));
    const uint32_t* const from_vertices = from + wide_units_for(sides) * kWideUnitWords;
    for (uint32_t k = 0; k < vertices; ++k) {
      to[item_word<2>(first_vertex_item<2>(sides) + k)] = from_vertices[wide_item_word(k)];
    }
  }

  uint32_t wide_link_word(Cell c, uint32_t facet) const {
    return map_.form(c) == Form::kGeneral ? wide_item_word(facet) : kWideUnitWords - map_.facets_of(c) + facet;
  }

  /** A link that leads to where the other side is now. */
  uint32_t link(uint32_t word) const {
    const uint32_t mark = word & kMarkBit, to = word & ~kMarkBit;
    if (to == kNoFacet) return word;
    uint32_t wide = to / kWideUnitWords;
    if (wide >= unit_at_.size()) fail_corrupt("a link");
    const uint32_t word0 = wide_[size_t{wide} * kWideUnitWords];
    if (unit_at_[wide] == kNoCell && form_of(word0) == Form::kContinuation) wide -= word0 & kShapeMask;
    if (wide >= unit_at_.size() || unit_at_[wide] == kNoCell) fail_corrupt("a link");
    const Cell c{unit_at_[wide]};
    const uint32_t at = to - wide * kWideUnitWords;
    for (uint32_t f = 0, count = map_.facets_of(c); f < count; ++f) {
      if (wide_link_word(c, f) == at) return mark | map_.half_facet(c, f).word;
    }
    fail_corrupt("a link");
  }

  Map<2>& map_;
  const Array<uint32_t> wide_;
  Array<uint32_t> unit_at_;  // by wide unit: that of the record that begins there, or kNoCell
};

}  // namespace

void narrow_records(Map<2>& map) { Narrowing(map).run(); }

}  // namespace dsw
