#include "space_ground.h"

namespace dsw::oracle {
namespace {

class SpacePicture : public Picture {
 public:
  SpacePicture(const Stage& stage, const std::vector<Vec>& points)
      : world_(moved(stage.world.mesh, points), stage.environment.get()) {
    world_.cell_marked = stage.world.cell_marked;
    for (size_t f = 0; f < world_.faces.size(); ++f) world_.faces[f].marked = stage.world.faces[f].marked;
    arena_ = std::make_unique<SpaceArena>(world_, stage.marked_edges, stage.marked_vertices);
  }
  bool is_sound() const override { return world_.fault().empty(); }
  bool contains(int cell, const Vec& at) override { return world_.contains(cell, world_.body(at.data())); }
  Arena& arena() override { return *arena_; }

 private:
  static Mesh moved(Mesh mesh, const std::vector<Vec>& points) {
    mesh.points = points;
    return mesh;
  }

  World world_;
  std::unique_ptr<SpaceArena> arena_;
};

class SpaceGround : public Ground {
 public:
  SpaceGround(std::unique_ptr<Stage> stage, Rng& rng)
      : stage_(std::move(stage)),
        arena_(stage_->world, stage_->marked_edges, stage_->marked_vertices),
        places_(*stage_, rng) {}

  dsw_environment* environment() const override { return stage_->environment.get(); }
  Arena& arena() override { return arena_; }
  Places& places() override { return places_; }
  const std::vector<Vec>& points() const override { return stage_->world.mesh.points; }
  std::vector<std::array<int, 2>> passages() const override {
    std::vector<std::array<int, 2>> list;
    const World& w = stage_->world;
    for (size_t f = 0; f < w.faces.size(); ++f) {
      if (w.faces[f].cell[1] < 0 || w.impassable(static_cast<int>(f))) continue;
      list.push_back({w.faces[f].cell[0], w.faces[f].cell[1]});
    }
    return list;
  }
  int corner(int cell, Rng& rng) const override {
    const Cell& of = stage_->world.mesh.cells[static_cast<size_t>(cell)];
    const Loop& loop = of.faces[rng.below(of.faces.size())];
    return loop[rng.below(loop.size())];
  }
  std::unique_ptr<Picture> picture(const std::vector<Vec>& points) const override {
    return std::make_unique<SpacePicture>(*stage_, points);
  }

 private:
  std::unique_ptr<Stage> stage_;
  SpaceArena arena_;
  StagePlaces places_;
};

}  // namespace

std::unique_ptr<Ground> make_ground(std::unique_ptr<Stage> stage, Rng& rng) {
  return std::make_unique<SpaceGround>(std::move(stage), rng);
}

std::unique_ptr<Ground> space_ground_of(const SweepTurn& turn, uint64_t seed, Rng& rng, SweepReport& faults) {
  faults.begin(turn.kind->name,
               std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " + std::to_string(seed));
  std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, faults);
  if (stage == nullptr) return nullptr;
  stage->mark_vertices(rng, faults);
  return make_ground(std::move(stage), rng);
}

}  // namespace dsw::oracle
