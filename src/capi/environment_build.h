#pragma once
// From a description to an environment handle, and what the build report says about it.

#include "capi/describe.h"
#include "capi/handle.h"

namespace dsw::capi {

/** Makes an environment; `report` may be null and is filled once the arguments were found sound. */
dsw_environment* build_environment(dsw_context* context, const dsw_environment_desc& desc, dsw_build_report* report);

/** All memory that an environment holds; borrowed points included. */
uint64_t memory_bytes(const dsw_environment& environment);

/** Proves everything again; throws at the first kind of defect. */
void check_environment(const dsw_environment& environment, dsw_build_report* report);

}  // namespace dsw::capi
