// The functions that fill a struct with defaults, so that a program sets only what it wants otherwise.

#include "capi/describe.h"
#include "topology/coarsen.h"

namespace {

// Defaults that are not 0.
template <class T>
void set_defaults(T&) noexcept {}
void set_defaults(dsw_environment_desc& d) noexcept {
  d.dimension = 3;
  d.index_bytes = 8;
  d.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
}
void set_defaults(dsw_volumes_desc& d) noexcept {
  d.index_bytes = 8;
  d.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
}
void set_defaults(dsw_body_desc& d) noexcept { d.level = DSW_LEVEL_EDGES_SWEPT; }
void set_defaults(dsw_detach_desc& d) noexcept { d.level = DSW_LEVEL_EDGES_SWEPT; }
void set_defaults(dsw_sweep_options& o) noexcept { o.level = DSW_LEVEL_EDGES_SWEPT; }
void set_defaults(dsw_coarsen_options& o) noexcept { o.max_faces = dsw::CoarsenOptions{}.max_facets; }

/** Defaults into at most `size` bytes. */
template <class T>
void init_struct(T* out, size_t size) noexcept {
  if (out == nullptr) return;
  T defaults{};
  set_defaults(defaults);
  defaults.struct_size = static_cast<uint32_t>(std::min<size_t>(size, UINT32_MAX));
  auto* const bytes = reinterpret_cast<unsigned char*>(out);
  std::memcpy(bytes, &defaults, std::min(size, sizeof(T)));
  if (size > sizeof(T) && size <= dsw::capi::kLargestStruct) std::memset(bytes + sizeof(T), 0, size - sizeof(T));
}

}  // namespace

#define DSW_INIT(type) \
  void type##_init(type* out, size_t size) { init_struct(out, size); }
DSW_INIT(dsw_context_desc)
DSW_INIT(dsw_environment_desc)
DSW_INIT(dsw_volumes_desc)
DSW_INIT(dsw_cast_options)
DSW_INIT(dsw_sweep_options)
DSW_INIT(dsw_scene_desc)
DSW_INIT(dsw_body_desc)
DSW_INIT(dsw_move_options)
DSW_INIT(dsw_near_options)
DSW_INIT(dsw_together_options)
DSW_INIT(dsw_scene_deform_options)
DSW_INIT(dsw_deform_options)
DSW_INIT(dsw_cut_desc)
DSW_INIT(dsw_carve_desc)
DSW_INIT(dsw_tie_desc)
DSW_INIT(dsw_open_crack_desc)
DSW_INIT(dsw_detach_desc)
DSW_INIT(dsw_remesh_desc)
DSW_INIT(dsw_coarsen_options)
DSW_INIT(dsw_recording_desc)
DSW_INIT(dsw_bug_report_desc)
#undef DSW_INIT
