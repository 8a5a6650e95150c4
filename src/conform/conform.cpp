#include "conform/conform.h"

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "conform/facet_split.h"
#include "environment/facet_matcher.h"
#include "environment/mesh_reader.h"

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
  /** Appends the facets of a cell that take the place of facet f. */
  void append(Cell c, const Shape&, uint32_t f, Loops& out) const {
    const uint32_t count = env_.map.vertices_of(c);
    hanging_.append(env_.map.vertex(c, f), env_.map.vertex(c, f + 1 == count ? 0 : f + 1), out.vertices);
    out.end_loop();
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
        const auto back = std::find(open_.begin(), open_.end(), way(loop.after(k), loop[k]));
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
    return std::all_of(partners.begin(), partners.end(), [&](uint32_t j) { return add_loop(pairs_.loop(j)); }) &&
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

/** The facets of a cell as they will be, and whether they are others than they were. */
template <int D>
bool read_cell(const Environment<D>& env, const Facets<D>& facets, Cell c, Loops& out) {
  if (env.map.form(c) != Form::kGeneral && !facets.may_change(c)) return false;
  out.clear();
  const Shape shape = env.map.shape(c);
  uint32_t ends = 0;
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    facets.append(c, shape, f, out);
    ends += D == 3 ? shape.facet_size(f) : 1;
  }
  return out.count() != shape.facet_count() || out.vertices.size() != ends;
}

}  // namespace

template <int D>
ConformedMesh<D>::ConformedMesh(const Environment<D>& env, double room, BuildReport& report)
    : types_(env.memory),
      has_changed_(env.memory),
      offsets_(env.memory),
      connectivity_(env.memory),
      poor_fans_(env.memory) {
  const Facets<D> facets(env, room, report);
  if (!facets.has_changes()) return;
  poor_fans_ = facets.poor_fans();
  const Map<D>& map = env.map;
  Loops loops(env.memory);
  types_.reserve(map.cell_count);
  has_changed_.reserve(map.cell_count);
  offsets_.reserve(size_t{map.cell_count} + 1);
  connectivity_.reserve(size_t{map.cell_count} * 8);
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const bool has_changed = read_cell(env, facets, c, loops);
    report.changed_count += has_changed ? 1u : 0u;
    if (has_changed) report.changed.add(i);
    has_changed_.push_back(has_changed ? 1 : 0);
    const bool is_general = has_changed || map.form(c) == Form::kGeneral;
    types_.push_back(static_cast<uint8_t>(number_of(is_general ? Form::kGeneral : map.form(c), D)));
    offsets_.push_back(static_cast<int64_t>(connectivity_.size()));
    if (!is_general) {
      map.for_each_vertex(c, [&](uint32_t v) { connectivity_.push_back(v); });
    } else if constexpr (D == 2) {
      connectivity_.insert(connectivity_.end(), loops.vertices.begin(), loops.vertices.end());
    } else {
      connectivity_.push_back(loops.count());
      for (uint32_t f = 0; f < loops.count(); ++f) {
        connectivity_.push_back(loops[f].size());
        connectivity_.insert(connectivity_.end(), loops[f].begin(), loops[f].end());
      }
    }
  }
  offsets_.push_back(static_cast<int64_t>(connectivity_.size()));
}

template <int D>
void ConformedMesh<D>::read(Environment<D>& env, const Environment<D>& from, const dsw_environment_desc& input,
                            BuildReport& report) const {
  const LinkedBefore<D> before{from, has_changed_, poor_fans_};
  read_mesh(env, description(input), report, &before);
}

/** Describes all cells in their order, with the points of `input`. The description points into this mesh. */
template <int D>
dsw_environment_desc ConformedMesh<D>::description(const dsw_environment_desc& input) const {
  dsw_environment_desc made = input;
  made.flags &=
      ~static_cast<uint32_t>(DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_REORIENT);
  made.index_bytes = 8;
  made.cell_types = types_.data();
  made.offsets = offsets_.data();
  made.connectivity = connectivity_.data();
  made.connectivity_count = connectivity_.size();
  made.faces = made.face_locations = nullptr;
  made.faces_count = 0;
  return made;
}

template class ConformedMesh<2>;
template class ConformedMesh<3>;

}  // namespace dsw
