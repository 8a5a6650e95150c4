// Writes the seeds of all targets: sound meshes of every cell type as fuzz_create reads them, snapshots of the same
// meshes with marks, also changed and with points that move, the snapshot of a scene, and programs of calls. Made new
// in every build, so that they follow the formats. usage: make_seeds FOLDER   (writes FOLDER/create, FOLDER/snapshot,
// FOLDER/scene, FOLDER/calls and FOLDER/replay)

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "use.h"

namespace {

// These enums are those of fuzz_create.
enum Type : uint8_t { kHexahedron = 0, kTetra = 1, kWedge = 2, kPyramid = 3, kPolyhedron = 4 };
enum PlaneType : uint8_t { kQuad = 0, kTriangle = 1, kPolygon = 2 };
enum Layout : uint8_t {
  kUniform = 1,
  kFacesApart = 2,
  kNarrow = 4,
  kNoOffsets = 8,
  kLabelled = 16,
  kDamaged = 32,
  kPlanar = 64,
  kSplit = 128
};
constexpr uint8_t kSewn =
    DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING;

struct Cell {
  uint8_t type;  // a Type, or a PlaneType
  std::vector<uint8_t> stream;
};

struct Mesh {
  std::vector<std::array<uint8_t, 3>> points;  // quarters of a unit
  std::vector<Cell> cells;
  bool is_planar = false;
};

constexpr dsw_cell_type kVtkType[] = {DSW_CELL_TYPE_HEXAHEDRON, DSW_CELL_TYPE_TETRA, DSW_CELL_TYPE_WEDGE,
                                      DSW_CELL_TYPE_PYRAMID, DSW_CELL_TYPE_POLYHEDRON};
constexpr dsw_cell_type kVtkPlaneType[] = {DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_TRIANGLE, DSW_CELL_TYPE_POLYGON};

/** A row of two boxes of unit size, x fastest: the lattice every mesh below is cut from. */
std::vector<std::array<uint8_t, 3>> lattice() {
  std::vector<std::array<uint8_t, 3>> points;
  for (uint8_t z = 0; z < 2; ++z) {
    for (uint8_t y = 0; y < 2; ++y) {
      for (uint8_t x = 0; x < 3; ++x) points.push_back({uint8_t(4 * x), uint8_t(4 * y), uint8_t(4 * z)});
    }
  }
  return points;
}

/** Corners of box 0 or 1 in VTK's order. */
std::array<uint8_t, 8> box(uint8_t i) {
  std::array<uint8_t, 8> corners = {0, 1, 4, 3, 6, 7, 10, 9};
  for (uint8_t& corner : corners) corner = uint8_t(corner + i);
  return corners;
}

constexpr uint8_t kBoxFaces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                     {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

Cell hexahedron(uint8_t i) {
  const auto c = box(i);
  return {kHexahedron, {c.begin(), c.end()}};
}

Cell polyhedron(uint8_t i) {
  const auto c = box(i);
  Cell cell = {kPolyhedron, {6}};
  for (const auto& face : kBoxFaces) {
    cell.stream.push_back(4);
    for (const uint8_t corner : face) cell.stream.push_back(c[corner]);
  }
  return cell;
}

Mesh two_hexahedra() { return {lattice(), {hexahedron(0), hexahedron(1)}}; }
Mesh two_polyhedra() { return {lattice(), {polyhedron(0), polyhedron(1)}}; }
Mesh warped_hexahedra() {
  Mesh mesh = two_hexahedra();
  mesh.points[7] = {5, 1, 5};
  return mesh;
}

Mesh six_pyramids() {
  Mesh mesh = {lattice(), {}};
  const auto c = box(0);
  mesh.points.push_back({2, 2, 2});
  for (const auto& face : kBoxFaces) {
    // A base is counter-clockwise seen from the apex, a box's face seen from outside.
    mesh.cells.push_back({kPyramid, {c[face[3]], c[face[2]], c[face[1]], c[face[0]], 12}});
  }
  return mesh;
}

/** One box cut into two prisms, its neighbour a hexahedron, a tetrahedron on the far side. */
Mesh mixed() {
  Mesh mesh = {lattice(), {}};
  mesh.points.push_back({12, 0, 0});
  mesh.cells.push_back({kWedge, {0, 3, 1, 6, 9, 7}});
  mesh.cells.push_back({kWedge, {1, 3, 4, 7, 9, 10}});
  mesh.cells.push_back(hexahedron(1));
  return mesh;
}

Mesh tetrahedra() {
  Mesh mesh = {lattice(), {}};
  const auto c = box(0);
  // Kuhn's six tetrahedra round the diagonal 0-6.
  const uint8_t steps[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
  for (const auto& step : steps) mesh.cells.push_back({kTetra, {c[0], c[step[0]], c[step[1]], c[6]}});
  return mesh;
}

/** A quad, two triangles beside it and a polygon over them that is not convex. */
Mesh plane() {
  Mesh mesh = {lattice(), {}, true};
  mesh.points.push_back({1, 9, 0});
  mesh.points.push_back({4, 7, 0});
  mesh.points.push_back({8, 9, 0});
  mesh.cells = {
      {kQuad, {0, 1, 4, 3}}, {kTriangle, {1, 2, 4}}, {kTriangle, {2, 5, 4}}, {kPolygon, {3, 4, 5, 14, 13, 12}}};
  return mesh;
}

std::vector<uint8_t> encode(const Mesh& mesh, uint8_t layout, uint8_t flags) {
  std::vector<uint8_t> seed = {layout, flags, uint8_t(mesh.points.size()), uint8_t(mesh.cells.size())};
  for (const auto& point : mesh.points) seed.insert(seed.end(), point.begin(), point.end());
  uint8_t region = 0;
  for (const Cell& cell : mesh.cells) {
    seed.push_back(cell.type);
    if (mesh.is_planar && cell.type == kPolygon) seed.push_back(uint8_t(cell.stream.size()));
    seed.insert(seed.end(), cell.stream.begin(), cell.stream.end());
    seed.push_back(region++ % 2);
    seed.push_back(7);
  }
  // What use_environment does next: marked edges and sweeps; then casts, locates, particles, marks, in this order,
  // twice.
  const uint8_t edges[] = {0,    0, 1, 3, 4,    0, 0, 1, 3,    5, 0, 0, 1,    3, 6, 0, 0,    1, 3,  7,
                           0xc0, 0, 0, 1, 1,    1, 3, 2, 3,    3, 3, 2, 0xc1, 0, 0, 1, 1,    2, 40, 3,
                           2,    2, 3, 3, 0xc2, 1, 3, 1, 2,    3, 7, 2, 3,    3, 3, 1, 0xc3, 0, 0,  1,
                           2,    3, 3, 2, 3,    2, 1, 1, 0xff, 0, 0, 3, 1,    1, 1, 1, 3,    2, 3,  2};
  const uint8_t life[] = {2, 1, 1, 1, 7, 2, 3, 0, 2, 1, 1, 1, 0, 0x7f, 0, 3, 0, 1, 2, 2, 2, 1, 9, 3, 1, 1,
                          1, 0, 9, 9, 9, 0, 2, 2, 3, 0, 4, 2, 1, 0,    0, 1, 5, 1, 0, 0, 1, 2, 0, 1, 1};
  // A tetrahedron at FACES and a polyline, each moved, edited, turned and moved; in the mesh's first unit box.
  const uint8_t bodies[] = {0xa0, 3, 0, 4, 1,    1, 1, 3, 1, 1, 1, 3,  1, 1, 1, 3, 0, 0,    2, 1, 0,    0, 1,
                            3,    0, 1, 2, 3,    0, 2, 0, 3, 7, 3, 2,  1, 2, 1, 1, 1, 4,    1, 1, 1,    1, 2,
                            3,    1, 1, 4, 3,    1, 0, 1, 0, 1, 2, 0,  6, 4, 0, 0, 0, 1,    1, 2, 2,    2, 1,
                            0,    0, 2, 1, 6,    1, 1, 1, 2, 2, 2, 1,  3, 3, 1, 1, 3, 0xa1, 2, 2, 0,    1, 1,
                            1,    2, 1, 2, 3,    3, 1, 0, 1, 1, 2, 15, 2, 2, 1, 6, 1, 1,    1, 6, 2,    2, 1,
                            6,    3, 3, 2, 0x10, 0, 2, 1, 1, 1, 1, 1,  1, 1, 1, 1, 1, 2,    2, 4, 0x81, 3};
  seed.insert(seed.end(), std::begin(bodies), std::end(bodies));
  seed.insert(seed.end(), std::begin(edges), std::end(edges));
  for (int round = 0; round < 2; ++round) seed.insert(seed.end(), std::begin(life), std::end(life));
  return seed;
}

/** Leaves free records, generations and points that move behind, as far as the cells can change. */
void change(dsw_environment* environment) {
  const size_t volumes = dsw_fuzz::info_of(environment).volume_count;
  const dsw_volume_id last = {static_cast<uint32_t>(volumes - 1), 1};
  for (uint32_t local = 0; local < 6; ++local) {
    dsw_edge_id halves[2];
    dsw_vertex_id middle;
    dsw_environment_unsew_face(environment, {0, 1, local});
    dsw_environment_split_edge(environment, {0, 1, local}, 0.5, &middle, halves);
  }
  if (volumes > 2) dsw_environment_remove_volumes(environment, &last, 1);
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = volumes % 2 == 0 ? uint32_t{DSW_FEATURE_DEFORMING} : 0;
  dsw_scene* scene = nullptr;
  dsw_fuzz::require(dsw_scene_create(environment, &desc, &scene) == DSW_STATUS_OK, "a scene of a seed");
  dsw_scene_destroy(scene);
}

std::vector<uint8_t> snapshot(const Mesh& mesh, uint32_t flags, bool marked, bool changed) {
  std::vector<double> points;
  for (const auto& point : mesh.points) {
    for (const uint8_t quarter : point) points.push_back(quarter / 4.0);
  }
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets = {0}, connectivity;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;
  for (const Cell& cell : mesh.cells) {
    types.push_back(static_cast<uint8_t>(mesh.is_planar ? kVtkPlaneType[cell.type] : kVtkType[cell.type]));
    connectivity.insert(connectivity.end(), cell.stream.begin(), cell.stream.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
    regions.push_back(static_cast<int32_t>(regions.size() % 2));
    tags.push_back(static_cast<uint32_t>(100 + tags.size()));
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  if (mesh.is_planar) {
    desc.dimension = 2;
    desc.point_stride_bytes = 3 * sizeof(double);
  }
  desc.points = points.data();
  desc.point_count = mesh.points.size();
  desc.cell_types = types.data();
  desc.volume_count = types.size();
  desc.offsets = offsets.data();
  desc.connectivity = connectivity.data();
  desc.connectivity_count = connectivity.size();
  if (marked) {
    desc.regions = regions.data();
    desc.tags = tags.data();
  }
  dsw_environment* environment = nullptr;
  if (dsw_environment_create(nullptr, &desc, &environment, nullptr) != DSW_STATUS_OK) {
    std::fprintf(stderr, "%s\n", dsw_last_error_message());
    dsw_fuzz::require(false, "every seed is a sound mesh");
  }
  if (marked) {
    const dsw_edge_id edge = {0, 1, 0};
    const dsw_vertex_id vertex = {0, 1};
    const dsw_volume_id volume = {1, 1};
    dsw_environment_mark_between(environment, 0, 1, DSW_MARK_IMPASSABLE, nullptr);
    dsw_environment_mark_edges(environment, &edge, 1, DSW_MARK_IMPASSABLE);
    dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_IMPASSABLE);
    dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
  }
  if (changed) change(environment);
  const std::vector<uint8_t> block = dsw_fuzz::save(environment);
  dsw_environment_destroy(environment);
  return block;
}

/** A program of calls can be any bytes. Most are short: many of them are made in the time of a long one. */
constexpr uint32_t kPrograms = 32;
std::vector<uint8_t> some_bytes(uint32_t seed) {
  std::vector<uint8_t> bytes = {static_cast<uint8_t>(8 * seed + seed / 8)};  // worlds of every kind
  uint64_t state = seed;
  for (uint32_t i = 0; i < 16 + seed * seed / 2; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    bytes.push_back(static_cast<uint8_t>(state >> 56));
  }
  return bytes;
}

void write(const std::filesystem::path& path, const std::vector<uint8_t>& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  dsw_fuzz::require(file.good(), "seed written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  // Where the fuzzers keep what they find: empty at the start of a run.
  std::filesystem::remove_all(folder / "found");
  for (const char* target : {"create", "snapshot", "scene", "calls", "replay"}) {
    std::filesystem::create_directories(folder / "found" / target);
  }
  const struct {
    const char* name;
    Mesh mesh;
    uint8_t layout, flags;
  } seeds[] = {
      {"hexahedra", two_hexahedra(), kLabelled, 0},
      {"uniform_hexahedra", two_hexahedra(), kUniform | kNoOffsets | kNarrow, DSW_ENVIRONMENT_BORROW_POINTS},
      {"warped_hexahedra", warped_hexahedra(), kLabelled | kNarrow, DSW_ENVIRONMENT_LOCATE_TREE},
      {"polyhedra", two_polyhedra(), kLabelled, DSW_ENVIRONMENT_CHECK_BOUNDARY},
      {"polyhedra_faces_apart", two_polyhedra(), kFacesApart | kNarrow, 0},
      {"pyramids", six_pyramids(), kLabelled, DSW_ENVIRONMENT_LOCATE_TREE | DSW_ENVIRONMENT_CHECK_BOUNDARY},
      {"mixed", mixed(), kLabelled, 0},
      {"tetrahedra", tetrahedra(), kUniform | kNoOffsets, 0},
      {"damaged_tetrahedra", tetrahedra(), kDamaged, 0},
      {"plane", plane(), kPlanar | kLabelled, DSW_ENVIRONMENT_LOCATE_TREE | DSW_ENVIRONMENT_CHECK_BOUNDARY},
      {"reoriented_wedges", mixed(), kLabelled, DSW_ENVIRONMENT_REORIENT},
      {"sewn_polyhedra", two_polyhedra(), kLabelled | kSplit, kSewn},
      {"sewn_mixed", mixed(), kLabelled | kSplit, kSewn},
      {"sewn_plane", plane(), kPlanar | kLabelled | kSplit, kSewn},
  };
  for (const auto& seed : seeds) {
    write(folder / "create" / seed.name, encode(seed.mesh, seed.layout, seed.flags));
    const uint32_t flags = seed.flags & uint32_t{DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_LOCATE_TREE};
    const bool marked = (seed.layout & kLabelled) != 0;
    write(folder / "snapshot" / seed.name, snapshot(seed.mesh, flags, marked, false));
    write(folder / "snapshot" / (std::string(seed.name) + "_changed"), snapshot(seed.mesh, flags, marked, true));
  }
  for (const bool is_planar : {false, true}) {
    dsw_environment* const home = dsw_fuzz::make_home(is_planar);
    dsw_scene* const scene = dsw_fuzz::make_inhabited(home);
    write(folder / "scene" / (is_planar ? "planar_bodies" : "bodies"), dsw_fuzz::save(scene));
    dsw_scene_destroy(scene);
    dsw_environment_destroy(home);
  }
  for (uint32_t i = 0; i < kPrograms; ++i) {
    write(folder / "calls" / std::to_string(i), some_bytes(i));
    write(folder / "replay" / std::to_string(i), some_bytes(i));
  }
  return 0;
}
