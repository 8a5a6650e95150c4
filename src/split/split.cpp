#include "split/split.h"

#include <optional>

#include "base/dimensions.h"
#include "base/error.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/mesh_reader.h"
#include "split/cell_parts.h"

namespace dsw {
namespace {

[[noreturn]] void fail_split(const Offenders& offenders, SplitDefect first, BuildReport& report) {
  report.offenders = offenders;
  if (first == SplitDefect::kInsideOut) {
    fail(DSW_STATUS_INVERTED_CELL, "cell %u is turned inside out; DSW_ENVIRONMENT_REORIENT turns it back",
         offenders.index[0]);
  }
  fail(DSW_STATUS_INVALID_CELL, "cell %u can't be split: %s", offenders.index[0], text_of(first));
}

/** Adds what lies behind the facets of cells that could not be split: their facets need not stay then. False: all of that is
 * there already. */
template <int D>
bool add_neighbours(const Environment<D>& env, const Array<Cell>& failed, Array<Cell>& cells) {
  const size_t before = cells.size();
  for (const Cell c : failed) {
    for (uint32_t f = 0; f < env.map.facets_of(c); ++f) {
      const HalfFacet other = env.map.opposite(env.map.half_facet(c, f));
      if (other.valid()) cells.push_back(env.map.cell_of(other));
    }
  }
  dsw::sort(cells.begin(), cells.end(), [](Cell a, Cell b) { return a.unit < b.unit; });
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells.size() != before;
}

/** Which cells are split before others, so that they choose how facets are cut. */
class SplitOrder {
 public:
  explicit SplitOrder(const Memory* memory) : first_(memory) {}

  Array<Cell> of(const Array<Cell>& cells) const {
    Array<Cell> order(first_);
    for (const Cell c : cells) {
      if (!has(c)) order.push_back(c);
    }
    return order;
  }
  /** False: all of these come first already. */
  bool move_up(const Array<Cell>& failed) {
    Array<Cell> moved(failed);
    for (const Cell c : first_) {
      if (dsw::find(failed.begin(), failed.end(), c) == failed.end()) moved.push_back(c);
    }
    const bool has_moved = moved.size() != first_.size();
    first_ = std::move(moved);
    return has_moved;
  }

 private:
  bool has(Cell c) const { return dsw::find(first_.begin(), first_.end(), c) != first_.end(); }

  Array<Cell> first_;
};

/** Splits cells, again with those first that could not be split, and more of them where that is needed. Throws as
 * SplitMesh. */
template <int D>
void split_cells(const Environment<D>& env, bool may_add, Array<Cell>& cells, std::optional<CellParts<D>>& parts,
                 BuildReport& report) {
  constexpr int kMostRounds = 12;
  Offenders offenders;
  SplitDefect first = SplitDefect::kNone;
  SplitOrder order(env.memory);
  for (int round = 0;; ++round) {
    parts.emplace(env, cells, may_add);
    Array<Cell> failed(env.memory);
    for (const Cell c : order.of(cells)) {
      const auto place =
          std::lower_bound(cells.begin(), cells.end(), c, [](Cell a, Cell b) { return a.unit < b.unit; });
      const SplitDefect defect = parts->split(static_cast<size_t>(place - cells.begin()), c);
      if (defect == SplitDefect::kNone) continue;
      failed.push_back(c);
      if (round != 0) continue;
      if (offenders.count == 0) first = defect;
      offenders.add(env.map.index(c));
    }
    if (failed.empty()) return;
    const bool may_help = D == 3 && (first == SplitDefect::kMeetsItself || first == SplitDefect::kNotFilled);
    if (!may_help || round == kMostRounds || (!order.move_up(failed) && !add_neighbours(env, failed, cells))) {
      fail_split(offenders, first, report);
    }
  }
}

}  // namespace

/** Writes cells one after the other. */
template <int D>
class SplitMesh<D>::Writer {
 public:
  Writer(const Environment<D>& env, const dsw_environment_desc& input, SplitMesh& mesh)
      : env_(env), input_(input), mesh_(mesh) {}

