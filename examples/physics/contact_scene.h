// Bodies of one scene whose points are one system, so that what touches shares momentum, whatever bodies it belongs to.
#ifndef DARTSWEEP_PHYSICS_CONTACT_SCENE_H
#define DARTSWEEP_PHYSICS_CONTACT_SCENE_H

#include <memory>

#include "contact_stability.h"
#include "springs.h"
#include "walls.h"

namespace physics {

class ContactWorld {
 public:
  explicit ContactWorld(const ContactCase& asked);
  ~ContactWorld();

  // One time step, verified. Adds to the row.
  void step(ContactRow* row);
  // Kinetic energy now, and all that gravity can still give.
  double kinetic() const;
  double put_in() const { return put_in_; }

 private:
  struct Part {
    dsw_body_id id;
    std::size_t first, count;
  };

  void add_line(const Positions& line, const std::vector<double>& masses, std::uint32_t flags);
  void start();
  void move(const Positions& targets, Outcome* outcome);
  void move_rigid(double dt, Outcome* outcome);
  void read();
  void read_all_touches();
  void add_partner(const dsw_contact_partner& partner, Touch* touch) const;
  void answer_rigid();
  void step_walls(double dt, ContactRow* row);
  void check_all(const Positions& before, ContactRow* row);
  std::size_t passed(const Positions& before) const;
  const Part* part_of(dsw_body_id id) const;

  ContactCase asked_;
  bool deforms_, two_, self_, together_, rigid_;
  double radius_, gravity_, put_in_ = 1, all_mass_ = 0;
  std::unique_ptr<Walls> walls_;  // goes after the environment, which reads its points there
  Environment environment_;
  Scene scene_;
  std::vector<Part> parts_;
  Points points_;
  Springs springs_;
  std::vector<Touch> touches_;
  Vector3 speed_ = Vector3::Zero(), spin_ = Vector3::Zero();  // of the rigid bar
};

}  // namespace physics

#endif
