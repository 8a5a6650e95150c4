#include "wall_pushes.h"

#include "plane_ground.h"
#include "rounds.h"
#include "space_ground.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

constexpr double kEpsilon = 0x1p-52;

double length(const Vec& a) { return std::hypot(std::hypot(a[0], a[1]), a[2]); }

double distance(const Vec& a, const Vec& b) { return length({a[0] - b[0], a[1] - b[1], a[2] - b[2]}); }

class Pusher {
 public:
  Pusher(Ground& ground, Rng& rng, PushReport& report)
      : ground_(ground), dimension_(ground.arena().dimension), rng_(rng), report_(report) {}

  void run(int count);

 private:
  struct Body {
    dsw_body_id id;
    bool rigid;
    BodyState state;
  };
  struct Particle {
    dsw_particle_id id;
    Vec at;
  };

  void settle();
  void push();
  bool read();
  bool deform(size_t vertex, const Vec& to, dsw_deform_report* report);
  void judge(const dsw_wall_contact& contact, const Vec& way, const std::vector<Body>& bodies,
             const std::vector<Particle>& particles);
  double gap_of(const Body& body, const dsw_wall_contact& contact, double margin) const;
  double gap_of(const Particle& particle, double margin) const;
  void wrong(const std::string& text) {
    ++report_.wrong;
    report_.faults.fault(SweepReport::kWrong, text);
  }

  Ground& ground_;
  const size_t dimension_;
  Rng& rng_;
  PushReport& report_;
  ScenePtr scene_;
  std::vector<Body> bodies_;
  std::vector<Particle> particles_;
  std::vector<Vec> now_;
  std::vector<double> arrays_[2];  // what the library reads, and the next one
};

void Pusher::settle() {
  for (int i = 0; i < 3; ++i) {
    const auto level = static_cast<dsw_level>(1 + rng_.below(dimension_ == 3 ? 4u : 3u));
    ::dsw::oracle::Bodies source(ground_.arena(), ground_.places(), rng_, level);
    for (int tries = 0; tries < 10; ++tries) {
      Body body{{0, 0}, rng_.chance(0.5), {}};
      if (create_body(scene_.get(), source.next(), level, body.rigid ? DSW_BODY_RIGID : 0, {}, &body.id) !=
          DSW_STATUS_OK) {
        continue;
      }
      bodies_.push_back(body);
      break;
    }
  }
  for (int i = 0; i < 3; ++i) {
    Particle particle{{0, 0}, ground_.places().start()};
    if (dsw_particle_create(scene_.get(), particle.at.data(), {0, 0}, &particle.id) == DSW_STATUS_OK) {
      particles_.push_back(particle);
    }
  }
}

bool Pusher::read() {
  for (Body& body : bodies_) {
    const std::string fault = read_body(scene_.get(), body.id, body.state);
    if (!fault.empty()) wrong(fault);
  }
  for (Particle& particle : particles_) {
    particle.at = {0, 0, 0};
    if (dsw_particle_get_position(scene_.get(), particle.id, particle.at.data(), nullptr) != DSW_STATUS_OK) {
      wrong("a particle is gone");
    }
  }
  return report_.wrong == 0;
}

bool Pusher::deform(size_t vertex, const Vec& to, dsw_deform_report* report) {
  std::swap(arrays_[0], arrays_[1]);
  std::vector<double>& next = arrays_[0];
  next.clear();
  for (const Vec& p : now_) next.insert(next.end(), p.begin(), p.begin() + static_cast<ptrdiff_t>(dimension_));
  std::copy_n(to.begin(), dimension_, &next[dimension_ * vertex]);
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.most_halvings = 1;
  if (dsw_environment_deform(ground_.environment(), next.data(), now_.size(), &options, report) != DSW_STATUS_OK) {
    wrong(dsw_last_error_message());
    return false;
  }
  std::copy_n(&next[dimension_ * vertex], dimension_, now_[vertex].begin());
  return read();
}

