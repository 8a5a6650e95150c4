#include "plane_run.h"

#include "check.h"
#include "plane_scenes.h"
#include "plane_truth.h"
#include "rounds.h"

#include <algorithm>
#include <cfloat>
#include <cstdio>

namespace dsw::oracle {
namespace {

using plane::Flight;
using plane::Side;
using plane::Vec;
using plane::World;

class Scene {
 public:
  Scene(const plane::Turn& turn, uint64_t seed, int& print_left, PlaneReport& report)
      : turn_(turn),
        seed_(seed),
        rng_(seed),
        world_(plane::make_world(turn, rng_)),
        report_(report),
        print_left_(print_left) {}

  void run(uint64_t casts) {
    environment_ = make_environment(turn_, world_, rng_);
    if (environment_ == nullptr) return turn_.may_be_refused() ? void() : wrong(dsw_last_error_message());
    std::vector<int> vertices;
    const std::string fault = plane::mark(world_, environment_.get(), {0.1, 0.1, 0}, rng_, vertices);
    if (!fault.empty()) return wrong(fault);
    dsw_scene* scene = nullptr;
    dsw_scene_desc desc = defaults(dsw_scene_desc_init);
    desc.features = rng_.chance(0.5) ? uint32_t{DSW_FEATURE_STATISTICS} : 0;
    if (dsw_scene_create(environment_.get(), &desc, &scene) != DSW_STATUS_OK) return wrong(dsw_last_error_message());
    const ScenePtr owner(scene);
    std::vector<dsw_particle_id> particles;
    for (uint64_t i = 0; i < casts; ++i) {
      const Vec p = place();
      const int cell = plane::locate(world_, p);
      if (cell == -2) return wrong("the mesh is no partition");
      check_locate(p, cell);
      if (particles.size() < 6) create_particle(scene, p, cell, particles);
      if (!particles.empty() && rng_.chance(0.6)) {
        check_move(scene, particles[rng_.below(particles.size())]);
      } else if (cell >= 0 && world_.cell_marked[static_cast<size_t>(cell)] == 0) {
        check_cast(p, target(p), cell);
      }
    }
  }

 private:
  void say(const std::string& text) {
    if (print_left_-- > 0)
      std::fprintf(stderr, "plane, %s scene seed %llu: %s\n", turn_.name().c_str(),
                   static_cast<unsigned long long>(seed_), text.c_str());
  }
  void wrong(const std::string& text) {
    ++report_.wrong;
    say(text);
  }
  static std::string text_of(const Vec& p) {
    char text[64];
    std::snprintf(text, sizeof text, "(%a, %a)", p[0], p[1]);
    return text;
  }

  /// With a bias to vertices, sides and lines through them.
  Vec place() {
    const Side& s = world_.sides[rng_.below(world_.sides.size())];
    const Vec &a = world_.points[static_cast<size_t>(s.a)], &b = world_.points[static_cast<size_t>(s.b)],
              &c = world_.points[rng_.below(world_.points.size())];
    const double t = rng_.chance(0.5) ? 0.25 * rng_.below(5u) : rng_.unit(), u = rng_.unit();
    switch (rng_.below(6u)) {
      case 0:
        return a;
      case 1:
        return mix(a, b, t);
      case 2:
        return mix(a, c, t);
      case 3: {
        Vec p = a;
        for (double& x : p) x = std::nextafter(x, rng_.chance(0.5) ? DBL_MAX : -DBL_MAX);
        return p;
      }
      default:
        return mix(mix(a, b, t), c, u);
    }
  }
  static Vec mix(const Vec& a, const Vec& b, double t) { return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; }

