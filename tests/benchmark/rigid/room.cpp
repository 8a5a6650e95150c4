#include "room.h"

#include <map>
#include <stdexcept>

namespace dsw::rigid {

namespace {

constexpr int kPoints = Room::kCells + 1;

std::int64_t number_of(int x, int y, int z) { return x + kPoints * (y + kPoints * z); }

}  // namespace

Room::Room(int dimension, double share, Random& random) : dimension_(dimension) {
  const int layers = dimension == 3 ? kPoints : 1;
  for (int z = 0; z < layers; ++z) {
    for (int y = 0; y < kPoints; ++y) {
      for (int x = 0; x < kPoints; ++x) {
        const int at[3] = {x, y, z};
        Point point{};
        bool is_inside = true;
        for (int k = 0; k < dimension; ++k) is_inside = is_inside && at[k] > 0 && at[k] < kCells;
        for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
          point[k] = at[k] + (is_inside ? random.uniform(-0.15, 0.15) : 0);
        }
        walls_.points.push_back(point);
      }
    }
  }
  std::vector<std::int64_t> cells;
  add_cells(cells);
  dsw_environment_desc d;
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = static_cast<std::uint32_t>(dimension);
  d.points = walls_.points[0].data();
  d.point_count = walls_.points.size();
  d.point_stride_bytes = sizeof(Point);
  d.connectivity = cells.data();
  d.connectivity_count = cells.size();
  d.volume_count = cells.size() / static_cast<std::size_t>(dimension + 1);
  d.flags = DSW_ENVIRONMENT_REORIENT;
  d.uniform_cell_type = dimension == 3 ? DSW_CELL_TYPE_TETRA : DSW_CELL_TYPE_TRIANGLE;
  check(dsw_environment_create(nullptr, &d, &environment_, nullptr));
  mark(cells, share, random);
  dsw_scene_desc s;
  dsw_scene_desc_init(&s, sizeof s);
  s.features = DSW_FEATURE_BODY_CONTACTS;
  check(dsw_scene_create(environment_, &s, &scene_));
}

Room::~Room() {
  dsw_scene_destroy(scene_);
  dsw_environment_destroy(environment_);
}

/** Each cell is cut along its diagonal: into six tetrahedra [Kuhn 1960], or two triangles. */
void Room::add_cells(std::vector<std::int64_t>& cells) const {
  static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int z = 0; z < (dimension_ == 3 ? kCells : 1); ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        for (const auto& order : kOrders) {
          if (dimension_ == 2 && order[2] != 2) continue;
          int at[3] = {x, y, z};
          cells.push_back(number_of(x, y, z));
          for (int k = 0; k < dimension_; ++k) {
            ++at[order[k]];
            cells.push_back(number_of(at[0], at[1], at[2]));
          }
        }
      }
    }
  }
}

/** Finds the walls: the faces of one cell alone, and a share of the others. */
void Room::mark(const std::vector<std::int64_t>& cells, double share, Random& random) {
  const auto D = static_cast<std::size_t>(dimension_);
  std::map<std::vector<std::uint32_t>, int> faces;
  for (std::size_t cell = 0; cell < cells.size(); cell += D + 1) {
    for (std::size_t left_out = 0; left_out <= D; ++left_out) {
      std::vector<std::uint32_t> face;
      for (std::size_t i = 0; i <= D; ++i) {
        if (i != left_out) face.push_back(static_cast<std::uint32_t>(cells[cell + i]));
      }
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  std::vector<std::size_t> offsets{0};
  std::vector<std::uint32_t> corners;
  for (const auto& [face, count] : faces) {
    const bool is_marked = count == 2 && random.uniform() < share;
    if (count == 2 && !is_marked) continue;
    if (D == 3) {
      walls_.add_face(face[0], face[1], face[2]);
    } else {
      walls_.add_edge(face[0], face[1]);
    }
    if (!is_marked) continue;
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(corners.size());
  }
  std::vector<dsw_face_id> ids(offsets.size() - 1);
  if (ids.empty()) return;
  std::size_t missing = 0;
  check(dsw_environment_find_faces(environment_, ids.size(), offsets.data(), corners.data(), ids.data(), &missing));
  if (missing != 0) throw std::runtime_error("a face of the room is not in the environment");
  check(dsw_environment_mark_faces(environment_, ids.data(), ids.size(), DSW_MARK_IMPASSABLE));
}

bool Room::add(const Figure& body, double radius, dsw_body_id& id, std::uint32_t flags) {
  return add_body(scene_, body, radius, id, flags);
}

std::vector<Point> Room::places(dsw_body_id body) const {
  dsw_body_counts counts{};
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(scene_, body, &counts));
  std::vector<Point> places(counts.vertex_slots);
  std::size_t count = 0;
  check(dsw_body_get_positions(scene_, body, places[0].data(), places.size(), sizeof(Point), nullptr, &count));
  return places;
}

}  // namespace dsw::rigid
