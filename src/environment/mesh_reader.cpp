#include "environment/mesh_reader.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include "base/dimensions.h"
#include "base/error.h"
#include "base/search.h"
#include "environment/collapsed_loops.h"
#include "environment/general_records.h"
#include "environment/merged_points.h"
#include "environment/turned_loops.h"

namespace dsw {
namespace {

constexpr uint64_t kMaxUnits = uint64_t{1} << 28;  // a link is a word address below 2^31

/** Each form of a dimension once. */
struct KnownType {
  int dimension;
  dsw_cell_type number;
  Form form;
  uint32_t vertex_count;
};
constexpr KnownType kKnownTypes[] = {
    {3, DSW_CELL_TYPE_TETRA, Form::kSimplex, 4},      {3, DSW_CELL_TYPE_HEXAHEDRON, Form::kBox, 8},
    {3, DSW_CELL_TYPE_WEDGE, Form::kPrism, 6},        {3, DSW_CELL_TYPE_PYRAMID, Form::kPyramid, 5},
    {3, DSW_CELL_TYPE_POLYHEDRON, Form::kGeneral, 0}, {2, DSW_CELL_TYPE_TRIANGLE, Form::kSimplex, 3},
    {2, DSW_CELL_TYPE_QUAD, Form::kBox, 4},           {2, DSW_CELL_TYPE_POLYGON, Form::kGeneral, 0}};

/** Every quad is cut from its lowest vertex, a rule that gives both sides the same diagonal. */
uint32_t cuts_of(Form form, const uint32_t* vertices) {
  const Shape shape = standard_shape(form, 0);
  uint32_t cuts = 0, quad = 0;
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    if (shape.facet_size(f) != 4) continue;
    const auto at = [&](uint32_t k) { return vertices[shape.dart_vertex(shape.facet_first(f) + k)]; };
    uint32_t lowest = 0;
    for (uint32_t k = 1; k < 4; ++k) lowest = at(k) < at(lowest) ? k : lowest;
    cuts |= (lowest & 1u) << quad++;
  }
  return cuts;
}

/** Reads one mesh. Defects of one kind are collected over all cells, so that the report names the first of them. */
template <int D>
class Reader {
 public:
  Reader(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report, const Parallel& parallel)
      : parallel_(parallel),
        map_(env.map),
        in_(input),
        report_(report),
        offsets_(input.offsets, input.index_bytes),
        connectivity_(input.connectivity, input.index_bytes),
        general_(env.map, nullptr),
        merged_(env.memory) {
    if (!merges_points(input)) return;
    merged_ = merged_points<D>(env.points, map_.vertex_count, input.merge_distance, env.memory);
    for (uint32_t i = 0; i < map_.vertex_count; ++i) report.merged_point_count += merged_[i] != i ? 1u : 0u;
  }

  void read() {
    scan_types();
    lay_out();
    const bool are_standard = map_.unit_of_cell.empty() && !splits();
    if (are_standard && is_shared(map_, parallel_) && read_all_standard()) return;
    for (uint32_t i = 0; i < map_.cell_count; ++i) {
      const Form form = form_of(i);
      if (form == Form::kGeneral) {
        D == 3 ? read_polyhedron(i) : read_polygon(i);
      } else {
        read_standard(i, form);
      }
    }
    raise(DSW_STATUS_INDEX_OUT_OF_RANGE, bad_index_, "names a point that does not exist");
    raise(DSW_STATUS_BAD_CELL, bad_cell_,
          splits()          ? "has nothing left without what collapses, or its faces do not close a sphere"
          : merged_.empty() ? "repeats a point, or its faces do not close a sphere"
                            : "repeats a point once points are merged, or its faces do not close a sphere");
  }

