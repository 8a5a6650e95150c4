#pragma once
// One vertex of a body on its way to a target, with the responses to what it meets [JCD10] 4.2.

#include "base/vec.h"
#include "body/body.h"
#include "environment/environment.h"
#include "response/settings.h"
#include "response/touched_walls.h"
#include "sweep/star.h"

namespace dsw {

template <int D>
class VertexMove {
 public:
  VertexMove(const Environment<D>& env, Body<D>& body, const MoveSettings& settings, StarSweep<D>& sweeps,
             MoveRecord& record)
      : env_(env), body_(body), settings_(settings), sweeps_(sweeps), record_(record) {}

  /** Moves vertex v, exactly free at the body's level; whether it got to the target. Contacts and edits go to the
   * record. The recorded cells and positions are valid whenever it throws std::bad_alloc.
   * @param arrival the cell of the target, if the way is known to meet no wall; else null. */
  bool move(uint32_t v, const double* target, const Cell* arrival = nullptr);

 private:
  /** Directions that the rest of a move must not go against. */
  struct Walls {
    Vec normals[2];
    int count = 0;
  };

  void put(uint32_t v, const double* position, Cell cell);
  bool leave(uint32_t v, const dsw_body_contact& contact);
  void find_exit(uint32_t v, const double* to, const TooNear<D>& first);
  bool advance(uint32_t v, const double* to, const Cell* arrival);
  void stop_before(uint32_t v, const double* to, const dsw_body_contact& contact);
  dsw_body_contact record_too_near(uint32_t v, const double* to, const TooNear<D>& first);
  bool advance_by_halving(uint32_t v, const double* to);
  dsw_body_contact describe_try(uint32_t v, const double* to, const double* met, WayEnd end, const Simplex& part,
                                dsw_contact_partner* partner);
  dsw_body_contact record_contacts(uint32_t v, const double* to, const SweepContact* first, const PairContact<D>& pair);
  double stand_off(const dsw_body_contact& contact) const;
  bool insert(uint32_t v, const dsw_body_contact& contact);
  bool may_split(uint32_t v, const dsw_body_contact& contact) const;
  /** A place for a vertex on the part of an edge between two shares of its length, counted from the moving end. */
  struct Part {
    uint32_t from, to;  // vertices
    double from_share, to_share;
  };
  uint32_t put_on(const Part& part, double length, const dsw_body_contact& contact, bool on_edge);
  bool slide(uint32_t v, const double* target, const dsw_body_contact& contact, Walls& walls, double* to) const;
  bool slide_before(uint32_t v, const double* target, const dsw_body_contact& contact, TouchedWalls<D>& walls,
                    double* to) const;
  void cut_off(uint32_t v, double* to) const;

  const Environment<D>& env_;
  Body<D>& body_;
  const MoveSettings& settings_;
  StarSweep<D>& sweeps_;
  MoveRecord& record_;
  size_t first_edit_ = 0;  // of this vertex
  double off_ = 0;         // kept from the wall that was touched last
  dsw_face_id exit_{};     // to which a thick vertex came last, or null
  Array<dsw_body_contact> under_{
      env_.memory};  // the touching edge, behind the first contact; if vertices are put there
};

}  // namespace dsw
