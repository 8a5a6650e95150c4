// A body of Dartsweep, whatever the type of its mechanical state is.
#pragma once

#include <sofa/core/MultiVecId.h>
#include <sofa/core/objectmodel/BaseComponent.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>
#include <sofa/core/topology/BaseMeshTopology.h>

#include <array>
#include <vector>

#include "SofaDartsweep/DartsweepEnvironment.h"

namespace sofadartsweep {

/** A part of a body: up to three vertices with weights. */
struct Part {
  const std::uint32_t* vertices;
  const double* weights;
  /** Calls `with(vertex, weight)` for each. */
  template <class With>
  void each(With with) const {
    for (int i = 0; i < 3; ++i)
      if (vertices[i] != UINT32_MAX && weights[i] != 0) with(vertices[i], weights[i]);
  }
};

/** The proxy of a mechanical state. It is free after each step, and the state is where it is. */
class BaseBody : public sofa::core::objectmodel::BaseComponent {
 public:
  SOFA_ABSTRACT_CLASS(BaseBody, sofa::core::objectmodel::BaseComponent);
  using Vec3 = sofa::type::Vec3;
  using Topology = sofa::core::topology::BaseMeshTopology;
  template <class Target>
  using Link = sofa::core::objectmodel::SingleLink<BaseBody, Target,
                                                   sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                                       sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>;

  Link<DartsweepEnvironment> l_environment;
  Link<Topology> l_topology;
  sofa::Data<sofa::type::vector<Topology::Edge>> d_edges;
  sofa::Data<sofa::type::vector<Topology::Triangle>> d_triangles;
  sofa::Data<sofa::type::vector<Vec3>> d_shape;
  sofa::Data<double> d_radius;
  sofa::Data<bool> d_selfContacts, d_slide;
  sofa::Data<unsigned> d_passes;
  sofa::Data<unsigned> d_stopped, d_stops, d_notFree;
  sofa::Data<sofa::type::vector<Vec3>> d_position;

  /** Makes the proxy where the state is. In a scene with `contacts` of bodies, it meets others or only itself. */
  bool make(dsw_scene* scene, bool contacts, bool meets_others);
  /** The scene is gone. */
  void forget();
  /** Remembers where the proxy is. */
  void begin_move() { m_before = m_positions; }
  /** Moves the proxy towards the state, and the state to the proxy. Returns whether the state was written. */
  bool move(double dt);

  bool exists() const { return m_scene != nullptr; }
  dsw_body_id id() const { return m_body; }
  /** Where the vertices of the proxy are. */
  const std::vector<double>& positions() const { return m_positions; }
  /** Forces of the near rows of the step before, for a warm start. */
  std::vector<std::array<double, 3>>& forces() { return m_forces; }

  /** Where the vertices would be with these positions of the state. */
  virtual void read_positions(sofa::core::ConstMultiVecCoordId from, std::vector<double>& to) = 0;
  /** How fast the vertices would be. */
  virtual void read_velocities(sofa::core::ConstMultiVecDerivId from, std::vector<double>& to) = 0;
  /** Adds the derivative of the way of `part` in a direction to a line of the constraint matrix. */
  virtual void add_line(sofa::core::MultiMatrixDerivId to, unsigned line, const Part& part, const Vec3& direction) = 0;
  /** Adds a force at `part`. */
  virtual void add_force(sofa::core::MultiVecDerivId to, const Part& part, const Vec3& force) = 0;

  void init() override;

 protected:
  BaseBody();

  bool is_rigid() const { return d_shape.isSet(); }
  virtual bool has_state() const = 0;
  virtual std::size_t vertex_count() const = 0;
  /** Takes the vertices that are not at `targets` from the proxy, with the velocities of their way. */
  virtual void write(const std::vector<double>& targets, double dt) = 0;
  /** The motion that takes the proxy of a rigid tool to its state; what is left of it gives the pose back. */
  virtual dsw_rigid_motion motion_to_state() const = 0;
  virtual void write_pose(const dsw_rigid_motion& left, double dt) = 0;
  virtual void keep_pose() = 0;

  std::vector<double> m_positions, m_before, m_targets;

 private:
  bool move_rigid(double dt);
  bool read_proxy();
  void read_parts(std::vector<std::uint32_t>& edges, std::vector<std::uint32_t>& corners);
  void show_offenders() const;
  void publish();

  dsw_scene* m_scene = nullptr;
  dsw_body_id m_body = {};
  std::vector<std::array<double, 3>> m_forces;
};

}  // namespace sofadartsweep