 private:
  CellType type_of(uint32_t i) const {
    return cell_type<D>(in_.cell_types != nullptr ? in_.cell_types[i] : in_.uniform_cell_type);
  }
  /** Whether all cells have one standard type and follow each other. */
  bool is_uniform() const {
    return in_.cell_types == nullptr && in_.offsets == nullptr && !splits() && uniform_vertices_ != 0;
  }
  bool splits() const { return (in_.flags & DSW_ENVIRONMENT_SPLIT) != 0; }
  /** Cells with repeated points are polyhedra or polygons, if cells are split; all other ones are what their type says. */
  Form form_of(uint32_t i) {
    const CellType type = type_of(i);
    if (type.form == Form::kGeneral || !splits()) return type.form;
    std::array<int64_t, 8> points{};
    for (uint32_t k = 0; k < type.vertex_count; ++k) {
      const int64_t point = connectivity_[begin_of(i) + k];
      if (point < 0 || static_cast<uint64_t>(point) >= map_.vertex_count) return type.form;
      points[k] = merged_.empty() ? point : merged_[static_cast<size_t>(point)];
      if (dsw::find(points.begin(), points.begin() + k, points[k]) != points.begin() + k) return Form::kGeneral;
    }
    return type.form;
  }
  size_t begin_of(uint32_t i) const {
    return in_.offsets != nullptr ? static_cast<size_t>(offsets_[i]) : size_t{i} * uniform_vertices_;
  }
  size_t end_of(uint32_t i) const { return begin_of(i + 1); }

  void raise(dsw_status status, const Offenders& offenders, const char* what) {
    if (offenders.count == 0) return;
    report_.offenders = offenders;
    fail(status, "cell %u %s", offenders.index[0], what);
  }

  /** Cells that follow each other are more than connectivity holds: mostly they are of another type. */
  void raise_few_entries(const Offenders& offenders) {
    report_.offenders = offenders;
    const size_t entries = in_.connectivity_count, cells = in_.volume_count;
    char each[40] = "";
    if (entries % cells == 0) std::snprintf(each, sizeof each, ", %zu a cell", entries / cells);
    fail(DSW_STATUS_WRONG_SIZE,
         "connectivity has %zu entries for %zu cells%s, but cells of uniform_cell_type %u have %zu each; set "
         "uniform_cell_type, or pass cell_types and offsets",
         entries, cells, each, in_.uniform_cell_type, uniform_vertices_);
  }

  /** Types and extents of all entries: after this every access to connectivity is inside of it. */
  void scan_types() {
    map_.cell_count = static_cast<uint32_t>(in_.volume_count);
    Offenders bad_type, bad_size;
    if (in_.offsets == nullptr) uniform_vertices_ = type_of(0).vertex_count;
    if (is_uniform() && in_.volume_count <= in_.connectivity_count / uniform_vertices_) return;
    for (uint32_t i = 0; i < map_.cell_count; ++i) {
      const CellType type = type_of(i);
      if (!type.known) {
        bad_type.add(i);
        continue;
      }
      const int64_t begin = in_.offsets != nullptr ? offsets_[i] : static_cast<int64_t>(begin_of(i));
      const int64_t end = in_.offsets != nullptr ? offsets_[i + 1] : static_cast<int64_t>(begin_of(i + 1));
      const bool inside = begin >= 0 && begin <= end && static_cast<uint64_t>(end) <= in_.connectivity_count;
      const bool right = inside && (type.vertex_count == 0 || end - begin == static_cast<int64_t>(type.vertex_count));
      if (!inside || !right) bad_size.add(i);
    }
    raise(DSW_STATUS_BAD_CELL_TYPE, bad_type, "has a type that is not supported");
    if (in_.offsets == nullptr && bad_size.count != 0) raise_few_entries(bad_size);
    raise(DSW_STATUS_WRONG_SIZE, bad_size, "has offsets outside of connectivity, or not as many points as its type");
  }

  /** Where each record starts. Uniform records are found by multiplication, others by a table each way. */
  void lay_out() {
    uint64_t units = 0;
    bool uniform = true;
    const uint32_t first_units = units_of(0);
    if (is_uniform()) units = uint64_t{map_.cell_count} * first_units;
    for (uint32_t i = 0; i < map_.cell_count && !is_uniform(); ++i) {
      const uint32_t n = units_of(i);
      const bool still = uniform && n == first_units && form_of(i) != Form::kGeneral;
      if (uniform && !still) {
        map_.unit_of_cell.resize(map_.cell_count);
        for (uint32_t j = 0; j < i; ++j) map_.unit_of_cell[j] = j * first_units;
      }
      uniform = still;
      if (!uniform) map_.unit_of_cell[i] = static_cast<uint32_t>(std::min(units, kMaxUnits));
      units += n;
    }
    if (units >= kMaxUnits)
      fail(DSW_STATUS_TOO_LARGE, "the cells need %llu records, more than 2^28", static_cast<unsigned long long>(units));
    const auto unit_count = static_cast<size_t>(units);
    map_.words.assign(unit_count * kUnitWords<D>, 0);
    laid_out_ = true;
    if (uniform) {
      map_.units_per_cell = first_units;
      return;
    }
    map_.cell_of_unit.assign(unit_count, kNoCell);
    for (uint32_t i = 0; i < map_.cell_count; ++i) map_.cell_of_unit[map_.unit_of_cell[i]] = i;
  }

