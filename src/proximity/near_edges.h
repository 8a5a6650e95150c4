#pragma once
// Which edges of a body can come near which in one move: found once, so that its vertices need not ask one by one.

#include <cmath>

#include "body/body.h"
#include "predicates/swept_plane.h"

namespace dsw {

/** The edges of a body in space that meets itself. While an edge and what it sweeps keep to its box, that of the whole
 * ways of its ends, it can touch those alone whose boxes overlap this one. An edge that is new, or has left its box, is
 * a stray: all others look at it, and its own touches are found by the body's grids. */
class NearEdges {
 public:
  explicit NearEdges(const Memory* memory)
      : of_vertices_(memory),
        ways_(memory),
        steps_(memory),
        places_(memory),
        starts_(memory),
        entries_(memory),
        pairs_(memory),
        first_(memory),
        near_(memory) {}

  /** Starts a move of a body whose vertices all have edges; target(v) is where vertex v goes, or stays. Those that
   * slide have room about their targets. Does nothing where the grids serve better. Throws std::bad_alloc. */
  template <class Target>
  void start(const Body<3>& body, bool slides, Target target) {
    stop();
    of_vertices_.assign(body.vertices.size(), Box<3>());
    for (uint32_t v = 0; v < of_vertices_.size(); ++v) {
      if (body.has_vertex(v)) add_way(of_vertices_[v], body.position(v), target(v), slides);
    }
    ways_.assign(body.edges.size(), Box<3>());
    for (uint32_t e = 0; e < ways_.size(); ++e) {
      if (!body.has_edge(e)) continue;
      ways_[e] = of_vertices_[body.edges[e].ends[0]];
      ways_[e].add(of_vertices_[body.edges[e].ends[1]]);
    }
    active_ = find_pairs(body);
  }
  void stop() noexcept {
    active_ = false;
    stray_count_ = 0;
  }
  bool active() const noexcept { return active_; }

  /** Whether an edge keeps to its box when one of its ends goes to `to`. */
  bool keeps(uint32_t e, const double* to) const noexcept {
    return active_ && e < ways_.size() && ways_[e].contains(to);
  }
  /** Whether no edge has left its box, and all edges at v keep to theirs when v goes to `to`. */
  bool all_keep(uint32_t v, const double* to) const noexcept {
    return active_ && stray_count_ == 0 && v < of_vertices_.size() && of_vertices_[v].contains(to);
  }
  /** The error bound of determinants of the body's points and `to`, if all_keep(v, to); see swept_plane.h. */
  double bound() const noexcept { return bound_; }
  /** Notes that a vertex was put in another place: makes strays of edges that leave their boxes. */
  void follow(const Body<3>& body, uint32_t v) noexcept {
    for_each_edge(body, v, [&](uint32_t e) {
      if (!keeps(e, body.position(v))) make_stray(e);
      return true;
    });
  }
  /** Makes an edge a stray. */
  void make_stray(uint32_t e) noexcept;
  bool is_alone(uint32_t e) const noexcept { return first_[e] == first_[e + 1] && stray_count_ == 0; }
  /** Calls visit(edge) for those that one which keeps to its box can touch and that had no vertex in common with it
   * when the move started, and for strays, until it returns false; whether it never did. */
  template <class Visit>
  bool visit(uint32_t e, Visit visit) const {
    for (uint32_t i = first_[e]; i < first_[e + 1]; ++i) {
      if (!visit(near_[i])) return false;
    }
    for (uint32_t i = 0; i < stray_count_; ++i) {
      if (!visit(strays_[i])) return false;
    }
    return true;
  }

 private:
  static constexpr uint32_t kMostStrays = 32;
  /** A box in steps of a lattice, three numbers in a word; those of `high` have a bit set above each. */
  struct Steps {
    uint64_t low, high;
    uint32_t cells;  // that it meets; 0: there is no box
  };
  struct Entry {
    uint64_t low, high;
    uint32_t edge, at_low;
  };

  static void add_way(Box<3>& box, const double* from, const double* to, bool slides) noexcept {
    box.add(from);
    box.add(to);
    if (!slides) return;
    const double way = std::max({std::fabs(to[0] - from[0]), std::fabs(to[1] - from[1]), std::fabs(to[2] - from[2])});
    const double low[3] = {to[0] - way, to[1] - way, to[2] - way}, high[3] = {to[0] + way, to[1] + way, to[2] + way};
    box.add(low);
    box.add(high);
  }
  bool find_pairs(const Body<3>& body);
  bool find_steps();
  template <class Visit>
  void for_each_cell(const Steps& steps, Visit visit) const;
  bool sort_into_cells();
  void note_pair(const Body<3>& body, uint32_t a, uint32_t b);

  bool active_ = false;
  Array<Box<3>> of_vertices_;  // their ways
  Array<Box<3>> ways_;         // by edge; empty for strays
  double bound_ = kNoBound;
  Box<3> all_;                    // of these
  Array<Steps> steps_;            // by edge
  int halvings_ = 0;              // from a cell to a step
  Array<uint32_t> places_;        // by edge, those of its cells, as `place << 3 | at_low`
  Array<uint32_t> starts_;        // by place
  Array<Entry> entries_;          // of boxes by place
  Array<uint32_t> pairs_;         // two edges each
  Array<uint32_t> first_, near_;  // by edge
  uint32_t strays_[kMostStrays] = {}, stray_count_ = 0;
};

}  // namespace dsw
