#include "fold.h"

#include <algorithm>
#include <cmath>

#include "channel.h"

namespace physics {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRidge = 4, kPeak = 2, kEaves = 1.2;  // x of the ridge, heights, m
constexpr double kLong = 5;                            // of the body, m
constexpr double kThick = 0.8, kWide = 0.6;            // of the bar
constexpr double kStart = 2.1;                         // height of the underside at first
constexpr int kRows = 4;                               // of the sheet along y

// 8 x 4 x 8 cubes of 1 m, in the plane 8 x 8 squares; those under the roof are impassable.
Environment make_roof(bool plane) {
  Channel channel;
  channel.cubes = plane ? std::array<int, 3>{8, 8, 0} : std::array<int, 3>{8, 4, 8};
  for (int depth = 0; depth < (plane ? 1 : 4); ++depth) {
    for (int x = 3; x < 5; ++x) {
      for (int height = 0; height < 2; ++height) {
        channel.obstacles.push_back(plane ? std::array<int, 3>{x, height, 0} : std::array<int, 3>{x, depth, height});
      }
    }
  }
  channel.place = [up = plane ? 1 : 2](Vector3 corner) {
    if (std::abs(corner.x() - kRidge) == 1 && corner[up] == kPeak) {
      corner[up] = kEaves;
    }
    return corner;
  };
  return make_channel(channel);
}

// Corner 4 * i + k: k = 0 and 1 below, 2 and 3 above, in the order round the section.
BodyMesh make_bar(double middle, int cells, bool surface) {
  BodyMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (const auto& at : {std::make_pair(0, 0), std::make_pair(1, 0), std::make_pair(1, 1), std::make_pair(0, 1)}) {
      mesh.corners.emplace_back(middle + kLong * (i / static_cast<double>(cells) - 0.5), 2 + kWide * (at.first - 0.5),
                                kStart + kThick * at.second);
    }
  }
  const auto corner = [](int i, int k) { return static_cast<std::uint32_t>(4 * i + k % 4); };
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k < 4; ++k) {
      mesh.edges.insert(mesh.edges.end(), {corner(i, k), corner(i, k + 1)});
      if (i < cells) {
        mesh.edges.insert(mesh.edges.end(), {corner(i, k), corner(i + 1, k)});
        mesh.triangles.insert(mesh.triangles.end(), {corner(i, k), corner(i + 1, k), corner(i + 1, k + 1)});
        mesh.triangles.insert(mesh.triangles.end(), {corner(i, k), corner(i + 1, k + 1), corner(i, k + 1)});
      }
    }
  }
  for (const int k : {1, 2}) {
    mesh.triangles.insert(mesh.triangles.end(), {corner(0, 0), corner(0, k), corner(0, k + 1)});
    mesh.triangles.insert(mesh.triangles.end(), {corner(cells, 0), corner(cells, k + 1), corner(cells, k)});
  }
  (surface ? mesh.edges : mesh.triangles).clear();
  return mesh;
}

BodyMesh make_sheet(double middle, int cells) {
  BodyMesh mesh;
  const auto corner = [](int i, int j) { return static_cast<std::uint32_t>(kRows * i + j); };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j < kRows; ++j) {
      mesh.corners.emplace_back(middle + kLong * (i / static_cast<double>(cells) - 0.5),
                                2 + 0.5 * (j - 0.5 * (kRows - 1)), kStart);
      if (i < cells) {
        mesh.edges.insert(mesh.edges.end(), {corner(i, j), corner(i + 1, j)});
      }
      if (j + 1 < kRows) {
        mesh.edges.insert(mesh.edges.end(), {corner(i, j), corner(i, j + 1)});
      }
    }
  }
  return mesh;
}

// Corner 2 * i + k: k = 0 below, 1 above.
BodyMesh make_side(double middle, int cells) {
  BodyMesh mesh;
  for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(cells); ++i) {
    for (std::uint32_t k = 0; k < 2; ++k) {
      mesh.corners.emplace_back(middle + kLong * (i / static_cast<double>(cells) - 0.5), kStart + kThick * k, 0);
      if (i > 0) {
        mesh.edges.insert(mesh.edges.end(), {2 * i + k - 2, 2 * i + k});
      }
    }
    mesh.edges.insert(mesh.edges.end(), {2 * i, 2 * i + 1});
  }
  return mesh;
}

BodyMesh make_body(const FoldOptions& options) {
  const double middle = kRidge + options.aside;
  switch (options.body) {
    case FoldBody::kSheet:
      return make_sheet(middle, options.cells);
    case FoldBody::kPlane:
      return make_side(middle, options.cells);
    default:
      return make_bar(middle, options.cells, options.body == FoldBody::kSurface);
  }
}

// Sorts parts: each part begins with its lowest index, and the ends of an edge go up.
std::vector<std::uint32_t> in_order(const std::vector<std::uint32_t>& parts, std::size_t size) {
  std::vector<std::vector<std::uint32_t>> sorted;
  for (std::size_t k = 0; k < parts.size(); k += size) {
    std::vector<std::uint32_t> part(parts.begin() + static_cast<std::ptrdiff_t>(k),
                                    parts.begin() + static_cast<std::ptrdiff_t>(k + size));
    std::rotate(part.begin(), std::min_element(part.begin(), part.end()), part.end());
    sorted.push_back(part);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> joined;
  for (const std::vector<std::uint32_t>& part : sorted) {
    joined.insert(joined.end(), part.begin(), part.end());
  }
  return joined;
}

}  // namespace