  uint32_t units_of(uint32_t i) {
    const Form form = form_of(i);
    if (form == Form::kSimplex) return 1;
    if (form != Form::kGeneral) return 2;
    uint32_t vertices = 0, facets = 0;
    if (D == 2) {
      if (splits()) parse_polygon(i);
      const size_t corners = splits() ? cell_.points.size() : end_of(i) - begin_of(i);
      vertices = facets = static_cast<uint32_t>(std::min<size_t>(corners, UINT16_MAX));
    } else if (parse_cell(i)) {
      vertices = static_cast<uint32_t>(cell_.points.size());
      facets = cell_.facet_count();
    }
    return general_units<D>(std::max(1u, facets), vertices);
  }

  /** A point index, that of the point that it is merged with, or recorded as an offence of cell i. */
  uint32_t checked(uint32_t i, int64_t point) {
    if (point < 0 || static_cast<uint64_t>(point) >= map_.vertex_count) {
      if (laid_out_) bad_index_.add(i);
      return 0;
    }
    return merged_.empty() ? static_cast<uint32_t>(point) : merged_[static_cast<size_t>(point)];
  }

  /** Writes the record of a standard cell. False: its points are not such as they have to be. */
  bool write_standard(uint32_t i, Form form) noexcept {
    const uint32_t n = Map<D>::standard_vertex_count(form);
    const size_t begin = begin_of(i);
    uint32_t vertices[8];
    for (uint32_t k = 0; k < n; ++k) {
      const int64_t point = connectivity_[begin + k];
      if (point < 0 || static_cast<uint64_t>(point) >= map_.vertex_count) return false;
      vertices[k] = merged_.empty() ? static_cast<uint32_t>(point) : merged_[static_cast<size_t>(point)];
      for (uint32_t j = 0; j < k; ++j) {
        if (vertices[j] == vertices[k]) return false;
      }
    }
    uint32_t* w = map_.record(map_.cell(i));
    for (uint32_t k = 0; k < Map<D>::standard_facet_count(form); ++k) w[kUnitWords<D> - 1 - k] = kNoFacet;
    if (form == Form::kSimplex) {
      std::copy(vertices, vertices + n, w);
      return true;
    }
    std::copy(vertices, vertices + n, w + kUnitWords<D>);
    w[0] = static_cast<uint32_t>(form) << kFormShift;
    if (D == 3) w[0] |= cuts_of(form, vertices);
    return true;
  }
  void read_standard(uint32_t i, Form form) {
    if (write_standard(i, form)) return;
    const uint32_t offenders = bad_index_.count;
    for (uint32_t k = 0; k < Map<D>::standard_vertex_count(form); ++k) checked(i, connectivity_[begin_of(i) + k]);
    if (bad_index_.count == offenders) bad_cell_.add(i);
  }
  /** Reads standard cells side by side. False: some are wrong, and all have to be read again in their order. */
  bool read_all_standard() {
    std::atomic<bool> are_right{true};
    auto body = [&](size_t begin, size_t end) noexcept {
      for (size_t i = begin; i < end; ++i) {
        const auto cell = static_cast<uint32_t>(i);
        if (!write_standard(cell, type_of(cell).form)) are_right = false;
      }
    };
    parallel_chunks(parallel_, map_.cell_count, kCellsAtOnce, body);
    return are_right;
  }

  /** Splits a polyhedron into loops of local vertices; false when its face stream is malformed. */
  bool parse_cell(uint32_t i) {
    cell_.clear();
    const Form form = type_of(i).form;
    if (form == Form::kGeneral && !parse_stream(i)) return false;
    if (form != Form::kGeneral) parse_standard(i, form);
    if (splits()) leave_out_collapsed();
    return cell_.first.size() > 4;
  }