  Vec target(const Vec& p) {
    const Vec x = place();
    Vec q = x;
    switch (rng_.below(8u)) {
      case 0:  // through a place
        q = mix(p, x, 1 + rng_.below(3u));
        break;
      case 1:  // along an axis
        q = {p[0], x[1]};
        break;
      case 2:  // short
        q = mix(p, x, 0.1 * rng_.unit());
        break;
      case 3:
        if (rng_.chance(0.3)) q = {rng_.chance(0.5) ? 1e300 : -1e-300, rng_.chance(0.5) ? -1e300 : x[1]};
        break;
      case 4:
        q = rng_.chance(0.3) ? p : mix(p, x, -1);
        break;
      default:
        break;
    }
    return std::isfinite(q[0]) && std::isfinite(q[1]) ? q : x;
  }

  dsw_volume_id any_hint() {
    if (rng_.chance(0.4)) return {0, 0};
    return {rng_.below(world_.cells.size()), 1};
  }
  static dsw_volume_id id_of(int cell) {
    return cell < 0 ? dsw_volume_id{0, 0} : dsw_volume_id{static_cast<uint32_t>(cell), 1};
  }
  static bool same(dsw_volume_id a, dsw_volume_id b) { return a.index == b.index && a.generation == b.generation; }

  void check_locate(const Vec& p, int cell) {
    dsw_volume_id found;
    if (dsw_environment_locate(environment_.get(), p.data(), any_hint(), &found, nullptr) != DSW_STATUS_OK ||
        !same(found, id_of(cell))) {
      wrong("locate " + text_of(p));
    }
  }

  void create_particle(dsw_scene* scene, const Vec& p, int cell, std::vector<dsw_particle_id>& particles) {
    const dsw_status want = cell < 0                                             ? DSW_STATUS_OUTSIDE
                            : world_.cell_marked[static_cast<size_t>(cell)] != 0 ? DSW_STATUS_IMPASSABLE
                                                                                 : DSW_STATUS_OK;
    dsw_particle_id id;
    const dsw_status status = dsw_particle_create(scene, p.data(), any_hint(), &id);
    if (status != want) wrong("particle at " + text_of(p));
    if (status == DSW_STATUS_OK) particles.push_back(id);
  }

  /// What a report says of the flight to the target, but for where it ended.
  void compare(const Flight& truth, const dsw_flight& flight, const std::string& what) {
    report_.ties += truth.tie ? 1 : 0;
    if (truth.outcome == Flight::kBroken) return wrong("the mesh is no partition: " + what);
    if (truth.outcome == Flight::kReached) {
      if (flight.outcome != DSW_OUTCOME_REACHED || flight.time != 1) wrong("a contact that there is not: " + what);
      return;
    }
    ++report_.contacts;
    if (flight.outcome != DSW_OUTCOME_CONTACT) {
      ++report_.missed;
      return say("missed: " + what);
    }
    if (flight.time > truth.time) {
      ++report_.late;
      return say("late: " + what);
    }
    const Side& side = world_.sides[static_cast<size_t>(truth.side)];
    const int behind = side.cell[0] == truth.cells.back() ? side.cell[1] : side.cell[0];
    const bool right = flight.time == truth.time && flight.contact.wall.volume == static_cast<uint32_t>(side.cell[0]) &&
                       flight.contact.wall.local == static_cast<uint32_t>(side.local[0]) &&
                       same(flight.contact.behind, id_of(behind)) && flight.volumes_visited == truth.cells.size() &&
                       flight.position[2] == 0 && flight.contact.normal[2] == 0;
    if (!right) wrong("time, side or cells: " + what);
  }

