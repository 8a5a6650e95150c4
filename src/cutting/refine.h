#pragma once
// Cells of space that a blade meets, halved until they are short. Each is halved across its longest extent: edges that
// the plane in the middle crosses get vertices, facets lines, the cell a facet along these lines. Cells beside it take
// the vertices and lines of what they share. All is one edit.

#include <optional>

#include "base/vec.h"
#include "cutting/cut.h"

namespace dsw {

class Refinement {
 public:
  /** Crossings as a flood has left them. Throws std::bad_alloc. */
  Refinement(Environment<3>& env, const Blade<3>& blade, const Crossings<3>& crossings, double finest);

  /** Prepares an edit. Throws BORROWED where vertices have to be added and can't be, TOO_LARGE, std::bad_alloc. */
  void prepare(std::optional<Edit<3>>& edit);

  /** After prepare(). `whole` lists parts that may meet the blade and are longer than asked for. */
  const CutRecord& record() const { return record_; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu, kUnread = 0xfffffffeu;
  static constexpr uint8_t kMostHalvings = 24;

  /** A facet, of one piece or of two: seen from outside of the first. */
  struct Face {
    FacetDraft facet;
    uint32_t pieces[2];  // kNone: the outer boundary; kUnread: of a cell that has not been read yet
  };
  /** A cell of the environment that has been read. */
  struct Root {
    Cell cell;
    uint32_t piece;  // the first one
    Vec axes[3];
    bool splits, changed;
  };
  /** A part of a root, at first all of it. */
  struct Piece {
    uint32_t root;
    uint8_t halvings;
    bool is_long;
    Array<uint32_t> faces;
    Array<uint32_t> simplices;  // of the blade, that may meet it
  };
  /** An edge of a list of faces that have it, or had it. */
  struct FaceOfEdge {
    uint32_t face, next;
  };
  /** A place on the plane in the middle of a piece: on the edge from a to b, or at vertex a if both are the same. */
  struct Place {
    uint32_t a, b;
    double share;
    bool is_vertex() const { return a == b; }
    uint64_t key() const { return pair_key(a, b); }
  };
  struct Arc {
    Place from, to;
    uint32_t face;  // that it crosses, or kNone: it is an edge
  };
  struct Plane;

  bool run(Edit<3>& edit);
  void write(Edit<3>& edit);
  void write_piece(Edit<3>& edit, uint32_t number);
  void write_record(const Edit<3>& edit);
  void keep_whole(uint32_t piece);

  uint32_t read_cell(Cell c);
  void set_axes(uint32_t piece);
  void read_other_side(uint32_t face);
  void add_edges(uint32_t face);
  void add_to_edge(uint32_t a, uint32_t b, uint32_t face);

  void list_vertices_of(uint32_t piece, Array<uint32_t>& out) const;
  void find_centre(uint32_t piece, double* out) const;
  bool may_meet(uint32_t simplex, const Array<uint32_t>& vertices) const;
  void choose_simplices(uint32_t piece, const Array<uint32_t>& from);

  enum class Halved { kYes, kNo, kFailed };
  Halved halve(Edit<3>& edit, uint32_t piece);
  double lay_plane(const Vec& axis, Plane& plane) const;
  bool cross_face(uint32_t face, const uint32_t* first, const Plane& plane, Array<Arc>& arcs) const;
  bool find_loop(uint32_t piece, const Plane& plane, Array<Arc>& arcs) const;
  static bool order_arcs(Array<Arc>& arcs);
  bool divide(Edit<3>& edit, uint32_t piece, const Plane& plane, const Array<Arc>& arcs);
  bool add_face_between(uint32_t lower, uint32_t upper, const Vertices& loop);
  bool runs_along(uint32_t face, uint32_t piece, uint32_t a, uint32_t b) const;
  uint32_t split_edge(Edit<3>& edit, const Place& place);
  bool split_face(uint32_t face, uint32_t from, uint32_t to);
  void mark_changed(uint32_t face);

  Environment<3>& env_;
  const Map<3>& map_;
  const Blade<3>& blade_;
  const Crossings<3>& crossings_;
  double finest_;
  KeyTable kept_{env_.memory};  // units of cells that stay whole
  KeyTable root_numbers_{env_.memory};
  Array<Root> roots_{env_.memory};
  Array<Piece> pieces_{env_.memory};
  KeyTable face_numbers_{env_.memory};  // of the faces of the environment, by the lower address
  Array<uint32_t> faces_by_number_{env_.memory};
  Array<Face> faces_{env_.memory};
  KeyTable edges_{env_.memory};
  Array<uint32_t> first_of_edge_{env_.memory};
  Array<FaceOfEdge> of_edges_{env_.memory};
  KeyTable marked_{env_.memory};          // edges that came of marked ones
  KeyTable gone_{env_.memory};            // edges that got a vertex
  Array<size_t> drafts_{env_.memory};     // by piece
  Array<uint32_t> drafted_{env_.memory};  // pieces, by draft
  uint32_t pairs_ = 0;
  CutRecord record_;
};

}  // namespace dsw
