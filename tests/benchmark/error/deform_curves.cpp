// Particles at rest while all of a lattice goes by, one cell in ten of it impassable. Seen from the lattice each
// particle flies straight on, so exact rationals tell which of them walls meet. The way is 10 cell radii long and is
// made in 1 to 1000 deformations. Then the same with edges in place of particles.
#include "deform_curves.h"

#include "../timing.h"
#include "body_state.h"
#include "check.h"
#include "rng.h"
#include "sweep_truth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dsw::curves {
namespace {

using oracle::Vec;

constexpr double kRadius = 0.5;  // of a ball in a cell
constexpr double kRadii = 10;    // length of the way
constexpr Vec kWay = {0.9 * kRadii * kRadius, 0.35 * kRadii* kRadius, 0.25 * kRadii* kRadius};

struct Particle {
  Vec at;
  bool met;           // exactly: a wall goes over it
  double time = 1;    // exactly, rounded: of the lattice's whole way
  oracle::Loop wall;  // its corners
};

struct Lattice {
  int size[3] = {18, 9, 8};
  oracle::Mesh mesh;
  std::vector<uint32_t> marked;
  std::vector<Particle> particles;

  Lattice(std::size_t count, oracle::Rng& rng) {
    build(rng);
    oracle::EnvironmentPtr environment = make();
    oracle::World world(mesh, environment.get());
    for (const uint32_t cell : marked) world.cell_marked[cell] = 1;
    while (particles.size() < count) {
      Particle p;
      Vec to;
      for (std::size_t k = 0; k < 3; ++k) {
        p.at[k] = rng.range(kWay[k] + 0.5, size[k] - 0.5);
        to[k] = p.at[k] - kWay[k];
      }
      const oracle::Walk walk = world.cast(world.body(p.at.data()), world.body(to.data()));
      if (walk.outcome == oracle::Walk::kImpassable) continue;
      if (walk.outcome != oracle::Walk::kReached && walk.outcome != oracle::Walk::kContact) {
        throw std::runtime_error("the oracle does not find its way: " + walk.fault);
      }
      p.met = walk.outcome == oracle::Walk::kContact;
      p.time = walk.time;
      if (p.met) p.wall = world.faces[static_cast<std::size_t>(walk.face)].loop;
      particles.push_back(p);
    }
  }

  oracle::EnvironmentPtr make() const {
    oracle::EnvironmentPtr environment = oracle::create_environment(mesh, {}, DSW_ENVIRONMENT_LOCATE_TREE);
    for (const uint32_t cell : marked) {
      dsw_volume_id id;
      if (environment == nullptr || dsw_environment_get_volume_id(environment.get(), cell, &id) != DSW_STATUS_OK ||
          dsw_environment_mark_volumes(environment.get(), &id, 1, DSW_MARK_IMPASSABLE, 0, nullptr) != DSW_STATUS_OK) {
        throw std::runtime_error("no environment");
      }
    }
    return environment;
  }

 private:
  /// Vertices are shifted by up to a tenth of a cell: no face is flat.
  void build(oracle::Rng& rng) {
    for (int z = 0; z <= size[2]; ++z) {
      for (int y = 0; y <= size[1]; ++y) {
        for (int x = 0; x <= size[0]; ++x) {
          mesh.points.push_back({x + rng.range(-0.1, 0.1), y + rng.range(-0.1, 0.1), z + rng.range(-0.1, 0.1)});
        }
      }
    }
    const auto point = [this](int x, int y, int z) { return x + (size[0] + 1) * (y + (size[1] + 1) * z); };
    for (int z = 0; z < size[2]; ++z) {
      for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) {
          mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON, {point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z),
                                                       point(x, y + 1, z), point(x, y, z + 1), point(x + 1, y, z + 1),
                                                       point(x + 1, y + 1, z + 1), point(x, y + 1, z + 1)});
          if (rng.chance(0.1)) marked.push_back(static_cast<uint32_t>(mesh.cells.size() - 1));
        }
      }
    }
  }
};

