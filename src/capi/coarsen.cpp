#include "dartsweep/coarsen.h"

#include "capi/convert.h"
#include "topology/coarsen.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::CoarsenOptions to_options(const dsw_coarsen_options* given) {
  dsw::CoarsenOptions options;
  if (given == nullptr) return options;
  const dsw_coarsen_options read = capi::read_struct(given, "options");
  if (read.max_faces != 0) {
    if (read.max_faces < 4 || read.max_faces > dsw::kMostFacets) {
      fail(DSW_STATUS_OUT_OF_RANGE, "options->max_faces is %u, must be 0 or 4 .. %u", read.max_faces, dsw::kMostFacets);
    }
    options.max_facets = read.max_faces;
  }
  options.max_trials = read.max_trials;
  return options;
}

dsw_coarsen_report to_report(const dsw_environment& source, const dsw_environment& target,
                             const dsw::CoarsenReport& found) {
  dsw_coarsen_report report{};
  report.complete = found.complete ? 1 : 0;
  report.trials = found.trials;
  report.passable_area[0] = found.area_before;
  report.passable_area[1] = found.area_after;
  const dsw_environment* const both[2] = {&source, &target};
  for (int i = 0; i < 2; ++i) {
    report.volume_count[i] = capi::space(*both[i]).map.cell_count;
    report.face_count[i] = capi::space(*both[i]).map.facet_count;
    report.memory_bytes[i] = capi::memory_bytes(*both[i]);
  }
  return report;
}

}  // namespace

dsw_status dsw_environment_coarsen(const dsw_environment* source, const dsw_coarsen_options* options,
                                   dsw_environment** environment, uint32_t* volume_map, size_t capacity,
                                   dsw_coarsen_report* report) {
  return capi::guard(__func__, [&] {
    const dsw_environment& handle = capi::check_handle(source, "source");
    const dsw::Environment<3>& from = capi::space(handle);
    dsw::require(environment, "environment");
    const dsw::CoarsenOptions chosen = to_options(options);
    if (report != nullptr) capi::check_size(report, "report");
    if (volume_map != nullptr && capacity < from.map.index_count()) {
      fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity is %zu, must be at least %u", capacity, from.map.index_count());
    }
    if (from.checked.active()) fail(DSW_STATUS_UNSUPPORTED, "the points of source have moved, or may move");
    capi::EnvironmentOwner owner = capi::make_environment(handle.context, 3);
    dsw::Array<uint32_t> new_index(from.memory);
    dsw::CoarsenReport found;
    coarsen(from, chosen, capi::space(*owner), new_index, found);
    capi::choose_kernels(*owner);
    *environment = owner.release();
    if (volume_map != nullptr) std::copy(new_index.begin(), new_index.end(), volume_map);
    if (report != nullptr) capi::write_struct(report, to_report(handle, **environment, found));
  });
}
