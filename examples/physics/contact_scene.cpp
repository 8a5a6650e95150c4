#include "contact_scene.h"

#include <algorithm>
#include <cmath>

#include "channel.h"
#include "curve.h"
#include "verify.h"

namespace physics {
namespace {

constexpr int kBarLinks = 8;
constexpr double kLink = 0.1, kPost = 0.4, kHeight = 1.2;
constexpr int kRounds = 30;

Channel standing_posts() {
  Channel channel;
  channel.cubes = {6, 3, 5};
  channel.scale = kPost;
  channel.obstacles = {{1, 1, 0}, {3, 1, 0}, {4, 1, 0}};
  return channel;
}

// Links of kLink, every third of them shorter by the aspect ratio.
std::vector<double> links(double aspect) {
  std::vector<double> lengths(kBarLinks, kLink);
  for (std::size_t i = 1; i < lengths.size(); i += 3) {
    lengths[i] /= aspect;
  }
  return lengths;
}

Positions straight(const Vector3& from, const Vector3& along, double aspect) {
  Positions line = {from};
  for (const double length : links(aspect)) {
    line.push_back(line.back() + length * along);
  }
  return line;
}

// Along x, up, and back over itself.
Positions folded(const Vector3& from, double aspect, double rise) {
  Positions line = straight(from, Vector3::UnitX(), aspect);
  const double end = line.back().x();
  line.push_back(line.back() + Vector3(0.03, 0.01, rise));
  for (const double length : links(aspect)) {
    const Vector3 last = line.back();
    line.push_back(Vector3(last.x() - length, last.y() - 0.02 * length / kLink, from.z() + rise));
  }
  line.back().x() = std::min(line.back().x(), end);
  return line;
}

bool cross(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, double* above) {
  const auto turn = [](const Vector3& u, const Vector3& v) { return u.x() * v.y() - u.y() * v.x(); };
  const Vector3 u = b - a, v = d - c;
  const double whole = turn(u, v);
  if (std::abs(whole) < 1e-9 * kLink * kLink) {
    return false;
  }
  const double s = turn(c - a, v) / whole, t = turn(c - a, u) / whole;
  *above = (a + s * u).z() - (c + t * v).z();
  return s > 0.01 && s < 0.99 && t > 0.01 && t < 0.99;
}

}  // namespace

ContactWorld::ContactWorld(const ContactCase& asked) : asked_(asked) {
  const ContactScene scene = asked.scene;
  const bool all = scene == ContactScene::kAll;
  rigid_ = scene == ContactScene::kRigid;
  deforms_ = scene == ContactScene::kWalls || scene == ContactScene::kEndState || rigid_ || all;
  two_ = scene == ContactScene::kBodies || scene == ContactScene::kBodiesTogether || all;
  self_ = scene == ContactScene::kSelf || all;
  together_ = scene == ContactScene::kBodiesTogether || all;
  radius_ = scene == ContactScene::kThick || all ? 0.01 : 0;
  gravity_ = 0.004 * kLink / (asked.dt * asked.dt);
  environment_ = make_channel(standing_posts());
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = deforms_ ? DSW_FEATURE_DEFORMING : 0;
  desc.features |= two_ || self_ ? DSW_FEATURE_BODY_CONTACTS : 0;
  dsw_scene* made = nullptr;
  check(dsw_scene_create(environment_.get(), &desc, &made), "creating a scene");
  scene_.reset(made);
  const double start = kPost + radius_ + 2e-4;
  std::uint32_t flags = rigid_ ? DSW_BODY_RIGID : 0;
  flags |= self_ ? DSW_BODY_SELF_CONTACTS : 0;
  std::vector<double> masses(kBarLinks + 1, 1);
  if (scene == ContactScene::kSelf) {
    const Positions line = folded(Vector3(0.5, 0.6, start), asked.aspect, 0.02);
    masses.resize(line.size(), asked.mass_ratio);
    add_line(line, masses, flags);
  } else {
    masses.front() = scene == ContactScene::kPosts || scene == ContactScene::kThick ? asked.mass_ratio : 1;
    const bool on_walls = scene == ContactScene::kWalls || scene == ContactScene::kEndState || rigid_;
    add_line(straight(Vector3(0.5, 0.6, start), Vector3::UnitX(), asked.aspect),
             on_walls ? std::vector<double>(kBarLinks + 1, asked.mass_ratio) : masses, flags);
  }
  if (two_) {
    add_line(straight(Vector3(0.63, 0.35, start + 2 * radius_ + 2e-4), Vector3::UnitY(), asked.aspect),
             std::vector<double>(kBarLinks + 1, asked.mass_ratio), flags);
  }
  this->start();
}

ContactWorld::~ContactWorld() {
  scene_.reset();
  environment_.reset();
}

void ContactWorld::add_line(const Positions& line, const std::vector<double>& masses, std::uint32_t flags) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
    edges.insert(edges.end(), {i, i + 1});
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.positions = line.front().data();
  desc.stride_bytes = sizeof(Vector3);
  desc.vertex_count = line.size();
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  desc.radius = radius_;
  Part part = {{0, 0}, points_.size(), line.size()};
  check(dsw_body_create(scene_.get(), &desc, &part.id), "creating a body");
  for (std::size_t i = 0; i < line.size(); ++i) {
    points_.set(part.first + i, line[i], masses[i]);
    all_mass_ += masses[i];
  }
  const double k = asked_.stiffness / (asked_.dt * asked_.dt);
  Springs rod = make_rod(line, k * kLink, k * kLink);
  // Links are as stiff however short they are: the aspect ratio is that of the shape, not of the material.
  for (DistanceSpring& spring : rod.distances) {
    spring.a += part.first;
    spring.b += part.first;
    spring.stiffness = k;
  }
  for (AngularSpring& spring : rod.angles) {
    spring.a += part.first;
    spring.b += part.first;
    spring.c += part.first;
    spring.stiffness = 0.01 * k * std::pow(spring.least / kPressedShare, 2);
  }
  springs_.distances.insert(springs_.distances.end(), rod.distances.begin(), rod.distances.end());
  springs_.angles.insert(springs_.angles.end(), rod.angles.begin(), rod.angles.end());
  parts_.push_back(part);
}

