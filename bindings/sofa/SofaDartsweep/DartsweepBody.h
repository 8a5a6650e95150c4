// Bodies of mechanical states with points (Vec3) or frames (Rigid3).
#pragma once

#include <sofa/core/behavior/MechanicalState.h>
#include <sofa/defaulttype/RigidTypes.h>
#include <sofa/defaulttype/VecTypes.h>

#include <string>

#include "SofaDartsweep/BaseBody.h"

namespace sofadartsweep {

/** A wire or a surface: each point or frame of the state is a vertex. With `shape`, a rigid tool of the first frame. */
template <class DataTypes>
class DartsweepBody : public BaseBody {
 public:
  SOFA_CLASS(SOFA_TEMPLATE(DartsweepBody, DataTypes), BaseBody);
  using State = sofa::core::behavior::MechanicalState<DataTypes>;

  sofa::core::objectmodel::SingleLink<DartsweepBody<DataTypes>, State,
                                      sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                          sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>
      l_state;

  void init() override;
  void read_positions(sofa::core::ConstMultiVecCoordId from, std::vector<double>& to) override;
  void read_velocities(sofa::core::ConstMultiVecDerivId from, std::vector<double>& to) override;
  void add_line(sofa::core::MultiMatrixDerivId to, unsigned line, const Part& part, const Vec3& direction) override;
  void add_force(sofa::core::MultiVecDerivId to, const Part& part, const Vec3& force) override;

  /** The factory asks whether the state of the node has this type. */
  template <class Component>
  static bool canCreate(Component*& component, sofa::core::objectmodel::BaseContext* context,
                        sofa::core::objectmodel::BaseObjectDescription* description) {
    const char* state = description->getAttribute("state");
    if (!state && !dynamic_cast<State*>(context->getMechanicalState())) {
      description->logError("No mechanical state of type " + std::string(DataTypes::Name()) + " in the node.");
      return false;
    }
    return sofa::core::objectmodel::BaseComponent::canCreate(component, context, description);
  }

 protected:
  DartsweepBody();

  bool has_state() const override { return l_state.get() != nullptr; }
  std::size_t vertex_count() const override { return is_rigid() ? d_shape.getValue().size() : l_state->getSize(); }
  void write(const std::vector<double>& targets, double dt) override;
  dsw_rigid_motion motion_to_state() const override;
  void write_pose(const dsw_rigid_motion& left, double dt) override;
  void keep_pose() override;

 private:
  typename DataTypes::Coord m_pose;  ///< Where the proxy of a rigid tool is.
};

}  // namespace sofadartsweep
