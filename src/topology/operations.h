#pragma once
// The basic operations of the topology [JCD10] 5.2, each written into an edit that is new. They check how the cells are
// arranged and throw BAD_TOPOLOGY with a message that says what is wrong; what is left to check, exactly, is the
// edit's.

#include "map/dart.h"
#include "topology/edit.h"

namespace dsw {

struct FacetPair {
  HalfFacet a, b;
};

/** Each pair becomes one face: both on the outer boundary, with the same vertices. Where they are cut differently one
 * of the two volumes is cut anew, if it stays valid. */
template <int D>
void sew(Edit<D>& edit, const FacetPair* pairs, size_t count);
/** A face between two volumes becomes two on the outer boundary. */
template <int D>
void unsew(Edit<D>& edit, HalfFacet h);

/** The host's arrays, read in place; see dsw_volumes_desc. */
struct NewCells {
  const uint32_t* vertices;  // of the environment: what indices in connectivity mean
  size_t vertex_count;
  const uint8_t* cell_types;
  uint32_t uniform_cell_type;
  size_t cell_count;
  uint32_t index_bytes;
  const void* offsets;
  const void* connectivity;
  size_t connectivity_count;
  const int32_t* regions;
  const uint32_t* tags;
  const HalfFacet* sew_to;
  size_t sew_count;
};
/** Adds volumes, joined with each other where they share faces, and with given faces on the outer boundary. Drafts are
 * theirs, in order. Throws also BAD_CELL_TYPE, WRONG_SIZE, INDEX_OUT_OF_RANGE, DUPLICATE_CELL, SHARED_FACE,
 * NOT_FOUND. */
template <int D>
void add_cells(Edit<D>& edit, const NewCells& input);

template <int D>
void remove_cells(Edit<D>& edit, const Cell* cells, size_t count);
/** Two volumes become one: all faces that they share go. Returns its draft. */
template <int D>
size_t merge_cells(Edit<D>& edit, HalfFacet h);
/** What a volume was split into: `left` lies to the left of the loop (seen from outside), and keeps the index. */
struct SplitCell {
  size_t left, right;
  uint32_t left_facet, right_facet;  // the new face
};
/** Inserts a face along a closed loop of edges of a volume; in the plane a side between two corners of a polygon. */
template <int D>
SplitCell split_cell(Edit<D>& edit, Cell c, const uint32_t* loop, size_t count);

/** Inserts an edge between two vertices of a face, on both of its sides. Returns the facets on the side of `h`: that
 * from a to b, and that from b to a, in its draft. */
struct SplitFacet {
  size_t draft;
  uint32_t from_a, from_b;
};
SplitFacet split_facet(Edit<3>& edit, HalfFacet h, uint32_t a, uint32_t b);
/** Removes an edge with two faces, which become one. Returns the facet on the side of the dart's volume. */
struct MergedFacet {
  size_t draft;
  uint32_t facet;
};
MergedFacet merge_facets(Edit<3>& edit, Dart d);
/** Puts one facet with this loop in the place of two of a cell that lie beside each other and have the same cell behind
 * them, or none: on both of their sides. Returns it on this side. */
template <int D>
MergedFacet unite(Edit<D>& edit, HalfFacet h, HalfFacet g, const Vertices& loop);

/** Inserts a vertex at a share of the way along an edge, in the plane a side, rounded. Returns it. Draft 0 is that of
 * the dart's cell. */
template <int D>
uint32_t split_edge(Edit<D>& edit, Dart d, double share);
/** Removes a vertex that has two edges, in the plane sides; `d` is one of them. Returns the ends of the edge that they
 * become, in draft 0 that of the dart's cell. */
struct MergedEdge {
  uint32_t a, b;
};
MergedEdge merge_edges(Edit<3>& edit, Dart d, uint32_t vertex);
MergedEdge merge_edges(Edit<2>& edit, Dart d, uint32_t vertex);
/** Merges `vertex` into the other end of its edge `d`. */
template <int D>
void collapse_edge(Edit<D>& edit, Dart d, uint32_t vertex);

}  // namespace dsw
