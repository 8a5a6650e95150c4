#pragma once
// A cut along a blade, written as one edit [JCD10] 5.2: edges that the blade crosses are split, then facets, then
// cells. Cells for which that gives nothing valid stay whole.

#include <optional>

#include "cutting/inside.h"
#include "cutting/section.h"
#include "topology/edit.h"

namespace dsw {

/** Which cells can be split. */
enum class Splits { kAll, kPassable, kImpassable, kNothing };

struct CutSettings {
  double snap = 0.01;
  bool unsew = false;
  Splits splits = Splits::kAll;
  bool closes = false;  // with unsew: nothing gets through what is not impassable yet; cells that stay whole are marked
  double finest = 0;    // above 0: cells are not split along the blade, but halved until they are no longer than this
  bool covers = false;  // carving: what the blade meets goes, too
};

/** A vertex that came, and the edge on which: at `share` of the way from a to b. */
struct NewVertex {
  uint32_t vertex, a, b;
  double share;
};

/** A face of the cut, seen from before the blade and from behind it. */
struct CutFace {
  HalfFacet front, back;
};

struct CutRecord {
  Array<NewVertex> vertices;
  Array<CutFace> faces;
  Array<Cell> whole;                         // that the blade crosses; of a cut that closes: those that it marks
  uint32_t met = 0, split = 0, changed = 0;  // cells
  double distance = 0;

  explicit CutRecord(const Memory* memory) : vertices(memory), faces(memory), whole(memory) {}
};

template <int D>
class Cut {
 public:
  /** Crossings as a flood has left them. With `inside`, only cells are split of which one part is inside then and the
   * other is not. Throws std::bad_alloc. */
  Cut(Environment<D>& env, const Blade<D>& blade, const CutSettings& settings, const Crossings<D>& crossings,
      const Inside<D>* inside = nullptr);

  /** Prepares an edit. Throws BORROWED where vertices have to be added and can't be, TOO_LARGE, std::bad_alloc. */
  void prepare(std::optional<Edit<D>>& edit);

  /** After prepare(). */
  const CutRecord& record() const { return record_; }

 private:
  /** A line across a facet between two cells, cut alike on both sides. */
  struct Line {
    HalfFacet facet;  // seen from here the parts run from `from` to `to`, and back
    uint32_t from, to;
    bool drawn;
    FacetDraft parts[2];
    explicit Line(const Memory* memory) : drawn(false), parts{FacetDraft(memory), FacetDraft(memory)} {}
  };
  /** A cell in two parts: drafts and the number of the new facet in them. */
  struct Split {
    uint32_t cell;  // number of the met cell
    size_t front, back;
    uint32_t front_facet, back_facet;
  };
  /** A new vertex on an edge of a cell that changes, and one of the edge's darts. */
  struct OnEdge {
    uint32_t node, dart;
  };
  static constexpr size_t kNoDraft = static_cast<size_t>(-1);

  bool can_split(Cell c) const;
  bool undo_idle_splits(const Edit<D>& edit);
  bool write(Edit<D>& edit);
  void choose_nodes(Edit<D>& edit);
  void choose_lines();
  void choose_cells();
  void look_up_nodes(Cell c, const Shape& shape, ShortArray<uint32_t, 64>& out) const;
  bool write_cell(Edit<D>& edit, uint32_t number);
  bool write_lines(CellDraft& draft);
  void insert_vertices(CellDraft& draft, uint32_t number) const;
  bool draw_line(const FacetDraft& whole, Line& line) const;
  bool split_cell(Edit<D>& edit, uint32_t cell, CellDraft& whole);
  bool is_before_blade(const CellDraft& part, const NodeLoop& nodes) const;
  void find_old_faces();
  bool is_on_blade(Cell c, const Shape& shape, uint32_t facet) const;
  int side_of(uint32_t on, uint32_t off) const;
  int side_of(Cell c) const;
  void unsew_old_faces(Edit<D>& edit) const;
  void keep_whole(Cell c);
  void keep_whole_round(Cell c);
  void list_cells_at_nodes();
  /** The draft of a cell that changes and is not split, or that of a part; kNoDraft: it does not change. */
  size_t draft_of_cell(Cell c) const;
  void write_record(Edit<D>& edit);
  void measure(Edit<D>& edit);

  Environment<D>& env_;
  const Map<D>& map_;
  const Blade<D>& blade_;
  CutSettings settings_;
  const Crossings<D>& crossings_;
  const Inside<D>* inside_;
  std::optional<Section<D>> section_;
  Array<uint32_t> vertices_{env_.memory};        // by node; kNoCell: it is not needed
  Array<uint32_t> first_at_node_{env_.memory};   // of cells_at_nodes_, by node, and one more; empty: not listed yet
  Array<uint32_t> cells_at_nodes_{env_.memory};  // numbers of met cells whose loops have a node, some of them no longer
  KeyTable line_numbers_{env_.memory};           // by the lower address of the facet
  Array<Line> lines_{env_.memory};
  KeyTable changed_{env_.memory};                // cells, by unit
  Array<OnEdge> on_edges_{env_.memory};          // of these, in the order of the cells and then of the nodes
  Array<uint32_t> first_on_edges_{env_.memory};  // by number of the cell, and one more
  Array<size_t> drafts_{env_.memory};            // of these, the first of each
  Array<Cell> origins_{env_.memory};             // of drafts
  Array<Split> splits_{env_.memory};
  Array<CutFace> old_faces_{env_.memory};
  CutRecord record_;
};

}  // namespace dsw
