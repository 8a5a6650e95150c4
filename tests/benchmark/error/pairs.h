// One thing against one other, without a scene: a vertex p that moves to p' against a triangle, or an edge p q whose
// end moves to p' against a segment. What is true of each pair, and peers that answer it.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_PAIRS_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_PAIRS_H

#include "curve.h"
#include "moves.h"

#include <optional>

namespace dsw::curves {

struct Pair {
  Vec from, to;
  Vec fixed;                      // an edge's other end; unused by a vertex
  std::array<Vec, 3> corners;     // of the triangle, or of the segment: two
  std::optional<mpq_class> time;  // when they first have a point in common, exactly; none: never
};

enum class PairKind { kVertexFace, kEdgeEdge };

struct Pairs {
  PairKind kind;
  std::vector<Pair> list;
  std::size_t hits() const;
};

/** What a method answers to one pair. */
struct PairAnswer {
  double time = -1;  // below 0: they do not meet
  bool has_contact = false;
  Vec point{}, normal{};  // with has_contact
};

/** Exact times; pairs in one plane count as never, and an edge whose fixed end lies on the segment, too. */
std::optional<mpq_class> vertex_face_time(const Pair& pair);
std::optional<mpq_class> edge_edge_time(const Pair& pair);

/** First contacts of moves in a scene, each followed by the same with its obstacle moved aside, which mostly misses. */
Pairs random_pairs(Place& place, Rng& rng, PairKind kind, std::size_t count);
/** Small integers: contacts on corners and edges, some a unit in the last place beside. */
Pairs degenerate_pairs(Rng& rng, PairKind kind, std::size_t count);

/** Collects methods, each with room for its answers. */
class PairMethods {
 public:
  explicit PairMethods(const Pairs& pairs) : pairs_(pairs) {}
  /** @param answer (pair) -> PairAnswer, timed. */
  template <class Answer>
  void add(std::string name, std::string setting, std::string unit, Answer answer) {
    rooms_.push_back(std::make_unique<std::vector<PairAnswer>>(pairs_.list.size()));
    std::vector<PairAnswer>* room = rooms_.back().get();
    const Pairs& pairs = pairs_;
    methods_.push_back({std::move(name), std::move(setting), std::move(unit), {}, [&pairs, room, answer] {
                          for (std::size_t i = 0; i < pairs.list.size(); ++i) (*room)[i] = answer(pairs.list[i]);
                        }});
  }
  const std::vector<Method>& methods() const { return methods_; }
  const std::vector<PairAnswer>& answers(std::size_t method) const { return *rooms_[method]; }
  const Pairs& pairs() const { return pairs_; }

 private:
  const Pairs& pairs_;
  std::vector<Method> methods_;
  std::vector<std::unique_ptr<std::vector<PairAnswer>>> rooms_;
};

/** The library's own exact times, and those of the peers that know this kind of pair. */
void add_dartsweep(PairMethods& methods);
void add_bullet(PairMethods& methods);
void add_fcl(PairMethods& methods);

}  // namespace dsw::curves

#endif
