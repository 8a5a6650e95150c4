#pragma once
// A whole body moved: its vertices go to their targets one after the other.

#include "proximity/near_edges.h"
#include "proximity/partners.h"
#include "response/clear_parts.h"
#include "response/edge_pass.h"
#include "response/settings.h"
#include "response/turns.h"
#include "sweep/star.h"

namespace dsw {

/** Moves bodies; one for each thread. */
template <int D>
class BodyMove {
 public:
  explicit BodyMove(const Environment<D>& env)
      : env_(env),
        star_(env),
        course_(env.memory),
        casts_(env, star_.simplices, course_),
        edges_(env, star_.simplices, course_, casts_),
        faces_(env, star_.simplices, course_),
        near_(env.memory) {}
  BodyMove(const BodyMove&) = delete;
  BodyMove& operator=(const BodyMove&) = delete;

  /** Moves a body. Throws std::bad_alloc with the body as it was; the record is cleared first. */
  void move(Body<D>& body, PointArray targets, MoveOrder order, const MoveSettings& settings, MoveRecord& record);

  /** Begins a move in steps, in which all vertices go to one fraction of a motion after the other. The record is cleared. */
  void begin_steps(Body<D>& body, MoveRecord& record);
  /** Moves all vertices one after the other to where(user, from, fraction), with `from` where the steps began: a body that
   * keeps its shape, which is thick all the way. Or, if one of them meets something, none. Its contact goes to the record, if there is one. Throws std::bad_alloc with some moved. */
  bool step(Body<D>& body, PlaceFn where, const void* user, double fraction, MoveOrder order, MoveRecord* record);
  /** Ends a move in steps. */
  void end_steps(const Body<D>& body, double fraction, MoveRecord& record);
  /** Ends a move in steps where they began. */
  void undo_steps(Body<D>& body) noexcept;

  void set_counters(CastCounters* counters) { star_.simplices.counters = counters; }
  /** What a body can meet besides the environment; null: nothing. */
  void set_partners(const Partners<D>* partners) { star_.partners = partners; }
  /** How much more distance thick bodies keep than their radii; see ThickSweep. */
  void set_bend(double bend) { star_.thick.bend = bend; }
  /** What of the environment steps can meet where; null: not known. */
  void set_known(const KnownObstacles<D>* known) { known_ = known; }
  /** What is remembered of what is near the body; null: nothing. */
  void set_notes(NearNotes<D>* notes) { star_.thick.notes = notes; }

 private:
  void record_first(const Body<D>& body, uint32_t v, const double* to, MoveRecord& record);
  DSW_COLD void go_back(Body<D>& body, Array<Body<D>>& whole);
  void start(Body<D>& body, PointArray targets, MoveOrder order);
  bool run(const MoveSettings& settings, MoveRecord& record, bool may_skip);
  void sweep_all(bool may_skip, bool may_guess);
  bool arrives(uint32_t v);
  bool finish(const MoveSettings& settings, MoveRecord& record, bool may_skip);
  void go_on(const MoveSettings& settings, MoveRecord& record);
  bool leaves() const { return D == 3 && leaves_; }
  void disturb(uint32_t v);
  void look_ahead(bool slides);
  void find_asked(uint32_t v, bool may_know);
  void test_untested(uint32_t v, bool is_pass);
  void keep_untested();
  void remove_noise(Body<D>& body, double share, MoveRecord& record);

  const Environment<D>& env_;
  StarSweep<D> star_;
  Course<D> course_;
  CourseCasts<D> casts_;
  EdgePass<D> edges_;
  FacePass<D> faces_;
  NearEdges near_;
  const KnownObstacles<D>* known_ = nullptr;
  Array<uint16_t> beyond_{env_.memory};   // scratch of find_clear_parts
  Array<uint32_t> strays_{env_.memory};   // vertices that are not where their neighbours took them to be
  Turns<D> turns_{env_.memory};           // if there are further passes
  bool leaves_ = false;                   // back edges are left out that are not free where they arrive, in space
  Array<uint8_t> untested_{env_.memory};  // of the body before the move, if they are
  struct Left {
    uint32_t edge;
    uint8_t untested;
  };
  Array<uint8_t> tested_{env_.memory};  // by edge: tested when one of its ends moved alone
  Array<Left> left_{env_.memory};       // edges of a vertex that moves alone, whose other ends have their turns later
  Array<uint32_t> asked_{env_.memory};  // edges of a vertex that moves alone which are cast where they are
  Array<BodyVertex<D>> before_{env_.memory};  // to go back to
  Array<BodyVertex<D>> here_{env_.memory};    // where a step began
  Array<double> places_{env_.memory};         // of all vertices, in a step
};

}  // namespace dsw