  void check_cast(const Vec& p, const Vec& q, int cell) {
    const std::string what = "cast " + text_of(p) + " " + text_of(q);
    ++report_.casts;
    const Flight truth = plane::cast(world_, cell, p, q);
    dsw_flight flight;
    dsw_cast_options options = defaults(dsw_cast_options_init);
    const bool known = rng_.chance(0.5);
    if (known) options.flags |= uint32_t{DSW_CAST_START_KNOWN};
    const dsw_volume_id start = known ? id_of(cell) : any_hint();
    dsw_crossing crossings[400];
    size_t count = 0;
    const bool path = rng_.chance(0.3);
    const dsw_status status =
        path ? dsw_environment_cast_path(environment_.get(), start, p.data(), q.data(), &options, crossings, 400,
                                         &count, &flight)
             : dsw_environment_cast(environment_.get(), start, p.data(), q.data(), &options, &flight);
    if (status != DSW_STATUS_OK) return wrong(dsw_last_error_message());
    compare(truth, flight, what);
    if (!same(flight.volume, id_of(truth.cells.back()))) wrong("end: " + what);
    if (!path) return;
    if (count != truth.cells.size()) return wrong("crossings: " + what);
    for (size_t i = 0; i < count; ++i) {
      if (!same(crossings[i].volume, id_of(truth.cells[i])) || crossings[i].time != truth.times[i])
        return wrong("crossing: " + what);
    }
  }

  void check_move(dsw_scene* scene, dsw_particle_id particle) {
    Vec p, reached;
    dsw_volume_id volume;
    dsw_particle_get_position(scene, particle, p.data(), &volume);
    const int cell = static_cast<int>(volume.index);
    const Vec q = target(p);
    const std::string what = "move " + text_of(p) + " " + text_of(q);
    ++report_.casts;
    ++report_.moves;
    const Flight truth = plane::cast(world_, cell, p, q);
    dsw_flight flight;
    if (dsw_particle_move(scene, particle, q.data(), nullptr, &flight) != DSW_STATUS_OK)
      return wrong(dsw_last_error_message());
    compare(truth, flight, what);
    dsw_particle_get_position(scene, particle, reached.data(), &volume);
    const Flight done = plane::cast(world_, cell, p, reached);
    if (done.outcome != Flight::kReached) {
      ++report_.not_free_after;
      say("not free after: " + what);
    }
    if (!same(volume, id_of(done.cells.back())) || plane::locate(world_, reached) != done.cells.back())
      wrong("lost: " + what);
    if (truth.outcome == Flight::kReached && reached != q) wrong("not where it was to go: " + what);
  }

  const plane::Turn& turn_;
  uint64_t seed_;
  Rng rng_;
  World world_;
  PlaneReport& report_;
  int& print_left_;
  EnvironmentPtr environment_;
};

}  // namespace

void run_plane(const PlaneRunOptions& options, int print_most, PlaneReport& report) {
  const std::vector<plane::Turn> turns = plane::turns(options.only);
  // Sequences of neighbouring seeds share all scenes but one.
  run_rounds(
      turns, Rng(options.seed << 32), options.casts, [&] { return report.casts; },
      [&](const plane::Turn& turn, uint64_t seed) { Scene(turn, seed, print_most, report).run(40); });
}

std::string to_json(const PlaneReport& r) {
  std::string text;
  const auto add = [&](const std::vector<std::pair<const char*, double>>& figures) {
    for (const auto& [key, value] : figures) {
      char line[128];
      std::snprintf(line, sizeof line, "%s  \"plane.oracle.%s\": %.10g", text.empty() ? "{\n" : ",\n", key, value);
      text += line;
    }
  };
  const auto of = [](uint64_t count) { return static_cast<double>(count); };
  if (r.casts != 0) add({{"casts", of(r.casts)}, {"moves", of(r.moves)}});
  if (r.sweeps != 0) {
    add({{"sweeps", of(r.sweeps)},
         {"vertex_contacts", of(r.vertex_contacts)},
         {"inside_only", of(r.inside_only)},
         {"bodies", of(r.bodies)},
         {"twins", of(r.twins)},
         {"responses", of(r.responses)},
         {"edits", of(r.edits)},
         {"stuck", of(r.stuck)},
         {"time_error", r.time_error}});
  }
  add({{"contacts", of(r.contacts)},
       {"ties", of(r.ties)},
       {"missed", of(r.missed)},
       {"late", of(r.late)},
       {"not_free_after", of(r.not_free_after)},
       {"wrong", of(r.wrong)}});
  return text + "\n}\n";
}

}  // namespace dsw::oracle
