#pragma once
// A crack opens: the copies of its vertices move apart, and the gap between its lips is filled with passable cells, one for each face. Written as
// one edit [JCD10] 5.2.

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

  explicit OpenRecord(const Memory* memory)
      : vertices(Allocator<NewVertex>(memory)), faces(Allocator<CutFace>(memory)) {}
};

class Opening {
 public:
  /** The crack is parted, and outlives this. Throws std::bad_alloc. */
  Opening(Environment<3>& env, const Crack& crack, const OpenSettings& settings);

  /** Prepares an edit. Throws BORROWED where vertices have to be added and can't be, TOO_LARGE, std::bad_alloc. */
  void prepare(std::optional<Edit<3>>& edit);

  /** After prepare(). */
  const OpenRecord& record() const { return record_; }

 private:
  /** How far the copies of a vertex go. Both shares 1: half of the width each; what one can't go the other one goes, if it can. */
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
  /** A facet across the gap, over an edge of the crack. */
  struct Side {
    uint64_t edge;
    Place at;
  };
  /** A face that opens: what its lips and the cell between them are drafted as. */
  struct Gap {
    Place lips[2];
  };

  void write(Edit<3>& edit, Array<uint32_t>& bad);
  void add_vertices(Edit<3>& edit);
  bool place_copies(const Crack::Parting& parting, const Way& way, double (&places)[2][3]) const;
  void write_cells(Edit<3>& edit);
  void write_facet(FacetDraft& facet, Dart first) const;
  void move_marks(Edit<3>& edit, Cell c) const;
  void add_mouths(Edit<3>& edit);
  void add_gaps(Edit<3>& edit);
  void add_gap(Edit<3>& edit, const FacetPair& pair);
  void add_side(Edit<3>& edit, size_t draft, FacetDraft&& facet, uint32_t a, uint32_t b);
  void join_sides(Edit<3>& edit);
  void cut_facets(Edit<3>& edit, Array<uint32_t>& bad) const;
  void find_folds(Edit<3>& edit, Array<uint32_t>& bad) const;
  void shorten(Edit<3>& edit, const Array<uint32_t>& drafts);
  void write_record(Edit<3>& edit);
  uint32_t vertex_of(uint32_t copy, uint32_t before) const;
  uint32_t at_start(Dart d) const { return vertex_of(crack_.copy_at_start(d), dart_vertex(map_, d)); }
  uint32_t at_end(Dart d) const { return vertex_of(crack_.copy_at_end(d), dart_target(map_, d)); }

  Environment<3>& env_;
  const Map<3>& map_;
  const Crack& crack_;
  OpenSettings settings_;
  Array<Way> ways_;           // by parting
  KeyTable fresh_;            // new vertices
  Array<uint32_t> of_fresh_;  // twice the number of the parting, with that of the copy
  KeyTable changed_;          // cells by unit; numbers are those of their drafts
  Array<Gap> gaps_;
  Array<Side> sides_;
  uint32_t pairs_ = 0;  // of new facets
  OpenRecord record_;
};

}  // namespace dsw