void ContactWorld::start() {
  if (deforms_) {
    WallOptions options;
    options.stretching = options.anchor = asked_.stiffness / (asked_.dt * asked_.dt);
    options.integrator.method = asked_.integrator;
    options.deform.most_halvings = 3;
    const bool end_state = asked_.scene == ContactScene::kEndState || asked_.scene == ContactScene::kAll;
    options.deform.method = end_state ? DSW_DEFORM_END_STATE : DSW_DEFORM_SWEPT;
    walls_ = std::make_unique<Walls>(scene_.get(), options);
  }
  const Vector3 speed = kLink / asked_.dt * Vector3(0.005, 0.002, -0.01);
  points_.velocity.assign(points_.size(), speed);
  speed_ = speed;
  spin_ = Vector3(0, 0, 0.02 / asked_.dt);
  put_in_ = kinetic() + all_mass_ * gravity_ * kHeight;
}

double ContactWorld::kinetic() const {
  if (!rigid_) {
    return kinetic_energy_of(points_);
  }
  const double inertia = all_mass_ * std::pow(kBarLinks * kLink, 2) / 12;
  return 0.5 * all_mass_ * speed_.squaredNorm() + 0.5 * inertia * spin_.squaredNorm();
}

const ContactWorld::Part* ContactWorld::part_of(dsw_body_id id) const {
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [id](const Part& part) { return part.id.index == id.index; });
  return found == parts_.end() ? nullptr : &*found;
}

void ContactWorld::read() {
  for (const Part& part : parts_) {
    std::size_t slots = 0;
    check(dsw_body_get_positions(scene_.get(), part.id, points_.position[part.first].data(), part.count,
                                 sizeof(Vector3), nullptr, &slots),
          "reading positions");
  }
}

// Refused targets leave all at rest where it is.
void ContactWorld::move(const Positions& targets, Outcome* outcome) {
  dsw_status status = DSW_STATUS_OK;
  std::vector<dsw_move_report> reports(parts_.size());
  if (together_) {
    std::vector<dsw_body_id> ids;
    for (const Part& part : parts_) {
      ids.push_back(part.id);
    }
    dsw_together_options options;
    dsw_together_options_init(&options, sizeof options);
    options.stop = DSW_TOGETHER_STOP_FEATURE;
    // The rows of thick rods are about those that stop.
    options.response = radius_ > 0 ? DSW_TOGETHER_RESPONSE_STOP : DSW_TOGETHER_RESPONSE_SLIDE;
    status = dsw_scene_move_together(scene_.get(), ids.data(), ids.size(), targets.front().data(), targets.size(),
                                     sizeof(Vector3), &options, reports.data());
  } else {
    dsw_move_options options;
    dsw_move_options_init(&options, sizeof options);
    options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
    for (std::size_t i = 0; i < parts_.size() && status == DSW_STATUS_OK; ++i) {
      status = dsw_body_move(scene_.get(), parts_[i].id, targets[parts_[i].first].data(), parts_[i].count,
                             sizeof(Vector3), &options, &reports[i]);
    }
  }
  if (status == DSW_STATUS_NON_FINITE) {
    outcome->message = dsw_last_error_message();
    ++outcome->refused;
    points_.rest();
  } else {
    check(status, "moving bodies");
    for (const dsw_move_report& report : reports) {
      outcome->contacts += report.contact_count;
    }
  }
  read();
}

