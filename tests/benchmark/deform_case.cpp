#include "deform_case.h"

#include "timing.h"

#include <cmath>
#include <stdexcept>

namespace dsw::bench {

namespace {

constexpr double kTurn = 6.283185307179586, kHeight = 0.05, kPeriod = 16;
constexpr double kWaves[3][3] = {{0.08, 0.05, 0.03}, {-0.04, 0.07, 0.06}, {0.05, -0.03, 0.08}};  // turns a cell

scenes::HexGridOptions lattice(std::size_t cells) {
  scenes::HexGridOptions options;
  options.size = scenes::hex_grid_size(cells);
  return options;
}

using Turn = std::array<double, 2>;  // cosine and sine

Turn turn(double part) { return {std::cos(kTurn * part), std::sin(kTurn * part)}; }
Turn operator*(const Turn& a, const Turn& b) { return {a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]}; }

double phase(std::size_t step, std::size_t component) {
  return static_cast<double>(step) / kPeriod + 0.3 * static_cast<double>(component);
}

}  // namespace

TravellingWave::TravellingWave(const std::array<std::uint32_t, 3>& size) : size_(size) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::uint32_t i = 0; i <= size[axis]; ++i) turns_[3 * c + axis].push_back(turn(kWaves[c][axis] * i));
    }
  }
}

void TravellingWave::write(std::size_t step, std::vector<double>& points) const {
  points.resize(3 * std::size_t{size_[0] + 1} * (size_[1] + 1) * (size_[2] + 1));
  double* out = points.data();
  for (std::uint32_t z = 0; z <= size_[2]; ++z) {
    for (std::uint32_t y = 0; y <= size_[1]; ++y) {
      Turn row[3];
      for (std::size_t c = 0; c < 3; ++c) {
        row[c] = turn(-phase(step, c)) * (turns_[3 * c + 1][y] * turns_[3 * c + 2][z]);
      }
      for (std::uint32_t x = 0; x <= size_[0]; ++x, out += 3) {
        const double at[3] = {double(x), double(y), double(z)};
        for (std::size_t c = 0; c < 3; ++c) out[c] = at[c] + kHeight * (row[c] * turns_[3 * c][x])[1];
      }
    }
  }
}

void TravellingWave::move(std::size_t step, const double* lattice_point, double* space) const {
  for (std::size_t c = 0; c < 3; ++c) {
    double part = -phase(step, c);
    for (std::size_t axis = 0; axis < 3; ++axis) part += kWaves[c][axis] * lattice_point[axis];
    space[c] = lattice_point[c] + kHeight * turn(part)[1];
  }
}

DeformCase::DeformCase(std::size_t cells)
    : hex_("deform", lattice(cells), {}, 1), wave_(hex_.grid.options.size), names_(hex_.world, hex_.walls) {
  dsw_scene* scene = hex_.world.scene(DSW_FEATURE_DEFORMING);
  for (auto& points : points_) wave_.write(step_, points);
  check(dsw_environment_deform(dsw_scene_get_environment(scene), points_[0].data(), points_[0].size() / 3, nullptr,
                               nullptr));

  const std::vector<double>& starts = hex_.motion.starts();
  particles_.resize(hex_.motion.vertex_count());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (place_particle(i, &starts[3 * i])) continue;
    double centre[3];  // of its cell: a face is not bent exactly as the wave is, so the start can lie beyond a wall
    for (std::size_t k = 0; k < 3; ++k) centre[k] = std::floor(starts[3 * i + k]) + 0.5;
    if (!place_particle(i, centre)) throw std::runtime_error("a particle has no place");
  }
  for (std::size_t first = 0; first < particles_.size(); first += scenes::kBodyVertices) {
    for (std::size_t i = 0; i < scenes::kBodyVertices; ++i) ends_.push_back({first + i, first + i});
    for (const auto& edge : scenes::kEdgeVertices) ends_.push_back({first + edge[0], first + edge[1]});
  }
  sources_.resize(ends_.size());
  to_.resize(3 * sources_.size());
  flights_.resize(sources_.size());
}

std::vector<double> DeformCase::in_space(const std::vector<double>& lattice_points) const {
  std::vector<double> space(lattice_points.size());
  for (std::size_t i = 0; i < space.size(); i += 3) wave_.move(step_, &lattice_points[i], &space[i]);
  return space;
}

DeformCase::Times DeformCase::advance(dsw_deform_method method, DeformStep& step) {
  dsw_scene* scene = hex_.world.scene();
  std::vector<double>& next = points_[++step_ % 2];
  wave_.write(step_, next);
  const std::vector<double> targets = in_space(hex_.motion.targets());
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    sources_[i] = particles_[ends_[i][0]];
    std::copy_n(&targets[3 * ends_[i][1]], 3, &to_[3 * i]);
  }

  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.method = method;
  dsw_deform_report report{};
  Times times{};
  times.update = cpu_time_ns([&] {
    check(dsw_environment_deform(dsw_scene_get_environment(scene), next.data(), next.size() / 3, &options, &report));
  });
  times.queries = cpu_time_ns([&] {
    check(dsw_scene_cast_from_particles(scene, sources_.data(), sources_.size(), to_.data(), 0, nullptr,
                                        flights_.data()));
  });
  times.alone = report.near_count;
  pushed_ += report.pushed_count;
  shortened_ += report.outcome == DSW_DEFORM_DONE ? 0 : 1;

  step.wave = step_;
  step.segments.batch = sources_.size();
  step.segments.from.resize(to_.size());
  step.segments.to = to_;
  check(
      dsw_scene_get_particle_positions(scene, sources_.data(), sources_.size(), step.segments.from.data(), 0, nullptr));
  step.answers.clear();
  for (const dsw_flight& flight : flights_) step.answers.push_back(names_.answer_of(flight));
  hex_.motion.advance();
  move_particles();
  return times;
}

/** Whether there is room for a particle. */
bool DeformCase::place_particle(std::size_t i, const double* lattice_point) {
  double at[3];
  wave_.move(step_, lattice_point, at);
  dsw_volume_id hint;
  check(dsw_environment_get_volume_id(hex_.world.environment(), hex_.grid.cell_at(lattice_point), &hint));
  return dsw_particle_create(hex_.world.scene(), at, hint, &particles_[i]) == DSW_STATUS_OK;
}

/** To where the next step begins; what is in the way of one is nothing that its body has to heed. */
void DeformCase::move_particles() {
  dsw_scene* scene = hex_.world.scene();
  const std::vector<double>& starts = hex_.motion.starts();
  std::vector<dsw_flight> flights(particles_.size());
  check(dsw_scene_move_particles(scene, particles_.data(), particles_.size(), in_space(starts).data(), 0, nullptr,
                                 flights.data()));
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const dsw_particle_id before = particles_[i];
    if (flights[i].outcome != DSW_OUTCOME_REACHED && place_particle(i, &starts[3 * i])) {
      check(dsw_particle_destroy(scene, before));
    }
  }
}

void DeformCase::place_walls(std::size_t wave_step) {
  wave_.write(wave_step, wall_points_);
  hex_.walls.points = &wall_points_;
}

}  // namespace dsw::bench
