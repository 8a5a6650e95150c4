#include "SofaDartsweep/DartsweepCarver.h"

#include <sofa/core/ObjectFactory.h>
#include <sofa/simulation/AnimateBeginEvent.h>

#include <algorithm>

namespace sofadartsweep {

DartsweepCarver::DartsweepCarver()
    : l_body(initLink("body", "DartsweepBody that carves")),
      l_modifier(initLink("modifier", "topology modifier of the environment's tetrahedra")),
      d_active(initData(&d_active, true, "active", "whether it carves now")),
      d_carved(initData(&d_carved, 0u, "carved", "OUTPUT: tetrahedra removed")) {
  d_carved.setReadOnly(true);
  f_listening.setValue(true);
}

void DartsweepCarver::init() {
  BaseComponent::init();
  if (!l_body || !l_modifier) msg_error() << "the links body and modifier are needed";
}

// At the beginning of a step, what the move of the step before has touched goes.
void DartsweepCarver::handleEvent(sofa::core::objectmodel::Event* event) {
  if (!sofa::simulation::AnimateBeginEvent::checkEventType(event)) return;
  if (!d_active.getValue() || !l_body || !l_modifier || !l_body->exists()) return;
  DartsweepEnvironment& environment = *l_body->l_environment;
  const dsw_body_contact* contacts = nullptr;
  std::size_t count = 0;
  if (!succeeded(*this, "contacts", dsw_body_get_contacts(environment.scene(), l_body->id(), &contacts, &count)))
    return;
  sofa::type::vector<sofa::Index> touched;
  for (std::size_t i = 0; i < count; ++i) {
    const dsw_volume_id behind = contacts[i].contact.behind;
    if (behind.generation == 0) continue;  // the outer boundary
    const sofa::Index tetrahedron = environment.tetrahedron_of(behind.index);
    if (tetrahedron != sofa::InvalidID) touched.push_back(tetrahedron);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  if (touched.empty()) return;
  d_carved.setValue(d_carved.getValue() + static_cast<unsigned>(touched.size()));
  l_modifier->removeItems(touched);
}

void register_carver(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(
      sofa::core::ObjectRegistrationData("Removes the impassable tetrahedra that a DartsweepBody touches.")
          .add<DartsweepCarver>());
}

}  // namespace sofadartsweep