void ContactWorld::move_rigid(double dt, Outcome* outcome) {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points_.position) {
    centre += p / static_cast<double>(points_.size());
  }
  const double angle = spin_.norm() * dt;
  dsw_rigid_motion motion = {};
  const Vector3 axis = angle > 0 ? Vector3(spin_.normalized() * std::sin(angle / 2)) : Vector3::Zero();
  std::copy_n(axis.data(), 3, motion.rotation);
  motion.rotation[3] = std::cos(angle / 2);
  const Vector3 way = dt * speed_;
  std::copy_n(centre.data(), 3, motion.centre);
  std::copy_n(way.data(), 3, motion.translation);
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.flags = DSW_MOVE_SLIDE_WHOLE;
  dsw_move_report report;
  const dsw_status status = dsw_body_move_rigid(scene_.get(), parts_[0].id, &motion, &options, &report);
  if (status == DSW_STATUS_NON_FINITE || status == DSW_STATUS_OUT_OF_RANGE) {
    ++outcome->refused;
    speed_.setZero();
    spin_.setZero();
  } else {
    check(status, "moving a bar");
    outcome->contacts += report.contact_count;
  }
  read();
}

// The other side of a contact of two bodies, or of one with itself, has negative shares.
void ContactWorld::add_partner(const dsw_contact_partner& partner, Touch* touch) const {
  const Part* part = part_of(partner.body);
  if (partner.body.generation == 0 || part == nullptr) {
    return;
  }
  dsw_body_vertex_id ends[2] = {partner.vertex, partner.vertex};
  if (partner.edge.generation != 0) {
    check(dsw_body_get_edge_ends(scene_.get(), partner.body, partner.edge, ends), "reading an edge");
  }
  const std::size_t a = part->first + ends[0].index, b = part->first + ends[1].index;
  const Vector3 u = points_.position[b] - points_.position[a];
  const double length = u.squaredNorm();
  const double t = length > 0 ? std::clamp((touch->at - points_.position[a]).dot(u) / length, 0.0, 1.0) : 0;
  touch->point[touch->count] = a;
  touch->share[touch->count++] = -(1 - t);
  if (b != a) {
    touch->point[touch->count] = b;
    touch->share[touch->count++] = -t;
  }
}

void ContactWorld::read_all_touches() {
  touches_.clear();
  Friction friction;
  friction.otherwise = asked_.friction;
  for (const Part& part : parts_) {
    Points own;  // by the body's indices
    for (std::size_t i = 0; i < part.count; ++i) {
      own.set(i, points_.position[part.first + i], points_.mass[part.first + i]);
    }
    std::vector<Touch> touches = read_touches(scene_.get(), part.id, own, friction);
    const dsw_contact_partner* partners = nullptr;
    std::size_t count = 0;
    if (two_ || self_) {
      check(dsw_body_get_contact_partners(scene_.get(), part.id, &partners, &count), "reading partners");
    }
    for (Touch& touch : touches) {
      std::for_each(touch.point, touch.point + touch.count, [&](std::size_t& i) { i += part.first; });
      if (touch.contact < count) {
        add_partner(partners[touch.contact], &touch);
      }
      touches_.push_back(touch);
    }
  }
}

// Impulses on the bar as a whole, one contact after the other.
void ContactWorld::answer_rigid() {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points_.position) {
    centre += p / static_cast<double>(points_.size());
  }
  const double inertia = all_mass_ * std::pow(kBarLinks * kLink, 2) / 12;
  for (int round = 0; round < kRounds; ++round) {
    for (Touch& touch : touches_) {
      const Vector3 arm = touch.at - centre, turn = arm.cross(touch.normal);
      const Vector3 velocity = speed_ + spin_.cross(arm);
      const double w = 1 / all_mass_ + turn.squaredNorm() / inertia;
      const double sum = std::max(0.0, touch.impulse.dot(touch.normal) - velocity.dot(touch.normal) / w);
      const Vector3 more = (sum - touch.impulse.dot(touch.normal)) * touch.normal;
      touch.impulse += more;
      speed_ += more / all_mass_;
      spin_ += arm.cross(more) / inertia;
    }
  }
}