  /** The loops of a standard cell with repeated points. */
  void parse_standard(uint32_t i, Form form) {
    const Shape shape = standard_shape(form, 0);
    std::array<uint16_t, 8> local{};
    for (uint32_t k = 0; k < shape.vertex_count(); ++k) {
      const uint32_t point = checked(i, connectivity_[begin_of(i) + k]);
      const auto known = dsw::find(cell_.points.begin(), cell_.points.end(), point);
      local[k] = static_cast<uint16_t>(known - cell_.points.begin());
      if (known == cell_.points.end()) cell_.points.push_back(point);
    }
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        cell_.vertices.push_back(local[shape.dart_vertex(d)]);
      }
      cell_.end_facet();
    }
  }

  /** Then vertices are numbered anew, those that are left. */
  void leave_out_collapsed() {
    clean_loops(cell_.vertices, cell_.first);
    const std::vector<uint32_t> points = std::move(cell_.points);
    std::vector<uint16_t> number(points.size(), UINT16_MAX);
    cell_.points.clear();
    for (uint16_t& v : cell_.vertices) {
      if (number[v] == UINT16_MAX) {
        number[v] = static_cast<uint16_t>(cell_.points.size());
        cell_.points.push_back(points[v]);
      }
      v = number[v];
    }
  }

  /** Splits a face stream into loops; false when it is malformed. */
  bool parse_stream(uint32_t i) {
    const bool separate = in_.faces != nullptr;
    const Integers stream(separate ? in_.faces : in_.connectivity, in_.index_bytes);
    int64_t at = static_cast<int64_t>(begin_of(i)), end = static_cast<int64_t>(end_of(i));
    if (separate) {
      at = Integers(in_.face_locations, in_.index_bytes)[i];
      end = static_cast<int64_t>(in_.faces_count);
    }
    if (at < 0 || at >= end) return false;
    const int64_t faces = stream[static_cast<size_t>(at++)];
    if (faces < 4 || faces >= UINT16_MAX) return false;
    if (local_of_point_.empty()) local_of_point_.assign(map_.vertex_count, UINT16_MAX);
    bool sound = true;
    for (int64_t f = 0; f < faces && sound; ++f) {
      const int64_t n = at < end ? stream[static_cast<size_t>(at++)] : 0;
      sound = n >= 3 && n <= end - at && cell_.vertices.size() + static_cast<size_t>(n) < UINT16_MAX;
      for (int64_t k = 0; k < n && sound; ++k) {
        const uint32_t point = checked(i, stream[static_cast<size_t>(at++)]);
        if (local_of_point_[point] == UINT16_MAX) {
          local_of_point_[point] = static_cast<uint16_t>(cell_.points.size());
          cell_.points.push_back(point);
        }
        cell_.vertices.push_back(local_of_point_[point]);
      }
      cell_.end_facet();
    }
    for (const uint32_t point : cell_.points) local_of_point_[point] = UINT16_MAX;
    return sound && (separate || at == end);
  }

  void read_polyhedron(uint32_t i) {
    const uint32_t offenders = bad_index_.count;
    const bool sound = parse_cell(i);
    if (bad_index_.count != offenders) return;
    if (sound && (in_.flags & DSW_ENVIRONMENT_REORIENT) != 0) turn_faces(i);
    if (!sound || !general_.write(i, cell_)) bad_cell_.add(i);
  }

  /** Turns faces of a polyhedron back that are turned against most of its others. */
  void turn_faces(uint32_t i) {
    const uint32_t turned = turn_loops(cell_.vertices, cell_.first);
    if (turned == 0) return;
    report_.turned_face_count += turned;
    report_.with_turned_faces.push_back(i);
    ++report_.reoriented_count;
  }

  /** The corners of a polygon, those that are left. */
  void parse_polygon(uint32_t i) {
    const size_t begin = begin_of(i), n = end_of(i) - begin;
    cell_.points.clear();
    for (size_t k = 0; k < n && k < UINT16_MAX; ++k) cell_.points.push_back(checked(i, connectivity_[begin + k]));
    if (splits()) clean_loop(cell_.points);
  }

  void read_polygon(uint32_t i) {
    const uint32_t offenders = bad_index_.count;
    parse_polygon(i);
    if (bad_index_.count != offenders) return;
    if (!general_.write(i, cell_)) bad_cell_.add(i);
  }

  const Parallel& parallel_;
  Map<D>& map_;
  const dsw_environment_desc& in_;
  BuildReport& report_;
  Integers offsets_, connectivity_;
  size_t uniform_vertices_ = 0;
  bool laid_out_ = false;  // offences are recorded by the second pass only
  Offenders bad_index_, bad_cell_;
  GeneralCell cell_;  // that is read
  GeneralRecords<D> general_;
  std::vector<uint16_t> local_of_point_;
  Array<uint32_t> merged_;  // of each point the one that it counts as; empty: itself
};

}  // namespace