struct Bent {
  double seconds = 0;                 // of the processor, all deformations
  double way = 1;                     // made by the points of the lattice, in the mean
  std::size_t met = 0, passed = 0;    // particles that walls went over in truth; and were not touched
  std::size_t waiting = 0;            // and were not touched, but the wall was held and has some way to go
  std::size_t unmet = 0, pushed = 0;  // that no wall met; and were pushed
  std::size_t lost = 0;               // not where they say, by another search
  std::size_t not_free = 0;           // edges that meet something impassable, exactly
  Errors place;  // of particles that walls met, which from then on go with the lattice: shares of its way
};

/// Walls that push by the whole step in which they touch, as version 2.0 did, leave these errors at their best: with one
/// push for all vertices of a wall a particle is ahead of it by what the wall had gone before it touched.
Errors whole_steps(const Lattice& lattice, int steps) {
  Errors errors;
  for (const Particle& p : lattice.particles) {
    if (p.met) errors.values.push_back((steps * p.time - std::floor(steps * p.time)) / steps);
  }
  return errors;
}

/// A lattice that goes by a scene. What the scene holds is put into it before.
class Bending {
 public:
  explicit Bending(const Lattice& lattice) : lattice_(lattice), environment_(lattice.make()) {
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = DSW_FEATURE_DEFORMING;
    dsw_scene* made = nullptr;
    if (dsw_scene_create(environment(), &desc, &made) != DSW_STATUS_OK) throw std::runtime_error("no scene");
    scene_.reset(made);
  }

  Bent run(dsw_deform_method method, int steps) {
    dsw_deform_options options;
    dsw_deform_options_init(&options, sizeof options);
    options.method = method;
    const std::vector<Vec>& points = lattice_.mesh.points;
    Bent bent;
    for (int step = 1; step <= steps; ++step) {
      std::vector<double>& next = arrays_[step % 2];
      next.clear();
      for (const Vec& p : points) {
        for (std::size_t k = 0; k < 3; ++k) next.push_back(p[k] + (step == steps ? kWay[k] : kWay[k] * step / steps));
      }
      dsw_status status = DSW_STATUS_OK;
      bent.seconds += 1e-9 * bench::cpu_time_ns([&] {
                        status = dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), points.size(),
                                                        &options, nullptr);
                      });
      if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
    }
    in_place_.assign(points.size(), true);
    double made = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double* at = &arrays_[steps % 2][3 * v];
      reached_.mesh.points[v] = {at[0], at[1], at[2]};
      for (std::size_t k = 0; k < 3; ++k) {
        in_place_[v] = in_place_[v] && at[k] == points[v][k] + kWay[k];
        made += (at[k] - points[v][k]) / kWay[k] / 3;
      }
    }
    const bool all = std::find(in_place_.begin(), in_place_.end(), false) == in_place_.end();
    bent.way = all ? 1 : made / static_cast<double>(points.size());
    return bent;
  }

  dsw_scene* scene() { return scene_.get(); }
  dsw_environment* environment() { return environment_.get(); }
  /// Whether a wall made all of its way.
  bool is_in_place(const oracle::Loop& wall) const {
    return std::all_of(wall.begin(), wall.end(), [this](int v) { return in_place_[static_cast<std::size_t>(v)]; });
  }
  /// The lattice as it is after a run.
  const Lattice& reached() const { return reached_; }

 private:
  const Lattice& lattice_;
  Lattice reached_ = lattice_;
  std::vector<bool> in_place_;     // by vertex
  std::vector<double> arrays_[2];  // lent: they go after the environment
  oracle::EnvironmentPtr environment_;
  oracle::ScenePtr scene_;
};

