#pragma once
// Edges that are seen to be free where their ends go, without a cast.

#include "base/compiler.h"
#include "response/course.h"
#include "response/turn_words.h"
#include "walk/short_way.h"

namespace dsw {

/** A function of this type writes the words of `count` vertices, and the numbers of the vertices that are in doubt. Returns how many are in
 * doubt.
 * @param now gets the same words; may be `words`.
 * @param has_others whether a vertex stays in a cell that is not convex. */
using WriteTurnWords = uint32_t (*)(const Map<3>& map, const VertexWay* ways, const Course<3>::Vertex* turns,
                                    uint32_t count, uint32_t* words, uint32_t* now, uint32_t* in_doubt,
                                    bool* has_others);

/** The fastest of this processor; all give the same bits. */
extern const WriteTurnWords kWriteTurnWords;

uint32_t write_turn_words(const Map<3>& map, const VertexWay* ways, const Course<3>::Vertex* turns, uint32_t count,
                          uint32_t* words, uint32_t* now, uint32_t* in_doubt, bool* has_others);
#if DSW_X86_64
uint32_t write_turn_words_avx2(const Map<3>& map, const VertexWay* ways, const Course<3>::Vertex* turns, uint32_t count,
                               uint32_t* words, uint32_t* now, uint32_t* in_doubt, bool* has_others);
#endif

/** Sees edges that stay in one convex cell [JCD10] 6.1, or lie in a few convex cells one after the other.
 *
 * The end v that goes first is at its target both times that an edge is tested: before and after the turn of the other end, w.
 * Let w stay in the convex cell B, and let the target lie outside of one facet of B alone. Then the way to the target leaves B
 * by that facet, from wherever in B it comes, and the next cell is asked in the same way until it is the one that holds the
 * target. So one look at B tells of both tests, and of all edges between v and what stays in B. If the target lies outside of
 * two facets of B, the side on which the edge passes their ridge decides by which it leaves. From there each edge is followed
 * alone. */
template <int D>
class ShortEdges {
 public:
  static constexpr uint32_t kMost = 64;
  static constexpr uint32_t kMostLooks = 3;
  static constexpr uint32_t kMostCells = 1 + kMostLooks + kMostFurtherLooks;  // that an edge lies in

  /** A bit for each edge: whether it is seen to be free at the turn of its first end, and at that of its second one; whether
   * both of its ends move, and none is in doubt or will be as a neighbour does not arrive; whether an end goes inwards. */
  struct Seen {
    uint64_t first = 0, second = 0, sure = 0, inwards = 0;
  };

  ShortEdges(const Environment<D>& env, const Course<D>& course) : env_(env), course_(course) {}

  /** For a course that knows where its vertices arrive. Throws std::bad_alloc.
   * @param looks whether cells may be looked at, in space: else only edges that stay in a convex cell are seen. */
  void start(bool looks);
  /** A word for each vertex, as it was at the start. */
  const uint32_t* words() const { return words_.data(); }
  /** The words as they are now: the course writes what has been put in doubt. Only if cells are looked at. */
  uint32_t* words_now() { return now_.data(); }
  static_assert(kMostUnits <= uint64_t{1} << (32 - TurnWord::kBits), "a unit has room above the bits");
  /** Whether a vertex stays in a cell that is not convex. */
  bool has_others() const { return has_others_; }
  /** What is seen of at most kMost edges. Of an end that does not move nothing is told. */
  Seen find(const uint32_t* edges, uint32_t count);
  /** Which of at most kMost edges are seen to be free where their ends arrive, a bit each.
   * @pre no end is in doubt at the start. */
  uint64_t find_arrivals(const uint32_t* edges, uint32_t count);

 private:
  static constexpr uint32_t kMostPairs = 2 * kMost;
  static_assert(kMostPairs <= kPacket, "they are looked at together");
  static constexpr uint32_t kFirst = 1, kSecond = 2;  // turns

  /** An edge, the question about the end that goes first and the cell of the other end, and the turns at which the other end is there.
   * `place` and `turns` are no bytes: a byte may alias everything, so compilers would read all else again after it is written. */
  struct Pair {
    uint32_t question;
    uint16_t place, turns;
  };
  struct Ends {
    uint32_t first, second;  // in the order of their turns
  };
  /** What was asked of a vertex: whether its target is reached from a cell. */
  struct Asked {
    uint32_t cell = kNone, question = 0;
  };
  /** The last two such questions, the last one first. */
  struct LastAsked {
    Asked of[2];
  };
  /** kReached; or the two facets that have the target outside, and the last cell that was looked at; or 0: nothing is known. */
  struct Answer {
    static constexpr uint32_t kReached = 1u << 31;
    uint32_t facets = 0;
    Cell cell;
  };

  Ends ends_of(const BodyEdge& edge) const {
    const uint32_t a = edge.ends[0], b = edge.ends[1];
    return course_.vertices[b].rank < course_.vertices[a].rank ? Ends{b, a} : Ends{a, b};
  }
  void doubt_neighbours(uint32_t v);
  void gather(const uint32_t* edges, uint32_t count, Seen& seen);
  void add_turns(const uint32_t* edges, uint32_t place, Seen& seen);
  void gather_arrivals(const uint32_t* edges, uint32_t count, Seen& seen);
  void add(uint32_t v, uint32_t cell, uint32_t place, uint32_t turns);
  void tell(const uint32_t* edges, Seen& seen);
  void answer();
  TwoWays ways_of(const Pair& pair, const Answer& at, const BodyEdge& edge) const;

  const Environment<D>& env_;
  const Course<D>& course_;
  bool has_others_ = false;
  Array<uint32_t> words_{env_.memory};     // by vertex
  Array<uint32_t> now_{env_.memory};       // by vertex
  Array<uint32_t> in_doubt_{env_.memory};  // vertices, at the start
  Array<LastAsked> asked_{env_.memory};    // by vertex
  Array<Answer> answers_{env_.memory};     // by question
  // What is asked of the edges that are looked at.
  uint32_t pair_count_ = 0, question_count_ = 0, answered_ = 0;  // the last is answers_.size(), which takes longer
  Pair pairs_[kMostPairs];
  TwoWays ways_[kMostPairs];
  // Each question that is not answered yet has one of these.
  Cell cells_[kMostPairs], arrivals_[kMostPairs];
  const double* points_[kMostPairs];
};

}  // namespace dsw
