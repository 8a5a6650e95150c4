// A thin elastic rod that stretches, bends and twists, with contacts: one implicit time step, solved directly along
// the chain.
//
// A step has a fixed cost, O(vertices + rows * sweeps). Forces are those of implicit Euler, linearised once or twice.
// The stiffness matrix is the second derivative of the energy without what could make it indefinite: of a bend the
// Gauss-Newton part, of a stretched edge all but the part of pressure.
#ifndef DARTSWEEP_ROD_ROD_H
#define DARTSWEEP_ROD_ROD_H

#include "rod_contacts.h"
#include "rod_shape.h"

namespace physics {

// An edge at rest, with units that fit each other, such as mm, s, mg and uN.
struct RodEdge {
  double length = 1;
  double mass = 1;          // shared by its two vertices when it is added; later only for the turn about the edge
  double stretching = 1e9;  // force: Young's modulus times area
  double bending = 1e7;     // force times area
  double twisting = 8e6;    // force times area
  double radius = 0.15;     // only for the inertia of a turn about the edge; the gaps of rows know their own
};

struct RodOptions {
  double drag = 0;         // of the velocity, 1/s
  double damping = 0;      // s: forces act on the shape that the rod has so much later
  int linearisations = 1;  // in a step: 1 or 2
  RodContactOptions contact;
};

class Rod {
 public:
  // A straight or curved line without tension: bent edges pull until `rest_curvature` is set.
  Rod(const Positions& line, const std::vector<RodEdge>& edges);

  // Adds a vertex behind the last one.
  void add_vertex(const Vector3& at, const RodEdge& edge);

  // Velocities of the next time step, and with them `targets`. Rows refer to where the rod is now.
  RodContactReport step(double dt, const NearRows& rows);
  // What `step` does, in parts, with one linearisation: the velocities without contacts; the contacts, which are
  // solved by someone else; the velocities with the impulses that are known then.
  const BlockVector& predict(double dt);
  const BlockVector& predicted() const { return guess_; }
  RodContacts& contacts() { return contacts_; }
  const ChainMatrix& matrix() const { return matrix_; }
  const ChainFactor& factor() const { return factor_; }
  void finish(double dt, const BlockVector& impulses);
  // Where the vertices want to be at the end of the step.
  const Positions& targets() const { return targets_; }
  // The rod is at `actual`, which may be short of the targets. A vertex that was stopped is as fast as the way that
  // it made, and never faster than it was.
  void accept(const Positions& actual, double dt);

  // Ends all motion.
  void rest();

  double elastic_energy() const;
  double kinetic_energy() const;
  // Minus the gradient of the elastic energy, by vertex; the last entry of a block is the torque about the edge
  // behind the vertex.
  BlockVector forces() const;
  // The matrix that steps use for the second derivative of the energy.
  ChainMatrix stiffness() const;
  // The largest | length / rest - 1 |.
  double largest_stretch() const;
  // Force along an edge; negative where it is pressed.
  double tension(std::size_t edge) const;
  std::size_t size() const { return shape.position.size(); }
  const RodContacts& contacts() const { return contacts_; }

  RodShape shape;
  Positions velocity;                   // by vertex
  std::vector<double> mass;             // by vertex
  std::vector<double> spin;             // by edge: how fast it turns about itself
  std::vector<RodEdge> edges;           // at rest
  std::vector<Vector2> rest_curvature;  // by vertex, as RodBend
  std::vector<double> rest_twist;       // by vertex
  Positions load;                       // by vertex: forces from outside
  std::vector<char> held, held_turn;    // by vertex, by edge: it moves as its velocity says, whatever the forces are
  RodOptions options;

 private:
  double inertia_of(std::size_t edge) const;
  double half_length_at(std::size_t vertex) const;
  // Adds forces to `force`, and `scale` times the stiffness to `matrix`.
  void add_elasticity(const RodShape& at, double scale, BlockVector* force, ChainMatrix* matrix) const;
  void prescribe(const BlockVector& now, BlockVector* right_side);
  BlockVector velocities() const;
  void linearise(const RodShape& trial, double dt, const BlockVector* guess);
  void take(const BlockVector& velocities, double dt);

  Positions targets_;
  BlockVector right_side_, guess_;
  ChainMatrix matrix_;
  ChainFactor factor_;
  RodContacts contacts_;
};

}  // namespace physics

#endif