Bent bend_particles(const Lattice& lattice, dsw_deform_method method, int steps) {
  Bending bending(lattice);
  std::vector<dsw_particle_id> ids;
  for (const Particle& p : lattice.particles) {
    ids.emplace_back();
    if (dsw_particle_create(bending.scene(), p.at.data(), {0, 0}, &ids.back()) != DSW_STATUS_OK) {
      throw std::runtime_error("no particle");
    }
  }
  Bent bent = bending.run(method, steps);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Particle& p = lattice.particles[i];
    Vec at;
    dsw_volume_id volume, found;
    dsw_location location = DSW_LOCATION_NONE;
    if (dsw_particle_get_position(bending.scene(), ids[i], at.data(), &volume) != DSW_STATUS_OK ||
        dsw_environment_locate(bending.environment(), at.data(), {0, 0}, &found, &location) != DSW_STATUS_OK) {
      throw std::runtime_error("no particle");
    }
    bent.lost += location == DSW_LOCATION_PASSABLE && found.index == volume.index ? 0 : 1;
    ++(p.met ? bent.met : bent.unmet);
    if (p.met && at == p.at) ++(bending.is_in_place(p.wall) ? bent.passed : bent.waiting);
    bent.pushed += !p.met && at != p.at ? 1 : 0;
    if (!p.met || !bending.is_in_place(p.wall)) continue;
    double off = 0, way = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      off += std::pow(at[k] - (p.at[k] + (1 - p.time) * kWay[k]), 2);
      way += kWay[k] * kWay[k];
    }
    bent.place.values.push_back(std::sqrt(off / way));
  }
  return bent;
}

/// Edges from every tenth particle, 0.8 cells long, where there is room.
Bent bend_edges(const Lattice& lattice, uint64_t seed, dsw_deform_method method, int steps, std::size_t* count) {
  Bending bending(lattice);
  oracle::Rng rng(seed);
  std::vector<dsw_body_id> bodies;
  for (std::size_t i = 0; i < lattice.particles.size(); i += 10) {
    oracle::BodyPlan plan;
    const Vec& p = lattice.particles[i].at;
    const double x = rng.range(-1, 1), y = rng.range(-1, 1), z = rng.range(-1, 1),
                 part = 0.8 / std::sqrt(x * x + y * y + z * z);
    plan.at = {p, {p[0] + part * x, p[1] + part * y, p[2] + part * z}};
    plan.edges = {{0, 1}};
    dsw_body_id body;
    if (oracle::create_body(bending.scene(), plan, DSW_LEVEL_EDGES_SWEPT, 0, {}, &body) == DSW_STATUS_OK)
      bodies.push_back(body);
  }
  Bent bent = bending.run(method, steps);
  const Lattice& reached = bending.reached();
  oracle::World world(reached.mesh, bending.environment());
  for (const uint32_t cell : reached.marked) world.cell_marked[cell] = 1;
  oracle::SweepWorld exact(world, {});
  for (const dsw_body_id body : bodies) {
    oracle::BodyState state;
    const std::string fault = oracle::read_body(bending.scene(), body, state);
    if (!fault.empty()) throw std::runtime_error(fault);
    for (const auto& edge : state.edges) bent.not_free += exact.blocked(state.at[edge[0]], state.at[edge[1]]) ? 1 : 0;
  }
  *count = bodies.size();
  return bent;
}

double share(std::size_t part, std::size_t all) { return static_cast<double>(part) / static_cast<double>(all); }

/// The cheapest setting of a method with which nothing is wrong; null if there is none.
const Point* cheapest_right(const Curve& curve, const std::string& method) {
  const Point* best = nullptr;
  for (const Point& p : curve.points) {
    if (p.method == method && p.error == 0 && (best == nullptr || p.seconds < best->seconds)) best = &p;
  }
  return best;
}

std::string in_words(const Point* point) {
  return point == nullptr ? std::string("at no step tried")
                          : text("in steps of %s radii (%.3g us a particle for the whole way)", point->setting.c_str(),
                                 1e6 * point->seconds);
}

}  // namespace

