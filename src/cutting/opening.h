#pragma once
// A crack opens: the copies of its vertices move apart, and the gap between its lips is filled with passable cells, one
// for each face. Written as one edit [JCD10] 5.2.

#include <optional>

#include "cutting/crack.h"
#include "cutting/cut.h"

namespace dsw {

struct OpenSettings {
  double width;
  int32_t region;  // of the gap
  uint32_t tag;
};

struct OpenRecord {
  Array<NewVertex> vertices;  // both copies of each, from that one
  Array<CutFace> faces;       // lips of the gap
  uint32_t shortened = 0, changed = 0;
  double smallest = 0, largest = 0;  // width

  explicit OpenRecord(const Memory* memory) : vertices(memory), faces(memory) {}
};

template <int D>
class Opening {
 public:
  /** The crack is parted, and outlives this. Throws std::bad_alloc. */
  Opening(Environment<D>& env, const Crack<D>& crack, const OpenSettings& settings);

  /** Prepares an edit. Throws BORROWED where vertices have to be added and can't be, TOO_LARGE, std::bad_alloc. */
  void prepare(std::optional<Edit<D>>& edit);

  /** After prepare(). */
  const OpenRecord& record() const { return record_; }

 private:
  /** How far the copies of a vertex go. Both shares 1: half of the width each; what one can't go the other one goes, if
   * it can. */
  struct Way {
    double shares[2] = {1, 1};
    bool stays = false;
    uint32_t copies[2] = {0, 0};
    double length(int k) const { return shares[k] * (1 - 0.5 * shares[1 - k]); }
    void shorten(int k);
  };
  struct Place {
    size_t draft;
    uint32_t facet;
  };
  /** A facet across the gap, over a ridge of the crack: the key of an edge, in the plane of a vertex. */
  struct Side {
    uint64_t ridge;
    Place at;
  };
  /** A face that opens: what its lips and the cell between them are drafted as. */
  struct Gap {
    Place lips[2];
  };

  void write(Edit<D>& edit, Array<uint32_t>& bad);
  void add_vertices(Edit<D>& edit);
  bool place_copies(const typename Crack<D>::Parting& parting, const Way& way, double (&places)[2][D]) const;
  void write_cells(Edit<D>& edit);
  void write_facet(FacetDraft& facet, Dart first) const;
  void move_marks(Edit<D>& edit, Cell c) const;
  void add_mouths(Edit<D>& edit);
  void add_gaps(Edit<D>& edit);
  void add_gap(Edit<D>& edit, const FacetPair& pair);
  void add_side(Edit<D>& edit, size_t draft, FacetDraft&& facet, uint64_t ridge);
  void join_sides(Edit<D>& edit);
  void cut_facets(Edit<D>& edit, Array<uint32_t>& bad) const;
  void find_folds(Edit<D>& edit, Array<uint32_t>& bad) const;
  void shorten(Edit<D>& edit, const Array<uint32_t>& drafts);
  void write_record(Edit<D>& edit);
  uint32_t vertex_of(uint32_t copy, uint32_t before) const;
  /** Names the edge from a to b, in the plane the vertex a. */
  static uint64_t ridge_key(uint32_t a, uint32_t b) { return pair_key(a, D == 3 ? b : a); }
  uint32_t at_start(Dart d) const { return vertex_of(crack_.copy_at_start(d), dart_vertex(map_, d)); }
  uint32_t at_end(Dart d) const { return vertex_of(crack_.copy_at_end(d), dart_target(map_, d)); }

  Environment<D>& env_;
  const Map<D>& map_;
  const Crack<D>& crack_;
  OpenSettings settings_;
  Array<Way> ways_;                        // by parting
  KeyTable fresh_{env_.memory};            // new vertices
  Array<uint32_t> of_fresh_{env_.memory};  // twice the number of the parting, with that of the copy
  KeyTable changed_{env_.memory};          // cells by unit; numbers are those of their drafts
  Array<Gap> gaps_{env_.memory};
  Array<Side> sides_{env_.memory};
  uint32_t pairs_ = 0;  // of new facets
  OpenRecord record_;
};

}  // namespace dsw
