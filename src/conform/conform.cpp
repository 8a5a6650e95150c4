#include "conform/conform.h"

#include <algorithm>
#include <iterator>

#include "base/dimensions.h"
#include "base/error.h"
#include "base/search.h"
#include "conform/facet_split.h"
#include "environment/replaced_cells.h"

namespace dsw {
namespace {

/** What becomes of facets: loops with all points on their edges, and outer facets that are split. */
template <int D>
class Facets;

/** Facets of the plane are sides: points on them are all there is. */
template <>
class Facets<2> {
 public:
  Facets(const Environment<2>& env, double room, BuildReport&) : env_(env), hanging_(env) {
    find_hanging_points(env, OuterFacets<2>(env), room, hanging_);
  }

  bool has_changes() const { return hanging_.count() != 0; }
  bool may_change(Cell c) const { return hanging_.may_have_ends(c); }
  Array<uint64_t> poor_fans() const { return hanging_.poor_fans(); }
  /** Appends the corners of a cell from side f to the next; the last side ends the loop. */
  void append(Cell c, const Shape&, uint32_t f, Loops& out) const {
    const uint32_t count = env_.map.vertices_of(c);
    hanging_.append(env_.map.vertex(c, f), env_.map.vertex(c, f + 1 == count ? 0 : f + 1), out.vertices);
    if (f + 1 == count) out.end_loop();
  }

 private:
  const Environment<2>& env_;
  HangingPoints<2> hanging_;
};

template <>
class Facets<3> {
 public:
  Facets(const Environment<3>& env, double room, BuildReport& report)
      : env_(env),
        outer_(env),
        hanging_(env),
        pairs_(env, outer_, room, hanging_),
        parts_(env.memory),
        parts_of_(outer_.count(), Range{}, env.memory),
        is_split_((size_t{env.map.index_count()} + 63) / 64, 0, env.memory) {
    take_partners();
    split(report);
  }

  bool has_changes() const { return hanging_.count() != 0 || parts_.count() != 0; }
  /** False: nothing of a cell changes. */
  bool may_change(Cell c) const { return is_split(c) || hanging_.may_have_ends(c); }
  Array<uint64_t> poor_fans() const { return hanging_.poor_fans(); }
  /** Appends the facets of a cell that take the place of facet f. */
  void append(Cell c, const Shape& shape, uint32_t f, Loops& out) const {
    const HalfFacet h = env_.map.half_facet(c, f);
    if (is_split(c) && !env_.map.opposite(h).valid()) {
      const Range parts = parts_of_[outer_.find(h)];
      for (uint32_t k = parts.first; k < parts.last; ++k) out.add(parts_[k]);
      if (parts.first != parts.last) return;
    }
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      hanging_.append(env_.map.vertex(c, shape.dart_vertex(d)), env_.map.vertex(c, shape.dart_vertex(shape.beta1(d))),
                      out.vertices);
    }
    out.end_loop();
  }

 private:
  /** Numbers of parts; none: the facet is not split. */
  struct Range {
    uint32_t first = 0, last = 0;
  };

  bool is_split(Cell c) const {
    const uint32_t i = env_.map.index(c);
    return (is_split_[i / 64] >> i % 64 & 1) != 0;
  }
  void set_parts(uint32_t i, uint32_t first) {
    parts_of_[i] = {first, parts_.count()};
    const uint32_t cell = env_.map.index(outer_.cell(i));
    is_split_[cell / 64] |= uint64_t{1} << cell % 64;
  }

  /** Whether the loops of its partners make all of facet i: each of their edges, and each of its own, is there once each way. */
  bool is_covered(uint32_t i) {
    open_.clear();
    const auto add_loop = [this](VertexRange loop) {
      for (uint32_t k = 0; k < loop.size(); ++k) {
        const auto back = dsw::find(open_.begin(), open_.end(), way(loop.after(k), loop[k]));
        if (back == open_.end()) {
          open_.push_back(way(loop[k], loop.after(k)));
        } else {
          *back = open_.back();
          open_.pop_back();
        }
      }
      return open_.size() <= kMostOpen;
    };
    const VertexRange partners = pairs_.partners(i);
    return dsw::all_of(partners.begin(), partners.end(), [&](uint32_t j) { return add_loop(pairs_.loop(j)); }) &&
           add_loop(pairs_.loop(i)) && open_.empty();
  }
  static uint64_t way(uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; }

