// What SOFA asks a plugin.
#include <sofa/config/sharedlibrary_defines.h>
#include <sofa/core/ObjectFactory.h>
#include <sofa/helper/system/PluginManager.h>

#include "dartsweep/base.h"

namespace sofadartsweep {

void register_environment(sofa::core::ObjectFactory* factory);
void register_body(sofa::core::ObjectFactory* factory);
void register_contacts(sofa::core::ObjectFactory* factory);
void register_check(sofa::core::ObjectFactory* factory);
void register_carver(sofa::core::ObjectFactory* factory);

extern "C" {
SOFA_EXPORT_DYNAMIC_LIBRARY void initExternalModule();
SOFA_EXPORT_DYNAMIC_LIBRARY const char* getModuleName();
SOFA_EXPORT_DYNAMIC_LIBRARY const char* getModuleVersion();
SOFA_EXPORT_DYNAMIC_LIBRARY const char* getModuleDescription();
SOFA_EXPORT_DYNAMIC_LIBRARY void registerObjects(sofa::core::ObjectFactory* factory);
}

void initExternalModule() {
  static bool first = true;
  if (first) sofa::helper::system::PluginManager::getInstance().registerPlugin("SofaDartsweep");
  first = false;
}

const char* getModuleName() { return "SofaDartsweep"; }
const char* getModuleVersion() { return DSW_SOFA_VERSION; }
const char* getModuleDescription() {
  return "Exact contacts of wires, surfaces and tools with volumes that bend and are cut.";
}

void registerObjects(sofa::core::ObjectFactory* factory) {
  register_environment(factory);
  register_body(factory);
  register_contacts(factory);
  register_check(factory);
  register_carver(factory);
}

}  // namespace sofadartsweep
