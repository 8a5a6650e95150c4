// Any bytes as an environment's description: sizes match the arrays, values are anything. Then its short life.

#include "use.h"

namespace {

using dsw_fuzz::Bytes;

constexpr uint8_t kTypes[] = {DSW_CELL_TYPE_HEXAHEDRON,
                              DSW_CELL_TYPE_TETRA,
                              DSW_CELL_TYPE_WEDGE,
                              DSW_CELL_TYPE_PYRAMID,
                              DSW_CELL_TYPE_POLYHEDRON,
                              0,
                              255};

constexpr uint8_t kPlaneTypes[] = {DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_TRIANGLE, DSW_CELL_TYPE_POLYGON,
                                   DSW_CELL_TYPE_TETRA, 0};

uint32_t points_of(uint8_t type, Bytes* bytes) {
  switch (type) {
    case DSW_CELL_TYPE_TRIANGLE:
      return 3;
    case DSW_CELL_TYPE_QUAD:
      return 4;
    case DSW_CELL_TYPE_POLYGON:
      return bytes->below(12);
    case DSW_CELL_TYPE_HEXAHEDRON:
      return 8;
    case DSW_CELL_TYPE_TETRA:
      return 4;
    case DSW_CELL_TYPE_WEDGE:
      return 6;
    case DSW_CELL_TYPE_PYRAMID:
      return 5;
    default:
      return 0;
  }
}

struct Mesh {
  std::vector<double> points;
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets, connectivity, faces, face_locations;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;
};

void read_stream(Bytes* bytes, std::vector<int64_t>* stream) {
  const uint32_t face_count = bytes->below(12);
  stream->push_back(face_count);
  for (uint32_t f = 0; f < face_count; ++f) {
    const uint32_t corners = bytes->below(8);
    stream->push_back(corners);
    for (uint32_t i = 0; i < corners; ++i) stream->push_back(bytes->byte());
  }
}

Mesh read_mesh(Bytes* bytes, bool faces_apart, bool is_planar) {
  Mesh mesh;
  const uint32_t point_count = bytes->below(48), cell_count = bytes->below(12);
  mesh.points.resize(3 * size_t{point_count});
  for (double& coordinate : mesh.points) coordinate = bytes->number();
  mesh.offsets.push_back(0);
  for (uint32_t c = 0; c < cell_count; ++c) {
    const uint8_t type =
        is_planar ? kPlaneTypes[bytes->below(sizeof kPlaneTypes)] : kTypes[bytes->below(sizeof kTypes)];
    mesh.types.push_back(type);
    mesh.face_locations.push_back(static_cast<int64_t>(mesh.faces.size()));
    if (type == DSW_CELL_TYPE_POLYHEDRON) {
      read_stream(bytes, faces_apart ? &mesh.faces : &mesh.connectivity);
    } else {
      for (uint32_t n = points_of(type, bytes); n > 0; --n) mesh.connectivity.push_back(bytes->byte());
    }
    mesh.offsets.push_back(static_cast<int64_t>(mesh.connectivity.size()));
    mesh.regions.push_back(static_cast<int32_t>(bytes->below(3)));
    mesh.tags.push_back(bytes->byte());
  }
  return mesh;
}

/** Overwrites single integers with anything: what a damaged file or a wrong cast in the host looks like. */
void damage(std::vector<int64_t>* values, Bytes* bytes) {
  for (uint32_t n = bytes->below(3); n > 0 && !values->empty(); --n) {
    (*values)[bytes->byte() % values->size()] = bytes->below(2) != 0 ? bytes->raw_integer() : int64_t{bytes->byte()};
  }
}

std::vector<int32_t> narrow(const std::vector<int64_t>& wide) {
  std::vector<int32_t> narrow;
  for (const int64_t value : wide) narrow.push_back(static_cast<int32_t>(value));
  return narrow;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  const uint8_t layout = bytes.byte();
  const bool uniform = (layout & 1) != 0, faces_apart = (layout & 2) != 0, is_narrow = (layout & 4) != 0;
  const bool no_offsets = (layout & 8) != 0, labelled = (layout & 16) != 0, damaged = (layout & 32) != 0;
  const bool is_planar = (layout & 64) != 0;
  uint32_t flags = bytes.byte();
  flags |= (layout & 128u) << 1;        // DSW_ENVIRONMENT_SPLIT
  if (flags == 0xffu) flags |= 0x200u;  // a flag that there is not

  Mesh mesh = read_mesh(&bytes, faces_apart, is_planar);
  if (damaged) {
    for (auto* values : {&mesh.offsets, &mesh.connectivity, &mesh.faces, &mesh.face_locations}) damage(values, &bytes);
  }
  const std::vector<int32_t> offsets = narrow(mesh.offsets), connectivity = narrow(mesh.connectivity);
  const std::vector<int32_t> faces = narrow(mesh.faces), face_locations = narrow(mesh.face_locations);
  const auto pick = [&](const std::vector<int32_t>& small, const std::vector<int64_t>& wide) {
    return is_narrow ? static_cast<const void*>(small.data()) : static_cast<const void*>(wide.data());
  };

  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.index_bytes = is_narrow ? 4 : 8;
  if (is_planar) {
    desc.dimension = 2;
    desc.point_stride_bytes = 3 * sizeof(double);
  }
  desc.points = mesh.points.data();
  desc.point_count = mesh.points.size() / 3;
  desc.volume_count = mesh.types.size();
  desc.cell_types = uniform ? nullptr : mesh.types.data();
  desc.uniform_cell_type = uniform && !mesh.types.empty() ? mesh.types[0] : 0;
  desc.offsets = uniform && no_offsets ? nullptr : pick(offsets, mesh.offsets);
  desc.connectivity = pick(connectivity, mesh.connectivity);
  desc.connectivity_count = mesh.connectivity.size();
  if (faces_apart) {
    desc.faces = pick(faces, mesh.faces);
    desc.faces_count = mesh.faces.size();
    desc.face_locations = pick(face_locations, mesh.face_locations);
  }
  if ((flags & (DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_CONFORM)) != 0) desc.merge_distance = bytes.number();
  if (labelled) {
    desc.regions = mesh.regions.data();
    desc.tags = mesh.tags.data();
  }

  dsw_environment* environment = nullptr;
  dsw_build_report report = {};
  report.struct_size = sizeof report;
  const dsw_status status = dsw_environment_create(nullptr, &desc, &environment, &report);
  dsw_fuzz::require(status != DSW_STATUS_INTERNAL, "creation has no internal error");
  dsw_fuzz::require((status == DSW_STATUS_OK) == (environment != nullptr), "an environment exactly under OK");
  if (status != DSW_STATUS_OK) return 0;

  const dsw_status check = dsw_environment_check(environment, nullptr);
  dsw_fuzz::require(check == DSW_STATUS_OK || check == DSW_STATUS_BOUNDARY_CROSSES, "what was created is sound");
  dsw_fuzz::require(check == DSW_STATUS_OK || (flags & DSW_ENVIRONMENT_CHECK_BOUNDARY) == 0, "the two checks agree");
  dsw_fuzz::use_environment(environment, check == DSW_STATUS_OK, &bytes);
  dsw_fuzz::require(dsw_environment_destroy(environment) == DSW_STATUS_OK, "the environment goes");
  return 0;
}
