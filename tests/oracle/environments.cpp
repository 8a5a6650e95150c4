#include "environments.h"

#include <cstdio>
#include <cstring>

namespace dsw::oracle {

EnvironmentPtr create_environment(const Mesh& mesh, const Layout& layout, uint32_t flags, dsw_context* context) {
  DescArrays arrays(mesh, layout);
  arrays.desc.flags |= flags;
  dsw_build_report report;
  std::memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  dsw_environment* environment = nullptr;
  const dsw_status status = dsw_environment_create(context, &arrays.desc, &environment, &report);
  if (status != DSW_STATUS_OK) {
    std::fprintf(stderr, "create: %s: %s; first offender %u of %u\n", dsw_status_string(status),
                 dsw_last_error_message(), report.offenders[0], report.offender_count);
    return nullptr;
  }
  return EnvironmentPtr(environment);
}

}  // namespace dsw::oracle