  /** Adds a cell that is not split. */
  void add(Cell c) {
    const Form form = env_.map.form(c);
    if (form == Form::kGeneral && D == 3) {
      Loops loops(env_.memory);
      for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
        for_each_facet_vertex<D>(env_.map.shape(c), f,
                                 [&](uint32_t local) { loops.vertices.push_back(env_.map.vertex(c, local)); });
        loops.end_loop();
      }
      add(c, loops);
      return;
    }
    begin(c, number_of(form, D));
    env_.map.for_each_vertex(c, [&](uint32_t v) { mesh_.connectivity_.push_back(v); });
  }
  /** A polyhedron or polygon that is all or a part of a cell. */
  void add(Cell c, const Loops& loops) {
    begin(c, number_of(Form::kGeneral, D));
    if (D == 3) mesh_.connectivity_.push_back(loops.count());
    for (uint32_t i = 0; i < loops.count(); ++i) {
      if (D == 3) mesh_.connectivity_.push_back(loops[i].size());
      mesh_.connectivity_.insert(mesh_.connectivity_.end(), loops[i].begin(), loops[i].end());
    }
  }
  /** A part that may be a simplex. */
  void add_part(Cell c, const Loops& loops) {
    Array<uint32_t> vertices(loops.vertices);
    dsw::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (vertices.size() != D + 1 || (D == 3 && loops.count() != D + 1)) {
      add(c, loops);
      return;
    }
    begin(c, number_of(Form::kSimplex, D));
    if constexpr (D == 2) {
      for (const uint32_t v : loops.vertices) mesh_.connectivity_.push_back(v);
    } else {
      const uint32_t* const base = loops.vertices.data();  // clockwise seen from the vertex that it lacks
      for (const uint32_t v : {base[0], base[2], base[1]}) mesh_.connectivity_.push_back(v);
      for (const uint32_t v : vertices) {
        if (dsw::find(base, base + 3, v) == base + 3) mesh_.connectivity_.push_back(v);
      }
    }
  }
  void finish() { mesh_.offsets_.push_back(static_cast<int64_t>(mesh_.connectivity_.size())); }

 private:
  void begin(Cell c, dsw_cell_type type) {
    const uint32_t i = env_.map.index(c);
    mesh_.types_.push_back(static_cast<uint8_t>(type));
    mesh_.offsets_.push_back(static_cast<int64_t>(mesh_.connectivity_.size()));
    mesh_.parents_.push_back(env_.parent(c));
    if (input_.regions != nullptr) mesh_.regions_.push_back(input_.regions[i]);
    if (input_.tags != nullptr) mesh_.tags_.push_back(input_.tags[i]);
  }

  const Environment<D>& env_;
  const dsw_environment_desc& input_;
  SplitMesh& mesh_;
};

template <int D>
SplitMesh<D>::SplitMesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report)
    : types_(env.memory),
      offsets_(env.memory),
      connectivity_(env.memory),
      points_(env.memory),
      regions_(env.memory),
      tags_(env.memory),
      parents_(env.memory) {
  Array<Cell> cells = find_invalid(env);
  if (cells.empty()) return;
  std::optional<CellParts<D>> parts;
  split_cells(env, (input.flags & DSW_ENVIRONMENT_BORROW_POINTS) == 0, cells, parts, report);
  write(env, input, cells, *parts);
  describe(env, input, parts->places());
  for (uint32_t cell = 0; cell < cells.size(); ++cell) report.split_count += parts->count(cell) > 1 ? 1u : 0u;
  report.added_point_count += static_cast<uint32_t>(parts->places().added().size() / D);
}

template <int D>
void SplitMesh<D>::write(const Environment<D>& env, const dsw_environment_desc& input, const Array<Cell>& cells,
                         const CellParts<D>& parts) {
  Writer writer(env, input, *this);
  Loops loops(env.memory);
  const auto write_part = [&](size_t cell, uint32_t part) {
    loops = Loops(env.memory);
    parts.append(cell, cells[cell], part, loops);
    writer.add_part(cells[cell], loops);
  };
  size_t next = 0;
  for_each_cell(env.map, [&](Cell c) {
    if (next < cells.size() && cells[next] == c) {
      write_part(next++, 0);
      return;
    }
    loops = Loops(env.memory);
    if (parts.changes_others() && parts.append_other(c, loops)) {
      writer.add(c, loops);
    } else {
      writer.add(c);
    }
  });
  for (size_t cell = 0; cell < cells.size(); ++cell) {
    for (uint32_t part = 1; part < parts.count(cell); ++part) write_part(cell, part);
  }
  writer.finish();
}

template <int D>
void SplitMesh<D>::describe(const Environment<D>& env, const dsw_environment_desc& input, const PartPoints<D>& places) {
  made_ = input;
  made_.flags &=
      ~static_cast<uint32_t>(DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_REORIENT);
  made_.index_bytes = 8;
  made_.cell_types = types_.data();
  made_.volume_count = types_.size();
  made_.offsets = offsets_.data();
  made_.connectivity = connectivity_.data();
  made_.connectivity_count = connectivity_.size();
  made_.faces = made_.face_locations = nullptr;
  made_.faces_count = 0;
  if (input.regions != nullptr) made_.regions = regions_.data();
  if (input.tags != nullptr) made_.tags = tags_.data();
  const Array<double>& added = places.added();
  if (added.empty()) return;
  points_.assign(env.points, env.points + size_t{env.map.vertex_count} * D);
  points_.insert(points_.end(), added.begin(), added.end());
  if (points_.size() / D > kVertexMask) fail(DSW_STATUS_TOO_LARGE, "there are more than %u points", kVertexMask);
  made_.points = points_.data();
  made_.point_count = points_.size() / D;
  made_.point_stride_bytes = D * sizeof(double);
}

template class SplitMesh<2>;
template class SplitMesh<3>;

}  // namespace dsw
