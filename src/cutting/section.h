#pragma once
// Which cells a blade splits and along which loops. Where it crosses an edge there is a node: a vertex to come, or the
// nearer end of the edge if that is within a share of its length; such a vertex then takes all crossings of its edges.
// Across a facet with two nodes runs one line; a cell is split where such lines, and edges between old vertices on the
// blade, are one closed loop round it. In the plane a cell with two nodes is split between them, as a facet is in
// space.
//
// A cell stays whole where the blade ends inside or crosses an edge twice, or where lines do not say how to split it.

#include "base/short_array.h"
#include "cutting/crossings.h"

namespace dsw {

/** A vertex of the cut: old where a == b, else to come on edge a b, `a` behind the blade. */
struct Node {
  uint32_t a, b;
  double share;
  uint32_t simplex;  // of the blade
  int side;          // of an old one: where it was, 1 before the blade, -1 behind it; 0: not to be told
  bool is_old() const { return a == b; }
};

/** The vertices of a cell's darts. Those of cells that are not large are looked up once. */
template <int D>
class DartEnds {
 public:
  DartEnds(const Map<D>& map, Cell c) : map_(map), cell_(c), shape_(map.shape(c)) {
    is_kept_ = shape_.vertex_count() <= kMost;
    uint32_t* next = vertices_;
    if (is_kept_) map.for_each_vertex(c, [&](uint32_t vertex) { *next++ = vertex; });
  }

  uint32_t count() const { return shape_.dart_count(); }
  uint32_t start(uint32_t d) const {
    const uint32_t local = shape_.dart_vertex(d);
    return is_kept_ ? vertices_[local] : map_.vertex(cell_, local);
  }
  uint32_t end(uint32_t d) const { return start(D == 3 ? shape_.beta1(d) : d + 1 == count() ? 0 : d + 1); }

 private:
  static constexpr uint32_t kMost = 32;

  const Map<D>& map_;
  Cell cell_;
  Shape shape_;
  bool is_kept_;
  uint32_t vertices_[kMost];
};

/** The nodes of one loop, in the loop's order. */
using NodeLoop = ShortArray<uint32_t, 8>;

/** A line across a facet that a loop takes; in the plane across a cell. */
struct Chord {
  uint32_t facet;  // of the cell, in space
  uint32_t from, to;
};

template <int D>
class Section {
 public:
  /** Throws std::bad_alloc, as all here. */
  Section(const Environment<D>& env, const Crossings<D>& crossings, double snap);

  uint32_t node_count() const { return static_cast<uint32_t>(nodes_.size()); }
  const Node& node(uint32_t i) const { return nodes_[i]; }
  /** The node of an edge, or of an old vertex; KeyTable::kNone: there is none. */
  uint32_t node_on(uint32_t a, uint32_t b) const { return places_.find(pair_key(a, b)); }
  uint32_t node_at(uint32_t vertex) const { return places_.find(pair_key(vertex, vertex)); }

  /** The nodes along which a met cell is split, two in the plane; empty: it stays whole. */
  const NodeLoop& loop(uint32_t cell) const { return loops_[cell]; }
  void keep_whole(uint32_t cell) { loops_[cell].clear(); }
  /** Whether the blade ends in a met cell, or crosses one of its edges twice, or nothing is known of its points. */
  bool is_barred(uint32_t cell) const { return barred_[cell]; }
  /** Whether the blade passes through a cell, not only along its boundary. */
  bool is_crossed(uint32_t cell) const { return crossed_[cell]; }

  /** Calls visit(chord) for those of a cell's loop, in space. */
  template <class Visit>
  void for_each_chord(uint32_t cell, Visit visit) const {
    for (uint32_t k = first_chords_[cell]; k < first_chords_[cell + 1]; ++k) visit(chords_[k]);
  }
  size_t chord_count() const { return chords_.size(); }

  /** Gives for a met cell the node on the edge of each dart, or KeyTable::kNone. Null if the cell is barred. */
  const uint32_t* nodes_on(uint32_t cell) const { return barred_[cell] ? nullptr : &nodes_on_[first_nodes_on_[cell]]; }

 private:
  /** A piece of a loop: a chord, or an edge between two old vertices. */
  struct Arc {
    uint32_t from, to;
    bool chord;
  };

  using Arcs = ShortArray<Arc, 24>;
  /** The nodes at a cell's vertices, and on the edges of its darts; KeyTable::kNone where there is none. */
  struct CellNodes {
    ShortArray<uint32_t, 32> at;
    ShortArray<uint32_t, 64> on;
    explicit CellNodes(const Memory* memory) : at(memory), on(memory) {}
  };

  bool read_nodes(Cell c, const Shape& shape, const Array<uint32_t>& of_crossings, CellNodes& out) const;
  bool is_crossed(const CellNodes& nodes) const;
  bool find_chord(const CellNodes& nodes, const Shape& shape, uint32_t facet, Chord& chord) const;
  void find_loop(uint32_t cell, const Shape& shape, const CellNodes& nodes);
  bool take_arcs(Arcs& arcs, NodeLoop& loop) const;
  bool prune(Arcs& arcs) const;
  bool is_facet(const CellNodes& nodes, const Shape& shape, const NodeLoop& loop) const;

  const Environment<D>& env_;
  const Map<D>& map_;
  const Crossings<D>& crossings_;
  Array<Node> nodes_{env_.memory};
  KeyTable places_{env_.memory};  // of nodes: both vertices of an edge, or twice the old one
  Array<NodeLoop> loops_;
  Array<uint8_t> barred_, crossed_;
  Array<uint32_t> nodes_on_{env_.memory};        // of the darts of all cells that are not barred
  Array<uint32_t> first_nodes_on_{env_.memory};  // by cell
  Array<Chord> chords_{env_.memory};             // of all loops
  Array<uint32_t> first_chords_{env_.memory};    // by cell, and one more
};

}  // namespace dsw
