// A tool that removes what it touches.
#pragma once

#include <sofa/core/objectmodel/BaseComponent.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>
#include <sofa/core/topology/BaseTopology.h>

#include "SofaDartsweep/BaseBody.h"

namespace sofadartsweep {

/** Removes, by SOFA's topology modifier, the impassable tetrahedra that a body has touched in its move. */
class DartsweepCarver : public sofa::core::objectmodel::BaseComponent {
 public:
  SOFA_CLASS(DartsweepCarver, sofa::core::objectmodel::BaseComponent);
  template <class Target>
  using Link = sofa::core::objectmodel::SingleLink<DartsweepCarver, Target,
                                                   sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                                       sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>;

  Link<BaseBody> l_body;
  Link<sofa::core::topology::TopologyModifier> l_modifier;
  sofa::Data<bool> d_active;
  sofa::Data<unsigned> d_carved;

  void init() override;
  void handleEvent(sofa::core::objectmodel::Event* event) override;

 protected:
  DartsweepCarver();
};

}  // namespace sofadartsweep