template <int D>
CellType cell_type(uint32_t vtk) {
  for (const KnownType& known : kKnownTypes) {
    if (known.dimension == D && known.number == vtk) return {known.form, known.vertex_count, true};
  }
  return {Form::kGeneral, 0, false};
}

dsw_cell_type number_of(Form form, int dimension) {
  const KnownType* known = kKnownTypes;
  while (known->dimension != dimension || known->form != form) ++known;
  return known->number;
}

template <int D>
void read_points(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report) {
  const bool is_lent = (input.flags & DSW_ENVIRONMENT_BORROW_POINTS) != 0;
  env.map.vertex_count = static_cast<uint32_t>(input.point_count);
  const auto* from = reinterpret_cast<const unsigned char*>(input.points);
  if (!is_lent) env.owned_points.resize(input.point_count * D);
  for (uint32_t i = 0; i < env.map.vertex_count; ++i) {
    double xyz[D];
    std::memcpy(xyz, from + size_t{i} * input.point_stride_bytes, sizeof xyz);
    bool finite = true;
    for (int k = 0; k < D; ++k) finite = finite && std::isfinite(xyz[k]);
    if (!finite) report.offenders.add(i);
    if (!is_lent) std::memcpy(&env.owned_points[size_t{i} * D], xyz, sizeof xyz);
  }
  if (report.offenders.count != 0) {
    fail(DSW_STATUS_NON_FINITE, "point %u has a coordinate that is not finite", report.offenders.index[0]);
  }
  env.points = is_lent ? input.points : env.owned_points.data();
}

template <int D>
void read_cells(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report, const Parallel& parallel) {
  Reader<D>(env, input, report, parallel).read();
}

template <int D>
void mirror_cell(Environment<D>& env, Cell c) {
  Map<D>& map = env.map;
  const Form form = map.form(c);
  uint32_t* w = map.record(c);
  if (form == Form::kSimplex) {
    const uint32_t first = w[0] & kVertexMask;
    w[0] = (w[0] & ~kVertexMask) | w[1];
    w[1] = first;
    return;
  }
  if (form == Form::kGeneral) {
    Shape shape = map.shape(c);
    std::vector<uint16_t> vertices, first;
    for (uint32_t f = 0; f <= shape.facet_count(); ++f) first.push_back(static_cast<uint16_t>(shape.facet_first(f)));
    std::vector<uint16_t> base(shape.facet_count());
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const uint32_t apex = D == 3 ? shape.simplices()[3 * shape.simplex_first(f)] : 0;
      for (uint32_t d = shape.facet_first(f + 1); d-- > shape.facet_first(f);) {
        if (shape.dart_vertex(d) == apex) base[f] = static_cast<uint16_t>(vertices.size() - first[f]);
        vertices.push_back(static_cast<uint16_t>(shape.dart_vertex(d)));
      }
    }
    if (D == 3) {
      // Reversed loops have the same counts, so the new table has the size of the old one and takes its place.
      Array<uint16_t> table(map.shape_tables.get_allocator());
      append_polyhedron({vertices.data(), first.data(), shape.facet_count(), shape.vertex_count()}, base.data(), table);
      std::copy(table.begin(), table.end(), map.shape_tables.data() + map.shape_offsets[w[0] & kShapeMask]);
    } else {
      const uint32_t n = shape.vertex_count(), offset = first_vertex_item<D>(shape.facet_count());
      const auto slot = [&](uint32_t k) -> uint32_t& { return w[item_word<D>(offset + k)]; };
      for (uint32_t k = 0; k < n / 2; ++k) std::swap(slot(k), slot(n - 1 - k));
    }
    return;
  }
  uint32_t* v = w + kUnitWords<D>;
  if (D == 2 || form == Form::kPyramid) {
    std::swap(v[1], v[3]);
  } else {
    const uint32_t half = Map<D>::standard_vertex_count(form) / 2;
    std::swap_ranges(v, v + half, v + half);
  }
  if (D == 3) w[0] = (w[0] & ~kShapeMask) | cuts_of(form, v);
}

DSW_INSTANTIATE(cell_type);
DSW_INSTANTIATE(read_points);
DSW_INSTANTIATE(read_cells);
DSW_INSTANTIATE(mirror_cell);

}  // namespace dsw
