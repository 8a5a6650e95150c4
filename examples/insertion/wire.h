// What is inserted, whatever its physics is: the springs of physics/catheter.h or the rod of bindings/rod.
#ifndef DARTSWEEP_INSERTION_WIRE_H
#define DARTSWEEP_INSERTION_WIRE_H

#include <memory>

#include "options.h"
#include "rod/rod_catheter.h"

namespace insertion {

class Wire {
 public:
  virtual ~Wire() = default;
  virtual void step(double dt) = 0;
  virtual dsw_body_id id() const = 0;
  virtual const physics::StepReport& report() const = 0;
  // What the rod did in the last step, if the physics is a rod: seconds for finding rows and for the rod itself, rows,
  // and rows that press.
  struct RodPart {
    double rows_seconds = 0, rod_seconds = 0;
    std::size_t rows = 0, pressing = 0;
  };
  virtual RodPart rod_part() const { return {}; }
  virtual double reached() const = 0;     // how far along the route the tip is
  virtual std::size_t links() const = 0;  // that are in
  virtual double largest_stretch() const = 0;
  virtual std::vector<std::size_t> line() const = 0;        // vertices in order, the tail first
  virtual const physics::Positions& positions() const = 0;  // by vertex
  virtual bool was_inserted(std::size_t vertex) const = 0;  // by a response
  // What each contact of the last move did, by its number.
  virtual std::vector<double> impulses(std::size_t contacts) const = 0;
};

// `world` and `route` have to outlive the wire. Throws LibraryError.
std::unique_ptr<Wire> make_wire(const Options& options, const physics::CatheterOptions& made_of, physics::World* world,
                                const physics::Route* route);

}  // namespace insertion

#endif