void ContactWorld::step_walls(double dt, ContactRow* row) {
  dsw_deform_report report = {};
  walls_->take_reactions(touches_);
  row->outcome.refused += walls_->step(dt, &report) == DSW_STATUS_OK ? 0 : 1;
  row->outcome.contacts += report.contact_count;
  read();
}

void ContactWorld::step(ContactRow* row) {
  const Positions before = points_.position;
  const double start = processor_seconds(), dt = asked_.dt;
  if (rigid_) {
    speed_.z() -= dt * gravity_;
    move_rigid(dt, &row->outcome);
    read_all_touches();
    answer_rigid();
  } else {
    Load load;
    load.gravity = Vector3(0, 0, -gravity_);
    IntegratorOptions options;
    options.method = asked_.integrator;
    Points next;
    integrate(points_, springs_, load, dt, options, &next);
    points_.velocity = next.velocity;
    const Positions targets = next.position;
    if (!is_finite(next)) {
      ++row->outcome.refused;
      points_.rest();
    } else {
      move(targets, &row->outcome);
    }
    read_all_touches();
    resolve(0, kRounds, &touches_, &points_);
  }
  for (const Touch& touch : touches_) {
    const double most = all_mass_ * (gravity_ * dt + 0.02 * kLink / dt);
    row->largest_force = std::max(row->largest_force, touch.impulse.norm() / most);
    row->outcome.rubbing += (touch.impulse - touch.impulse.dot(touch.normal) * touch.normal).norm() > 0 ? 1 : 0;
  }
  if (walls_) {
    step_walls(dt, row);
  }
  row->outcome.seconds += processor_seconds() - start;
  ++row->outcome.steps;
  check_all(before, row);
}

// Pairs of links, one over the other in both steps, that have changed places. Links that went far can have gone round.
std::size_t ContactWorld::passed(const Positions& before) const {
  double farthest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    farthest = std::max(farthest, (points_.position[i] - before[i]).norm());
  }
  std::size_t count = 0;
  for (std::size_t s = 0; s < springs_.distances.size() && farthest < 0.2 * kLink; ++s) {
    for (std::size_t t = s + 2; t < springs_.distances.size(); ++t) {
      const DistanceSpring &a = springs_.distances[s], &b = springs_.distances[t];
      const bool is_one = parts_.size() < 2 || (a.a < parts_[1].first) == (b.a < parts_[1].first);
      if (is_one && !self_) {
        continue;  // a body that does not meet itself
      }
      double then = 0, now = 0;
      const bool crossed = cross(before[a.a], before[a.b], before[b.a], before[b.b], &then);
      count += crossed &&
                       cross(points_.position[a.a], points_.position[a.b], points_.position[b.a], points_.position[b.b],
                             &now) &&
                       then * now < 0 && std::abs(then) + std::abs(now) > 1e-12
                   ? 1
                   : 0;
    }
  }
  return count;
}

void ContactWorld::check_all(const Positions& before, ContactRow* row) {
  bool finite = is_finite(points_) && speed_.allFinite() && spin_.allFinite();
  for (const Part& part : parts_) {
    const Validation validation = verify(scene_.get(), part.id);
    finite = finite && validation.nonfinite == 0;
    row->outcome.not_free += validation.not_free;
    row->outcome.lost += validation.lost;
    if (radius_ > 0) {
      double gap = 0;
      check(dsw_body_find_least_gap(scene_.get(), part.id, radius_, &gap), "reading a gap");
      row->outcome.not_free += gap < -2 * radius_ * std::ldexp(1.0, -34) ? 1 : 0;
    }
  }
  row->outcome.not_free += two_ || self_ ? passed(before) : 0;
  row->outcome.nonfinite += finite && (walls_ == nullptr || is_finite(walls_->points)) ? 0 : 1;
  const double energy = kinetic() / put_in_;
  row->energy_largest = energy <= row->energy_largest ? row->energy_largest : energy;
  if (!rigid_) {
    row->largest_stretch = std::max(row->largest_stretch, springs_.largest_stretch(points_.position));
  }
}

}  // namespace physics
