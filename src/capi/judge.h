#pragma once
// The exact verdict on a call that is made again: what it says of ways and contacts, held against all obstacles. See src/verdict/README.md.

#include "capi/replay.h"
#include "verdict/verdict.h"

namespace dsw::capi {

template <int D>
class CallJudge {
 public:
  explicit CallJudge(const Scene<D>& scene);

  /** Before the call: where what it moves is. */
  void remember(dsw_replay& replay, const NextCall& next);
  /** After it. `was_done`: it did not fail. */
  dsw_verdict judge(bool was_done);

 private:
  /** What a claim is about, and what was said of it. */
  enum class Said { kEdgeIsFree, kFaceIsFree, kWayIsFree, kContactAt };
  struct Subject {
    Said said;
    uint32_t owner, part;  // slots: of the body, and in it; of a particle
    double time;           // of a contact
  };
  /** A body, or a particle, before it moves. */
  struct Mover {
    uint32_t slot;
    bool is_exact;  // contacts are searched for exactly
    size_t first;   // of its points in before_
    size_t order_first, order_count;
  };

  void remember_body(dsw_body_id body, const dsw_move_options& options);
  void remember_particle(dsw_particle_id particle, const double* target, const dsw_cast_options& options);
  void look_at_places();
  void look_at_body(uint32_t slot);
  void claim_flight(const Mover& mover);
  void claim_move(const Mover& mover);
  void claim_way(const Mover& mover, const Body<D>& body, uint32_t vertex);
  void claim_contact(const Mover& mover, const dsw_contact& contact);
  uint32_t add_subject(Said said, uint32_t owner, uint32_t part, double time = 0);
  void count_wrong(const Subject& subject);
  void note(const char* format, uint32_t one, uint32_t other);

  const Scene<D>& scene_;
  Array<double> before_;    // points
  Array<uint32_t> orders_;  // ranks of vertices
  Array<Mover> particles_, bodies_;
  Array<Subject> subjects_;
  Judge<D> judge_;
  dsw_verdict verdict_{};
};

}  // namespace dsw::capi
