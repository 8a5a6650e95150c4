#include "conform/conform.h"

#include <cmath>

#include "base/error.h"
#include "conform/facet_split.h"
#include "environment/mesh_reader.h"
#include "predicates/turn.h"

namespace dsw {
namespace {

/** What becomes of facets: loops with all points on their edges, and outer facets that are split. */
template <int D>
class Facets;

/** Facets of the plane are sides: points on them are all there is. */
template <>
class Facets<2> {
 public:
  Facets(const Environment<2>& env, double room, BuildReport&) : env_(env), hanging_(env, OuterFacets<2>(env), room) {}

  bool has_changes() const { return !hanging_.empty(); }
  bool may_change(Cell c) const { return hanging_.may_have_ends(c); }
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
        room_(room),
        outer_(env),
        hanging_(env, outer_, room),
        loops_(env.memory),
        parts_(env.memory),
        parts_of_(env.memory) {
    for (uint32_t i = 0; i < outer_.count(); ++i) {
      append_loop(outer_.loop(i), loops_.vertices);
      loops_.end_loop();
    }
    split(report);
  }

  bool has_changes() const { return !hanging_.empty() || parts_.count() != 0; }
  /** False: nothing of a cell changes. */
  bool may_change(Cell c) const {
    bool is_split = false;
    for (uint32_t f = 0, count = parts_of_.size() == 0 ? 0 : env_.map.facets_of(c); f < count && !is_split; ++f) {
      is_split = parts_of_.find(env_.map.half_facet(c, f).word) != KeyTable::kNone;
    }
    return is_split || hanging_.may_have_ends(c);
  }
  /** Appends the facets of a cell that take the place of facet f. */
  void append(Cell c, const Shape& shape, uint32_t f, Loops& out) const {
    const uint32_t i = parts_of_.find(env_.map.half_facet(c, f).word);
    if (i != KeyTable::kNone) {
      for (uint32_t k = first_part_[i]; k < first_part_[i + 1]; ++k) out.add(parts_[k]);
      return;
    }
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      hanging_.append(env_.map.vertex(c, shape.dart_vertex(d)), env_.map.vertex(c, shape.dart_vertex(shape.beta1(d))),
                      out.vertices);
    }
    out.end_loop();
  }

 private:
  void append_loop(VertexRange loop, Array<uint32_t>& out) const {
    for (uint32_t k = 0; k < loop.size(); ++k) hanging_.append(loop[k], loop.after(k), out);
  }

  void points_of(const uint32_t* triangle, const double* (&points)[3]) const {
    for (int k = 0; k < 3; ++k) points[k] = env_.point(triangle[k]);
  }

  /** Whether a point lies in the plane of each triangle of a facet. */
  bool lies_in_plane(uint32_t i, uint32_t vertex) const {
    const VertexRange triangles = outer_.simplices(i);
    for (uint32_t t = 0; t < triangles.size(); t += 3) {
      const double* points[3];
      points_of(triangles.first + t, points);
      if (orient<3>(points, env_.point(vertex)) != 0 && !is_close(points, env_.point(vertex))) return false;
    }
    return true;
  }
  /** Whether a point is not farther than the room from the plane of a triangle. */
  bool is_close(const double* const (&t)[3], const double* p) const {
    if (!(room_ > 0)) return false;
    const filter::Vec<3> normal = filter::cross(filter::difference<3>(t[1], t[0]), filter::difference<3>(t[2], t[0]));
    const double length = std::sqrt(filter::dot(normal, normal));
    return std::fabs(filter::dot(normal, filter::difference<3>(p, t[0]))) <= room_ * length;
  }

