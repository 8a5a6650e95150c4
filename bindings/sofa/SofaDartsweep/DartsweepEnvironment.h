// The volume mesh that bodies walk through.
#pragma once

#include <sofa/core/behavior/MechanicalState.h>
#include <sofa/core/objectmodel/BaseComponent.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>
#include <sofa/core/topology/BaseMeshTopology.h>
#include <sofa/defaulttype/VecTypes.h>

#include <memory>
#include <vector>

#include "SofaDartsweep/VolumeMesh.h"

namespace sofadartsweep {

class BaseBody;

/** An environment of the library, made of the volumes of a topology container. Each step ends here, at
 * AnimateEndEvent: the environment follows its mechanical state, bodies follow theirs as far as walls allow, and what
 * did not arrive is written back to the states. After that, mapped states follow. */
class DartsweepEnvironment : public sofa::core::objectmodel::BaseComponent {
 public:
  SOFA_CLASS(DartsweepEnvironment, sofa::core::objectmodel::BaseComponent);
  using State = sofa::core::behavior::MechanicalState<sofa::defaulttype::Vec3Types>;
  using Topology = sofa::core::topology::BaseMeshTopology;
  using Points = sofa::type::vector<sofa::type::Vec3>;
  using Indices = sofa::type::vector<sofa::Index>;
  template <class Target>
  using Link = sofa::core::objectmodel::SingleLink<DartsweepEnvironment, Target,
                                                   sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                                       sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>;

  Link<Topology> l_topology;
  Link<State> l_state;
  sofa::Data<Points> d_position;
  sofa::Data<Indices> d_tetrahedra, d_hexahedra, d_prisms, d_pyramids;
  sofa::Data<sofa::type::vector<Topology::Triangle>> d_triangles;
  sofa::Data<sofa::type::vector<Topology::Quad>> d_quads;
  sofa::Data<sofa::type::vector<unsigned>> d_tags;
  sofa::Data<unsigned> d_held, d_removed;
  sofa::Data<bool> d_bodyContacts;

  /** Adds a body, before the simulation is initialized. */
  void add(BaseBody* body);
  const std::vector<BaseBody*>& bodies() const { return m_bodies; }
  dsw_scene* scene() const { return m_scene; }
  const VolumeMesh& mesh() const { return m_mesh; }
  const Walls& walls() const { return m_walls; }
  /** Where the library's vertices are; empty before the simulation is initialized. */
  const std::vector<double>& points() const { return m_points[m_current]; }
  /** Grows when points or marks change. */
  unsigned version() const { return m_version; }
  /** The index in the state of a vertex of the library, or sofa::InvalidID if that point was removed. */
  sofa::Index point_of(std::uint32_t vertex) const { return m_point_of[vertex]; }
  /** The tetrahedron of the container that is a volume of the library, or sofa::InvalidID if it was removed. */
  sofa::Index tetrahedron_of(std::uint32_t volume) const;
  State* state() const { return l_state.get(); }
  dsw_context* context() const { return m_context; }

  void init() override;
  void reset() override;
  void handleEvent(sofa::core::objectmodel::Event* event) override;
  void handleTopologyChange(sofa::core::topology::Topology* topology) override;

 protected:
  DartsweepEnvironment();
  ~DartsweepEnvironment() override;

 private:
  void build();
  void clear();
  bool read_walls();
  bool read_points(std::vector<double>& points) const;
  void finish_step();
  bool follow_state();
  void hold_state();
  void open(std::vector<sofa::Index>& cells, const sofa::type::vector<sofa::Index>& removed);
  void forget_points(const sofa::type::vector<sofa::Index>& removed);

  std::vector<BaseBody*> m_bodies;
  dsw_context* m_context = nullptr;
  dsw_environment* m_environment = nullptr;
  dsw_scene* m_scene = nullptr;
  VolumeMesh m_mesh;
  Walls m_walls;
  std::vector<double> m_points[2];  ///< The library reads one, and follow_state writes the other.
  int m_current = 0;
  unsigned m_version = 0;
  bool m_built = false;
  std::vector<sofa::Index> m_tetrahedra, m_hexahedra;  ///< The cells of those that the container has now.
  std::vector<sofa::Index> m_point_of;
};

}  // namespace sofadartsweep
