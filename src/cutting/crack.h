#pragma once
// What of a crack comes apart: the vertices round which its faces leave the cells in two, and which of these get which
// copy.
//
// Seen from a vertex the cells at it are polygons on a sphere (on the outer boundary a part of it), and the crack a
// line there. Where the line ends inside of material the vertex stays one. Where it ends at cells of the space into
// which the crack opens, such as air beside a tissue, it is carried on through these, from one end to the other or to
// the outer boundary: then they, too, are on its two sides, and the tissue's surface parts.
//
// In the plane the cells at a vertex are arcs of a circle, and the crack is points on it: two of them leave the arcs in
// two sets, or one and the outer boundary, or one and the corner of a cell of the space, which is where the gap opens
// into that.

#include "base/disjoint_sets.h"
#include "base/key_table.h"
#include "map/cell_queue.h"
#include "topology/operations.h"

namespace dsw {

/** An edge of the crack's rim, at space: the cell in which the gap ends there, named by a dart of the edge. In the
 * plane it is a vertex, where the dart starts. */
struct Mouth {
  Dart dart;
  uint32_t pair;
};

template <int D>
class Crack {
 public:
  static constexpr uint32_t kNone = KeyTable::kNone;

  /** Cells of `region` are space, too, unless that is 0. Throws as all here std::bad_alloc. */
  Crack(Environment<D>& env, int32_t region);

  /** Adds a face: an inner one, or two on the outer boundary that lie on each other. `i` names it in messages. Throws
   * BAD_TOPOLOGY, DUPLICATE_ID. */
  void add(HalfFacet a, HalfFacet b, size_t i);
  /** After all are added. O(darts of the cells at their vertices). */
  void part();

  uint32_t pair_count() const { return static_cast<uint32_t>(pairs_.size()); }
  const FacetPair& pair(uint32_t i) const { return pairs_[i]; }
  const Array<Mouth>& mouths() const { return mouths_; }

  /** A vertex that comes apart: copy 1 is the one to which the normal leads. */
  struct Parting {
    uint32_t vertex;
    double normal[3];
    uint32_t first_cell, end_cell;  // of cell()
  };
  const Array<Parting>& partings() const { return partings_; }
  Cell cell(uint32_t i) const { return cells_[i]; }

  /** Twice the number of the parting, with the copy, that a dart's facet has at its start or end; kNone: one vertex. */
  uint32_t copy_at_start(Dart d) const { return copy_of(start_key(d)); }
  uint32_t copy_at_end(Dart d) const { return copy_of(end_key(d)); }

 private:
  /** A half-facet of the crack at a vertex. */
  struct Corner {
    uint32_t vertex, pair, side;
    bool operator<(const Corner& o) const {
      return vertex != o.vertex ? vertex < o.vertex : pair != o.pair ? pair < o.pair : side < o.side;
    }
  };
  /** What of the crack and of its mouths is at a vertex. */
  struct Meeting {
    uint32_t vertex;
    const Corner* corners;
    size_t count;
    const Array<uint32_t>& mouths;
  };
  struct MouthAt {
    uint32_t vertex, mouth;
    bool operator<(const MouthAt& o) const { return vertex != o.vertex ? vertex < o.vertex : mouth < o.mouth; }
  };

  static uint64_t start_key(Dart d) { return uint64_t{d.cell.unit} << 32 | d.local << 1; }
  static uint64_t end_key(Dart d) { return start_key(d) | 1; }
  uint32_t copy_of(uint64_t key) const {
    const uint32_t place = places_.find(key);
    return place == kNone ? kNone : copies_[place];
  }
  bool is_in_crack(HalfFacet h) const { return sides_.find(h.word) != kNone; }
  HalfFacet side(const Corner& c) const { return c.side == 0 ? pairs_[c.pair].a : pairs_[c.pair].b; }
  uint64_t key_at(HalfFacet h, uint32_t vertex) const;
  bool is_space(Cell c, uint32_t pair) const;
  HalfFacet go_round(Dart d, Array<Dart>& passed) const;
  void find_mouth(Dart rim, uint32_t pair, const Array<Dart>& passed);
  void find_mouths();
  void part_vertex(const Meeting& at);
  bool find_cells_at(const Meeting& at, CellQueue& around) const;
  template <class Visit>
  void for_each_dart_at(uint32_t vertex, const CellQueue& around, Visit visit) const;
  DisjointSets join_ends(const Meeting& at, const CellQueue& around, const KeyTable& crossed, KeyTable& ends) const;
  template <class RootAt>
  bool find_normal(const Meeting& at, uint32_t first, RootAt root_at, double* out) const;
  void rough_normal(const Meeting& at, double* normal) const;
  bool find_line(const Meeting& at, KeyTable& crossed) const;
  bool find_shortest_line(const Meeting& at, const double* normal, KeyTable& crossed) const;
  bool is_mouth(Dart d, const Array<uint32_t>& mouths) const;

  Environment<D>& env_;
  const Map<D>& map_;
  int32_t region_;
  Array<FacetPair> pairs_{env_.memory};
  KeyTable sides_{env_.memory};  // half-facets of pairs, by word
  Array<Mouth> mouths_{env_.memory};
  Array<Parting> partings_{env_.memory};
  Array<Cell> cells_{env_.memory};
  KeyTable places_{env_.memory};         // both ends of the darts at vertices that come apart
  Array<uint32_t> copies_{env_.memory};  // of these
};

}  // namespace dsw
