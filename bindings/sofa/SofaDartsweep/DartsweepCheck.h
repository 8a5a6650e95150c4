// A judge of any collision pipeline.
#pragma once

#include <sofa/core/behavior/BaseMechanicalState.h>
#include <sofa/core/objectmodel/BaseComponent.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>

#include <vector>

#include "SofaDartsweep/DartsweepEnvironment.h"

namespace sofadartsweep {

/** Asks after each step whether a wire is free, by the library's exact test, in an environment of its own that it makes
 * from the volumes of a DartsweepEnvironment. It works for scenes of any collision pipeline, and changes nothing. */
class DartsweepCheck : public sofa::core::objectmodel::BaseComponent {
 public:
  SOFA_CLASS(DartsweepCheck, sofa::core::objectmodel::BaseComponent);
  using State = sofa::core::behavior::BaseMechanicalState;
  template <class Target>
  using Link = sofa::core::objectmodel::SingleLink<DartsweepCheck, Target,
                                                   sofa::core::objectmodel::BaseLink::FLAG_STOREPATH |
                                                       sofa::core::objectmodel::BaseLink::FLAG_STRONGLINK>;

  Link<DartsweepEnvironment> l_environment;
  Link<State> l_state;
  sofa::Data<double> d_touch;
  sofa::Data<unsigned> d_steps, d_notFree, d_touching;
  sofa::Data<double> d_deepest, d_length;

  void init() override;
  void reset() override;
  void handleEvent(sofa::core::objectmodel::Event* event) override;

 protected:
  DartsweepCheck();
  ~DartsweepCheck() override;

 private:
  void check();
  bool prepare();
  void clear();
  bool is_free();
  void measure_depth();
  void measure_touch();

  dsw_context* m_context = nullptr;
  dsw_environment* m_environment = nullptr;
  dsw_scene* m_scene = nullptr;
  unsigned m_version = 0;
  std::vector<double> m_points;
  std::vector<dsw_volume_id> m_volumes;  ///< Where the points were: hints.
};

}  // namespace sofadartsweep