  /** Whether all corners of facet j are corners of facet i or lie in its plane. */
  bool lies_on(uint32_t i, uint32_t j) const {
    const VertexRange loop = loops_[i], corners = outer_.loop(j);
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
      return std::find(loop.begin(), loop.end(), v) != loop.end() || lies_in_plane(i, v);
    });
  }

  LoopView view_of(uint32_t i) const {
    const double* points[3];
    points_of(outer_.simplices(i).first, points);
    LoopView view;
    view.axis = projection(points);
    for (int axis = 0; axis < 3; ++axis) {  // that which a warped facet is seen largest along
      if (area(points, axis) > area(points, view.axis)) view.axis = axis;
    }
    view.sense = turn_sign<3>(points[0], points[1], points[2], view.axis);
    return view;
  }
  static double area(const double* const (&t)[3], int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return std::fabs((t[1][i] - t[0][i]) * (t[2][j] - t[0][j]) - (t[1][j] - t[0][j]) * (t[2][i] - t[0][i]));
  }

  /** Whether two facets that lie on each other are turned against each other and overlap, seen as the first one is. */
  bool overlap(uint32_t i, uint32_t j, LoopView view) const {
    const VertexRange of_i = outer_.simplices(i), of_j = outer_.simplices(j);
    for (uint32_t t = 0; t < of_i.size(); t += 3) {
      const double *a[3], *b[3];
      points_of(of_i.first + t, a);
      for (uint32_t s = 0; s < of_j.size(); s += 3) {
        points_of(of_j.first + s, b);
        if (turn_sign<3>(b[0], b[1], b[2], view.axis) == -view.sense && insides_meet(a, b, view.axis)) return true;
      }
    }
    return false;
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
    const BoxTree<3> tree = outer_.tree();
    Array<uint32_t> partners{env_.memory};
    for (uint32_t i = 0; i < outer_.count(); ++i) {
      partners.clear();
      ClosedBox<3> box = outer_.box(i);
      box.widen(room_);
      tree.for_each(box.lower, box.upper, [&](uint32_t j) {
        if (outer_.may_overlap(box, j) && outer_.cell(j) != outer_.cell(i)) partners.push_back(j);
      });
      if (partners.empty()) continue;
      std::sort(partners.begin(), partners.end());
      split_facet(i, partners, report);
    }
    first_part_.push_back(parts_.count());
  }

  void split_facet(uint32_t i, const Array<uint32_t>& partners, BuildReport& report) {
    const LoopView view = view_of(i);
    FacetSplit split(env_, loops_[i], view);
    uint32_t last = i;
    for (const uint32_t j : partners) {
      if (!(lies_on(i, j) || lies_on(j, i)) || !overlap(i, j, view)) continue;
      const VertexRange other = loops_[j];
      for (uint32_t k = 0; k < other.size(); ++k) {
        const FacetSplit::Relation relation = split.relate(other[k], other.after(k));
        if (relation == FacetSplit::Relation::kCrosses) fail_at(i, j, report);
        if (relation == FacetSplit::Relation::kInside) split.add(other[k], other.after(k));
      }
      last = j;
    }
    if (!split.has_segments()) return;
    double apex[3];
    centre(env_, outer_.cell(i), apex);
    first_part_.push_back(parts_.count());
    parts_of_.insert(outer_.facet(i).word);
    if (!split.run(apex, parts_)) fail_at(i, last, report);
  }

  const Environment<3>& env_;
  double room_;
  OuterFacets<3> outer_;
  HangingPoints<3> hanging_;
  Loops loops_;        // of outer facets, with all points on their edges
  Loops parts_;        // of those that are split
  KeyTable parts_of_;  // outer facets that are split
  Array<uint32_t> first_part_{env_.memory};
};

/** The facets of a cell as they will be, and whether they are others than they were. */
template <int D>
bool read_cell(const Environment<D>& env, const Facets<D>& facets, Cell c, Loops& out) {
  if (env.map.form(c) != Form::kGeneral && !facets.may_change(c)) return false;
  out.vertices.clear();
  out.first.assign(1, 0);
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
    : types_(env.memory), offsets_(env.memory), connectivity_(env.memory) {
  const Facets<D> facets(env, room, report);
  if (!facets.has_changes()) return;
  const Map<D>& map = env.map;
  Loops loops(env.memory);
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const bool has_changed = read_cell(env, facets, c, loops);
    report.changed_count += has_changed ? 1u : 0u;
    if (has_changed) report.changed.add(i);
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