/// The least gap to a wall at the corners of what has touched; infinite if there is no row within the margin.
double Pusher::gap_of(const Body& body, const dsw_wall_contact& contact, double margin) const {
  dsw_near_options options = defaults(dsw_near_options_init);
  options.margin = margin;
  const dsw_near_row* rows = nullptr;
  size_t count = 0;
  if (dsw_body_find_near_rows(scene_.get(), body.id, &options, &count) != DSW_STATUS_OK ||
      dsw_body_get_near_rows(scene_.get(), body.id, &rows, &count) != DSW_STATUS_OK) {
    return -1;
  }
  double gap = INFINITY;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t(&at)[3] = rows[i].obstacle_vertices;
    const auto is_at = [&](dsw_vertex_id v) { return v.generation != 0 && std::find(at, at + 3, v.index) != at + 3; };
    if (rows[i].body.generation != 0) continue;
    if (is_at(contact.moving) || is_at(contact.others[0]) || is_at(contact.others[1])) gap = std::min(gap, rows[i].gap);
  }
  return gap;
}

double Pusher::gap_of(const Particle& particle, double margin) const {
  dsw_nearest nearest;
  const dsw_status status =
      dsw_environment_find_nearest(ground_.environment(), particle.at.data(), {0, 0}, margin, &nearest);
  return status == DSW_STATUS_OK ? nearest.distance : -1;
}

void Pusher::judge(const dsw_wall_contact& contact, const Vec& way, const std::vector<Body>& bodies,
                   const std::vector<Particle>& particles) {
  const double step = length(way);
  double gap = 0, largest = 0, moved = 0;
  bool rigid = false, is_point = false;
  const auto grow = [&](const Vec& p) {
    for (const double x : p) largest = std::max(largest, std::fabs(x));
  };
  for (const Vec& p : now_) grow(p);
  const double margin = 2 * step + 0x1p-40 * largest;
  if (contact.particle.generation != 0) {
    for (size_t i = 0; i < particles_.size(); ++i) {
      if (particles_[i].id.index != contact.particle.index) continue;
      moved = distance(particles_[i].at, particles[i].at);
      gap = gap_of(particles_[i], margin);
    }
    is_point = true;
  } else {
    for (size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].id.index != contact.body.index) continue;
      gap = gap_of(bodies_[i], contact, margin);
      rigid = bodies_[i].rigid;
      const std::vector<Vec>&at = bodies_[i].state.at, &before = bodies[i].state.at;
      for (size_t v = 0; v < at.size(); ++v) {
        grow(at[v]);
        moved = std::max(moved, distance(at[v], before[v]));
      }
    }
  }
  // Where cells are folded over, what is near may lie beyond a fold.
  if (dsw_environment_check(ground_.environment(), nullptr) != DSW_STATUS_OK) return;
  // Units in the last place of the least numbers are all of them.
  if (largest < 0x1p-1000) return;
  // A wall that slides along something goes on without it. What is free after so short a way was in the wall's way by no
  // more: by 8 times the room that a push leaves, and this room.
  const double unit = kEpsilon * largest, room = 0x1p-31 * step + 2 * unit;
  if (moved <= 9 * room + 2 * unit) {
    ++report_.slides;
    return;
  }
  if (gap < 0) return wrong(dsw_last_error_message());
  ++report_.pushes;
  report_.rigid += rigid ? 1 : 0;
  report_.points += is_point ? 1 : 0;
  const double left = std::max(0.0, gap - 8 * unit) / step;
  report_.largest = std::max(report_.largest, left);
  if (left <= 1e-9) return;
  ++report_.wide;
  report_.faults.fault(SweepReport::kWrong, "push " + std::to_string(report_.pushes) + ": a gap of " + number(gap) +
                                                " is left after a step of " + number(step) + (rigid ? ", rigid" : ""));
}