  /** Facets that their partners cover have the same loops as these, turned. That needs no geometry. */
  void take_partners() {
    is_settled_.assign(outer_.count(), 0);
    for (uint32_t i = 0; i < outer_.count(); ++i) {
      const VertexRange partners = pairs_.partners(i);
      if (partners.size() < 2 || !is_covered(i)) continue;
      const uint32_t first = parts_.count();
      for (const uint32_t j : partners) {
        const VertexRange loop = pairs_.loop(j);
        std::reverse_copy(loop.begin(), loop.end(), std::back_inserter(parts_.vertices));
        parts_.end_loop();
        if (pairs_.partners(j).size() == 1) is_settled_[j] = 1;
      }
      set_parts(i, first);
      is_settled_[i] = 1;
    }
  }

  [[noreturn]] void fail_at(uint32_t i, uint32_t j, BuildReport& report) const {
    report.offenders = {};
    report.offenders.index[0] = env_.map.index(outer_.cell(i));
    report.offenders.index[1] = env_.map.index(outer_.cell(j));
    report.offenders.count = 2;
    fail(DSW_STATUS_NOT_CONFORMING, "faces of cells %u and %u overlap, and there are no points to split both at",
         report.offenders.index[0], report.offenders.index[1]);
  }

  void split(BuildReport& report) {
    for (uint32_t i = 0; i < outer_.count(); ++i) {
      if (is_settled_[i] == 0 && pairs_.partners(i).size() != 0) split_facet(i, report);
    }
  }

  void split_facet(uint32_t i, BuildReport& report) {
    FacetSplit split(env_, pairs_.loop(i), pairs_.view(i));
    for (const uint32_t j : pairs_.partners(i)) {
      const VertexRange other = pairs_.loop(j);
      for (uint32_t k = 0; k < other.size(); ++k) {
        const FacetSplit::Relation relation = split.relate(other[k], other.after(k));
        if (relation == FacetSplit::Relation::kCrosses) fail_at(i, j, report);
        if (relation == FacetSplit::Relation::kInside) split.add(other[k], other.after(k));
      }
    }
    if (!split.has_segments()) return;
    double apex[3];
    centre(env_, outer_.cell(i), apex);
    const uint32_t first = parts_.count();
    const VertexRange partners = pairs_.partners(i);
    if (!split.run(apex, parts_)) fail_at(i, partners[partners.size() - 1], report);
    set_parts(i, first);
  }

  static constexpr size_t kMostOpen = 256;  // ways that is_covered() looks through

  const Environment<3>& env_;
  OuterFacets<3> outer_;
  HangingPoints<3> hanging_;
  FacetPairs pairs_;
  Loops parts_;  // of those that are split
  Array<Range> parts_of_;
  Array<uint64_t> is_split_;                // bits: cells that have such a facet
  Array<uint8_t> is_settled_{env_.memory};  // facets of which it is known what becomes of them
  Array<uint64_t> open_{env_.memory};       // of is_covered(): ways that were not taken back
};

/** Appends the facets of a cell as they will be. Returns whether they are others than they were. */
template <int D>
bool append_cell(const Environment<D>& env, const Facets<D>& facets, Cell c, Loops& out) {
  const Shape shape = env.map.shape(c);
  const uint32_t loops = out.count();
  const size_t ends = out.vertices.size();
  for (uint32_t f = 0; f < shape.facet_count(); ++f) facets.append(c, shape, f, out);
  return out.vertices.size() - ends != shape.dart_count() || (D == 3 && out.count() - loops != shape.facet_count());
}

/** What becomes of a mesh; no cells: nothing changes. */
template <int D>
ReplacedCells<D> conformed_cells(const Environment<D>& env, double room, BuildReport& report) {
  ReplacedCells<D> made(env.memory);
  const Facets<D> facets(env, room, report);
  if (!facets.has_changes()) return made;
  const Map<D>& map = env.map;
  made.poor_fans = facets.poor_fans();
  made.changed.assign((size_t{map.cell_count} + 63) / 64, 0);
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const bool is_general = map.form(c) == Form::kGeneral;
    if (!is_general && !facets.may_change(c)) continue;
    const bool has_changed = append_cell(env, facets, c, made.loops);
    if (!has_changed && !is_general) {
      made.loops.shrink(made.first_loop.back());
      continue;
    }
    made.cells.push_back(i);
    made.first_loop.push_back(made.loops.count());
    if (!has_changed) continue;
    made.changed[i / 64] |= uint64_t{1} << i % 64;
    ++report.changed_count;
    report.changed.add(i);
  }
  return made;
}

}  // namespace

template <int D>
void conform(Environment<D>& env, double room, BuildReport& report) {
  const ReplacedCells<D> cells = conformed_cells(env, room, report);
  if (!cells.cells.empty()) replace_cells(env, cells, report);
}

DSW_INSTANTIATE(conform);

}  // namespace dsw
