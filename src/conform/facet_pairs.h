#pragma once
// Which outer facets lie on each other, and which corners lie on edges because of that.

#include "conform/hanging_points.h"

namespace dsw {

/** The plane in which a loop is looked at: a coordinate is left out. */
struct LoopView {
  int axis = 2;
  int sense = 1;  // of the loop, counter-clockwise seen from outside, in that plane
};

/** Pairs of outer facets of different cells that are turned against each other and overlap, such that the corners of one of
 * them are corners of the other one or lie on its edges or in its plane. */
class FacetPairs {
 public:
  /** Points within `room` of an edge or of the plane of a facet lie on it; 0: exactly. Points on edges are added to `hanging`.
   * Expected O(n log n) for n facets of like size. Throws std::bad_alloc. */
  FacetPairs(const Environment<3>& env, const OuterFacets<3>& outer, double room, HangingPoints<3>& hanging);

  /** Gives the facets that make a pair with facet i, ascending. */
  VertexRange partners(uint32_t i) const { return {partners_.data() + first_[i], partners_.data() + first_[i + 1]}; }
  /** Gives the loop of facet i, with all points that lie on its edges. */
  VertexRange loop(uint32_t i) const { return loops_[i]; }
  LoopView view(uint32_t i) const { return faces_[i].view; }

 private:
  /** What is asked of a facet again and again. */
  struct Face {
    LoopView view;
    uint32_t largest;         // of its triangles, seen in the view: where it starts
    bool is_flat, is_convex;  // is_convex: for certain
  };

  Array<uint32_t> find_inner() const;
  Face face_of(uint32_t i) const;
  const double* point(uint32_t v) const { return env_.point(v); }
  void points_of(const uint32_t* triangle, const double* (&points)[3]) const;
  int turn(LoopView view, uint32_t a, uint32_t b, uint32_t c) const;
  bool is_in_plane(const uint32_t* triangle, const double* p) const;
  bool lies_on(uint32_t i, uint32_t vertex) const;
  bool all_lie_on(uint32_t i, uint32_t j) const;
  bool are_opposite(uint32_t i, uint32_t j) const;
  bool is_separating(uint32_t i, uint32_t j, LoopView view) const;
  bool triangles_overlap(uint32_t i, uint32_t j) const;
  bool overlap(uint32_t i, uint32_t j) const;
  void find_pairs(const Array<uint32_t>& inner);
  void hang(uint32_t i, VertexRange points);
  void fill_loops();

  const Environment<3>& env_;
  const OuterFacets<3>& outer_;
  double room_;
  HangingPoints<3>& hanging_;
  Array<Face> faces_;      // of facets that may have partners
  Array<ItemPair> pairs_;  // in no certain order
  Array<uint32_t> first_, partners_;
  Loops loops_;
};

}  // namespace dsw