/// A vertex of a wall goes towards something, and then back.
void Pusher::push() {
  Vec at;
  const size_t choice = rng_.below(bodies_.size() + particles_.size());
  dsw_volume_id volume;
  if (choice < bodies_.size()) {
    const BodyState& s = bodies_[choice].state;
    const size_t v = rng_.below(s.at.size());
    if (s.vertices[v].generation == 0) return;
    at = s.at[v];
    volume = s.volumes[v];
  } else {
    const Particle& particle = particles_[choice - bodies_.size()];
    at = particle.at;
    if (dsw_particle_get_position(scene_.get(), particle.id, nullptr, &volume) != DSW_STATUS_OK) return;
  }
  const auto vertex = static_cast<size_t>(ground_.corner(static_cast<int>(volume.index), rng_));
  const double shares[] = {0.3, 0.7, 1.1, 1.5};
  const double share = shares[rng_.below(4u)];
  const Vec from = now_[vertex];
  Vec to = from;
  for (size_t k = 0; k < dimension_; ++k) to[k] += share * (at[k] - from[k]) * rng_.range(0.8, 1.2);
  if (!finite(to)) return;
  const std::vector<Body> bodies = bodies_;
  const std::vector<Particle> particles = particles_;
  dsw_deform_report report;
  if (!deform(vertex, to, &report)) return;
  const dsw_wall_contact* contacts = nullptr;
  size_t count = 0;
  dsw_environment_get_wall_contacts(ground_.environment(), &contacts, &count);
  if (report.outcome == DSW_DEFORM_DONE && report.steps == 1 && count != 0) {
    const Vec way = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    judge(contacts[count - 1], way, bodies, particles);
  } else if (report.outcome == DSW_DEFORM_HELD && report.steps == 1) {
    ++report_.held;
    for (size_t i = 0; i < bodies.size(); ++i) report_.moved_in_vain += bodies_[i].state.at != bodies[i].state.at;
    for (size_t i = 0; i < particles.size(); ++i) report_.moved_in_vain += particles_[i].at != particles[i].at;
  }
  if (!deform(vertex, from, &report)) return;
}

void Pusher::run(int count) {
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  if (dsw_scene_create(ground_.environment(), &desc, &scene) != DSW_STATUS_OK) return wrong("no scene");
  scene_.reset(scene);
  now_ = ground_.points();
  settle();
  if (bodies_.empty() && particles_.empty()) return;
  for (int i = 0; i < count && read(); ++i) push();
}

}  // namespace

void push_on_ground(Ground& ground, Rng& rng, PushReport& report) { Pusher(ground, rng, report).run(12); }

void run_wall_pushes(const DeformRunOptions& options, PushReport& report) {
  const auto in_space = [&](const SweepTurn& turn, uint64_t seed) {
    Rng rng(seed);
    const std::unique_ptr<Ground> ground = space_ground_of(turn, seed, rng, report.faults);
    if (ground != nullptr) push_on_ground(*ground, rng, report);
  };
  const auto in_plane = [&](const plane::Turn& turn, uint64_t seed) {
    Rng rng(seed);
    std::string fault;
    const std::unique_ptr<Ground> ground = plane_ground_of(turn, seed, rng, report.faults, fault);
    if (ground != nullptr) return push_on_ground(*ground, rng, report);
    report.wrong += fault.empty() ? 0 : 1;
  };
  const std::vector<SweepTurn> space_turns = sweep_turns(options.only);
  const std::vector<plane::Turn> plane_turns = plane::turns(options.only);
  if (options.scene_seed != 0) {
    for (const SweepTurn& turn : space_turns) in_space(turn, options.scene_seed);
    for (const plane::Turn& turn : plane_turns) in_plane(turn, options.scene_seed);
    return;
  }
  const auto done = [&] { return report.pushes; };
  run_rounds(space_turns, Rng(options.seed << 20), (options.steps + 1) / 2, done, in_space);
  run_rounds(plane_turns, Rng(options.seed << 20), options.steps, done, in_plane);
}

std::string to_json(const PushReport& r) {
  char number[40];
  std::snprintf(number, sizeof number, "%.17g", r.largest);
  std::string text = std::string("{\n  \"walls.gap_left_over_step\": ") + number;
  const std::pair<const char*, uint64_t> figures[] = {
      {"walls.gaps_left", r.wide}, {"walls.pushes", r.pushes}, {"walls.rigid_pushes", r.rigid},
      {"walls.slides", r.slides},  {"walls.held", r.held},     {"walls.moved_in_vain", r.moved_in_vain}};
  for (const auto& [key, value] : figures) text += std::string(",\n  \"") + key + "\": " + std::to_string(value);
  return text + "\n}\n";
}

}  // namespace dsw::oracle
