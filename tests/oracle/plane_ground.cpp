// Environments in the plane that are deformed.
#include "plane_ground.h"
#include "deform_run.h"
#include "plane_arena.h"
#include "plane_walls.h"
#include "rounds.h"

#include <algorithm>

namespace dsw::oracle {
namespace {

class PlanePicture : public Picture {
 public:
  PlanePicture(const plane::World& world, const std::vector<int>& marked, const std::vector<Vec>& points)
      : world_(world) {
    for (size_t v = 0; v < points.size(); ++v) world_.points[v] = flat(points[v]);
    arena_ = std::make_unique<PlaneArena>(world_, marked);
  }
  bool contains(int cell, const Vec& at) override { return plane::contains(world_, cell, flat(at)); }
  Arena& arena() override { return *arena_; }

 private:
  plane::World world_;
  std::unique_ptr<PlaneArena> arena_;
};

class PlaneGround : public Ground {
 public:
  PlaneGround(const plane::World& world, const std::vector<int>& marked, EnvironmentPtr environment, Rng& rng)
      : world_(world),
        marked_(marked),
        environment_(std::move(environment)),
        arena_(world_, marked_),
        places_(world_, arena_, marked_, rng) {
    for (const plane::Vec& p : world_.points) points_.push_back(raised(p));
  }

  dsw_environment* environment() const override { return environment_.get(); }
  Arena& arena() override { return arena_; }
  Places& places() override { return places_; }
  const std::vector<Vec>& points() const override { return points_; }
  std::vector<std::array<int, 2>> passages() const override {
    std::vector<std::array<int, 2>> list;
    for (const plane::Side& s : world_.sides) {
      if (!world_.impassable(s)) list.push_back({s.cell[0], s.cell[1]});
    }
    return list;
  }
  int corner(int cell, Rng& rng) const override {
    const std::vector<int>& loop = world_.cells[static_cast<size_t>(cell)];
    return loop[rng.below(loop.size())];
  }
  std::unique_ptr<Picture> picture(const std::vector<Vec>& points) const override {
    return std::make_unique<PlanePicture>(world_, marked_, points);
  }

  Validation validate(const Deformed& d, const std::vector<Part>& parts) override {
    Validation validation;
    const WallValidator validator(world_, marked_, d);
    const auto note = [&](const std::string& fault) {
      if (!fault.empty()) validation.faults.push_back(fault);
    };
    for (const Part& part : parts) {
      if (!validator.knows(part)) continue;
      ++validation.parts;
      note(validator.passed(part));
    }
    const bool pushes = d.options.response == DSW_WALL_PUSH || d.options.response == DSW_WALL_INSERT;
    for (size_t i = 0; i < d.contacts.size(); ++i) {
      const dsw_wall_contact& c = d.contacts[i];
      const Part* edge =
          nullptr;  // where it is, is known as long as nothing has been pushed, with or without a contact of its own
      if (c.edge.generation != 0 && (i == 0 || !pushes)) {
        const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& part) {
          return same_id(part.body, c.body) && same_id(part.edge, c.edge);
        });
        if (found == parts.end()) {
          note("a contact of an unknown edge");
        } else {
          edge = &*found;
        }
      }
      const std::string fault = validator.wrong_contact(c, edge);
      if (!fault.empty()) note("contact " + std::to_string(i) + ": " + fault);
      validation.contacts += c.edge.generation == 0 || edge != nullptr ? 1 : 0;
    }
    return validation;
  }

 private:
  plane::World world_;
  std::vector<int> marked_;
  EnvironmentPtr environment_;
  std::vector<Vec> points_;
  PlaneArena arena_;
  PlanePlaces places_;
};

void one_scene(const plane::Turn& turn, uint64_t seed, DeformReport& report) {
  Rng rng(seed);
  std::string fault;
  const std::unique_ptr<Ground> ground = plane_ground_of(turn, seed, rng, report.faults, fault);
  if (ground != nullptr) return run_on_ground(*ground, rng, report);
  if (fault.empty()) return;
  ++report.wrong;
  report.faults.fault(SweepReport::kWrong, fault);
}

}  // namespace

std::unique_ptr<Ground> plane_ground_of(const plane::Turn& turn, uint64_t seed, Rng& rng, SweepReport& faults,
                                        std::string& fault) {
  faults.begin(turn.kind->name, turn.name() + " scene seed " + std::to_string(seed));
  plane::World world = plane::make_world(turn, rng);
  EnvironmentPtr environment = make_environment(turn, world, rng);
  if (environment == nullptr) {
    if (!turn.may_be_refused()) fault = dsw_last_error_message();
    return nullptr;
  }
  static const double cells[] = {0, 0, 0.05, 0.2}, sides[] = {0.03, 0.1, 0.2, 0.4}, vertices[] = {0, 0.05, 0.1, 0.4};
  std::vector<int> marked;
  const plane::Shares shares = {cells[rng.below(4u)], sides[rng.below(4u)], vertices[rng.below(4u)]};
  fault = plane::mark(world, environment.get(), shares, rng, marked);
  if (!fault.empty()) return nullptr;
  return std::make_unique<PlaneGround>(world, marked, std::move(environment), rng);
}

void run_plane_deformations(const DeformRunOptions& options, DeformReport& report) {
  const std::vector<plane::Turn> turns = plane::turns(options.only);
  const auto one = [&](const plane::Turn& turn, uint64_t seed) { one_scene(turn, seed, report); };
  if (options.scene_seed != 0) {
    for (const plane::Turn& turn : turns) one(turn, options.scene_seed);
    return;
  }
  run_rounds(
      turns, Rng(options.seed << 20), options.steps, [&] { return report.steps; }, one);
}

}  // namespace dsw::oracle
