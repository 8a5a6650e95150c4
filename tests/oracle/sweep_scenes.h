// Scenes for swept edges, what is marked in them, and the sweeps.
#pragma once

#include "run.h"
#include "space_arena.h"
#include "sweep_check.h"

namespace dsw::oracle {

/// The scenes of casts, and wider ones that leave room for triangles that meet no wall.
const std::vector<SceneKind>& sweep_scenes();

/// One of the scenes in one of its sizes.
struct SweepTurn {
  const SceneKind* kind;
  Transform transform;
};
/// All that have their turn in a round; `only` names a scene, or is empty.
std::vector<SweepTurn> sweep_turns(const std::string& only);

/// A scene's environment with what is impassable in it.
struct Stage {
  Stage(const Mesh& mesh, EnvironmentPtr env) : environment(std::move(env)), world(mesh, environment.get()) {}
  void mark(Rng& rng, SweepReport& report);
  /// For bodies only: a swept edge meets no marked vertex.
  void mark_vertices(Rng& rng, SweepReport& report);

  EnvironmentPtr environment;
  World world;
  std::vector<std::array<int, 2>> marked_edges;
  std::vector<int> free_standing;  // marked faces
  std::vector<int> marked_vertices;
};

/// Builds and marks; null if creation may refuse the mesh (the casts' concern), or with a fault reported.
std::unique_ptr<Stage> make_stage(const SweepTurn& turn, uint64_t seed, Rng& rng, SweepReport& report);

/// Among the walls of a stage.
class StagePlaces : public Motions {
 public:
  StagePlaces(const Stage& stage, Rng& rng);
  Vec obstacle(double exactly) override;
  bool round_obstacle(Vec& site, std::array<Vec, 2>& span) override;
  Vec anchor() override;

 private:
  Vec corner(const Loop& loop, size_t i) const;

  const Stage& stage_;
  std::vector<int> spikes_;  // vertices of something impassable that is no closed wall
};

}  // namespace dsw::oracle