const char* name_of(FoldBody body) {
  const char* const names[] = {"bar", "sheet", "surface", "plane"};
  return names[static_cast<int>(body)];
}

FoldOptions::FoldOptions() {
  move = SoftBodyOptions().move;
  move.noise_share = 0;    // ours, not the paper's
  move.min_length = 0.05;  // parts of edges get no shorter
}

Fold::Fold(const FoldOptions& fold)
    : options_(fold),
      plane_(fold.body == FoldBody::kPlane),
      environment_(make_roof(plane_)),
      world_(environment_.get()) {
  SoftBodyOptions options;
  options.level = DSW_LEVEL_EDGES_SWEPT;
  options.move = fold.move;
  options.match = fold.match;
  options.negligible = fold.negligible;
  body_ = world_.add(std::make_unique<SoftBody>(world_.scene(), make_body(fold), 1.0, options));
  body_->shape.emplace(body_->points, fold.omega, plane_);
  body_->load.drag = fold.drag;
  first_ = body_->points;
  first_edges_ = in_order(edges(), 2);
  first_faces_ = in_order(faces(), 3);
}

std::vector<std::uint32_t> Fold::edges() const {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(world_.scene(), body_->id(), &counts), "reading a body");
  std::vector<std::uint32_t> ends(std::size_t{2} * counts.edge_slots);
  std::size_t count = 0;
  check(dsw_body_get_edge_indices(world_.scene(), body_->id(), ends.data(), counts.edge_slots, &count),
        "reading edges");
  ends.erase(std::remove(ends.begin(), ends.end(), UINT32_MAX), ends.end());
  return ends;
}

std::vector<std::uint32_t> Fold::faces() const {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(world_.scene(), body_->id(), &counts), "reading a body");
  std::vector<std::uint32_t> corners(std::size_t{3} * counts.face_slots + 3);  // + 3: never a null pointer
  std::size_t count = 0;
  check(dsw_body_get_face_indices(world_.scene(), body_->id(), corners.data(), counts.face_slots, &count),
        "reading faces");
  corners.resize(std::size_t{3} * counts.face_slots);
  corners.erase(std::remove(corners.begin(), corners.end(), UINT32_MAX), corners.end());
  return corners;
}

bool Fold::is_over() const { return steps_ >= options_.press + options_.lift + options_.rest; }

bool Fold::is_as_at_first() const {
  const auto has_mass = [](double m) { return m > 0; };
  const std::vector<double>& mass = body_->points.mass;
  return in_order(edges(), 2) == first_edges_ && in_order(faces(), 3) == first_faces_ &&
         std::equal(first_.mass.begin(), first_.mass.end(), mass.begin()) &&
         std::none_of(mass.begin() + static_cast<std::ptrdiff_t>(first_.size()), mass.end(), has_mass);
}

FoldStep Fold::step() {
  const bool press = steps_ < options_.press, lift = !press && steps_ < options_.press + options_.lift;
  const double gravity = press ? -options_.gravity : lift ? options_.gravity : 0;
  const Vector3 up = plane_ ? Vector3(0, 1, 0) : Vector3(0, 0, 1);
  body_->load.gravity = gravity * up;
  const std::vector<double> before = body_->pulls();
  world_.step(options_.dt);

  const double radius = body_->shape->radius();
  const Points& points = body_->points;
  const StepReport& report = world_.report(0);
  FoldStep done;
  done.step = steps_++;
  done.phase = press ? "press" : lift ? "lift" : "rest";
  done.vertices = body_->count();
  done.edges = edges().size() / 2;
  done.inserted = report.inserted;
  done.removed = report.removed;
  done.contacts = report.move.contact_count;
  for (const double pull : body_->pulls()) {
    done.largest_pull = std::max(done.largest_pull, pull / radius);
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] > 0 && points.mass[i] == 0) {
      done.removed_pull = std::max(done.removed_pull, before[i] / radius);
    }
  }
  ShapeMatching originals(first_, 0, plane_);
  Positions goals;
  originals.find_goals(
      Positions(points.position.begin(), points.position.begin() + static_cast<std::ptrdiff_t>(first_.size())), &goals);
  for (std::size_t i = 0; i < first_.size(); ++i) {
    done.bend = std::max(done.bend, (goals[i] - points.position[i]).norm() / radius);
  }
  const Eigen::Matrix3d& r = originals.rotation();
  done.turned = std::atan2((r * up).x(), up.dot(r * up)) * 180 / kPi;
  done.unwanted = Eigen::AngleAxisd(r.transpose() * body_->shape->rotation()).angle() * 180 / kPi;
  done.validation = verify(world_.scene(), body_->id());
  return done;
}

Positions Fold::in_space() const {
  Positions positions = body_->points.position;
  for (Vector3& at : positions) {
    at = plane_ ? Vector3(at.x(), 2, at.y()) : at;
  }
  return positions;
}

Positions roof() {
  return {{kRidge - 1, 2, 0}, {kRidge - 1, 2, kEaves}, {kRidge, 2, kPeak}, {kRidge + 1, 2, kEaves}, {kRidge + 1, 2, 0}};
}

}  // namespace physics