void deform_curves(const Options& options) {
  oracle::Rng rng(options.seed);
  const Lattice lattice(options.count(300, 2000), rng);
  const std::vector<int> steps = options.quick ? std::vector<int>{1, 4, 10, 20, 100, 1000}
                                               : std::vector<int>{1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 100, 300, 1000};
  Curve passed{
      "deform_passed", "particle", "share of particles that a wall went over without touching them", "", {}, ""};
  Curve pushed{"deform_pushed", "particle", "share of particles pushed that no wall met", "", {}, ""};
  Curve place{"deform_place",
              "particle",
              "distance from where a particle that goes with the wall from the touch on would be, mean",
              "of the way",
              {},
              ""};
  Curve way{"deform_way", "edge", "share of its way that the lattice did not make", "", {}, ""};
  for (const dsw_deform_method method : {DSW_DEFORM_END_STATE, DSW_DEFORM_SWEPT}) {
    for (const int n : steps) {
      const Bent bent = bend_particles(lattice, method, n);
      Point point;
      point.method = method == DSW_DEFORM_SWEPT ? "swept" : "end state";
      point.setting = text("%.4g", kRadii / n);
      point.unit = "radii";
      point.seconds = bent.seconds / static_cast<double>(lattice.particles.size());
      point.note = text(
          "%d deformations; the lattice made %.4g of its way, %zu particles wait for a wall that is held; %zu lost", n,
          bent.way, bent.waiting, bent.lost);
      point.error = share(bent.passed, bent.met);
      point.count = bent.met;
      passed.points.push_back(point);
      point.error = share(bent.pushed, bent.unmet);
      point.count = bent.unmet;
      pushed.points.push_back(point);

      if (!bent.place.values.empty()) {
        point.error = bent.place.mean();
        point.count = bent.place.values.size();
        point.note = text("%d deformations; %s", n, bent.place.spread().c_str());
        place.points.push_back(point);
      }
      if (method == DSW_DEFORM_SWEPT) {
        const Errors whole = whole_steps(lattice, n);
        Point rule = point;
        rule.method = "whole steps, as 2.0";
        rule.error = whole.mean();
        rule.count = whole.values.size();
        rule.note = text("%d deformations; %s; not run: computed from the exact times", n, whole.spread().c_str());
        place.points.push_back(rule);
      }

      const Bent with_edges = bend_edges(lattice, options.seed, method, n, &point.count);
      point.seconds = with_edges.seconds / static_cast<double>(point.count);
      point.error = std::max(0.0, 1 - with_edges.way);
      point.note = text("%d deformations; %zu edges not free", n, with_edges.not_free);
      if (bent.lost + with_edges.not_free > 0) {  // the sentences below say that neither happens
        throw std::runtime_error(text("%s in %d deformations: %zu particles lost, %zu edges not free",
                                      point.method.c_str(), n, bent.lost, with_edges.not_free));
      }
      way.points.push_back(point);
    }
  }
  const auto half =
      std::find_if(passed.points.begin(), passed.points.end(), [](const Point& p) { return p.setting == "0.5"; });
  passed.advice =
      text("Take swept where nothing may pass: it lets nothing pass ") + in_words(cheapest_right(passed, "swept")) +
      "; end state lets nothing pass " + in_words(cheapest_right(passed, "end state")) +
      text(", and %.2g of what is met at half a cell radius a step, for %.2g us.", half->error, 1e6 * half->seconds);
  pushed.advice = text(
      "Neither method pushes for nothing where steps are short; in one step of %g radii end state pushes %.2g of the "
      "particles that nothing "
      "met, swept %.2g.",
      kRadii, pushed.points.front().error, pushed.points[steps.size()].error);
  const auto error_of = [&](const char* method, const std::string& setting) {
    for (const Point& p : place.points) {
      if (p.method == method && p.setting == setting) return p.error;
    }
    return 1.0;
  };
  const std::string one_step = text("%.4g", kRadii);
  place.advice = text(
      "A wall pushes by the way that is left to it after the touch: in one step of %g radii particles come to lie %.2g "
      "of "
      "the way off, and %.2g where they are pushed by the whole step.",
      kRadii, error_of("swept", one_step), error_of("whole steps, as 2.0", one_step));
  passed.write(options.out);
  place.write(options.out);
  pushed.write(options.out);
  const auto made = [&](std::size_t i) { return 1 - way.points[i].error; };
  way.advice = text(
      "Take swept where edges lie in the way: in one step of %g radii the lattice makes %.3g of its way (end state "
      "%.2g, and %.2g in steps of %s): "
      "end state goes no further than where no edge is met. Edges are free after either.",
      kRadii, made(steps.size()), made(0), made(steps.size() - 1), way.points.back().setting.c_str());
  way.write(options.out);
}

}  // namespace dsw::curves
