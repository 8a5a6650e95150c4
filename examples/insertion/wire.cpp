#include "wire.h"

namespace insertion {
namespace {

class SpringWire : public Wire {
 public:
  SpringWire(physics::World* world, const physics::Route* route, const physics::CatheterOptions& options)
      : world_(world), catheter_(world, route, options) {}

  void step(double dt) override { catheter_.step(dt); }
  dsw_body_id id() const override { return catheter_.body().id(); }
  const physics::StepReport& report() const override { return world_->report(0); }
  double reached() const override { return catheter_.reached(); }
  std::size_t links() const override { return catheter_.links(); }
  double largest_stretch() const override { return catheter_.body().springs.largest_stretch(positions()); }
  std::vector<std::size_t> line() const override { return catheter_.line(); }
  const physics::Positions& positions() const override { return catheter_.body().points.position; }
  bool was_inserted(std::size_t vertex) const override { return catheter_.body().was_inserted(vertex); }
  std::vector<double> impulses(std::size_t contacts) const override {
    std::vector<double> impulse(contacts, 0);
    for (const physics::Touch& touch : catheter_.body().touches()) {
      impulse[touch.contact] = touch.impulse.norm();
    }
    return impulse;
  }

 private:
  physics::World* world_;
  physics::Catheter catheter_;
};

class RodWire : public Wire {
 public:
  RodWire(dsw_scene* scene, const physics::Route* route, const physics::RodCatheterOptions& options)
      : catheter_(scene, route, options) {}

  void step(double dt) override { catheter_.step(dt); }
  dsw_body_id id() const override { return catheter_.id(); }
  const physics::StepReport& report() const override { return catheter_.report(); }
  RodPart rod_part() const override {
    return {catheter_.rows_seconds(), catheter_.rod_seconds(), catheter_.rows().size(),
            catheter_.contact_report().pressing};
  }
  double reached() const override { return catheter_.reached(); }
  std::size_t links() const override { return catheter_.links(); }
  double largest_stretch() const override { return catheter_.rod().largest_stretch(); }
  std::vector<std::size_t> line() const override {
    std::vector<std::size_t> line;
    for (std::size_t i = catheter_.rod().size(); i-- > 0;) {
      line.push_back(i);
    }
    return line;
  }
  const physics::Positions& positions() const override { return catheter_.rod().shape.position; }
  bool was_inserted(std::size_t) const override { return false; }
  // Rows push, before the library moves anything; contacts only stop.
  std::vector<double> impulses(std::size_t contacts) const override { return std::vector<double>(contacts, 0); }

 private:
  physics::RodCatheter catheter_;
};

// Makes a rod as fast, as large and as heavy as the catheter of springs.
physics::RodCatheterOptions rod_of(const Options& options, const physics::CatheterOptions& made_of, double scale) {
  physics::RodCatheterOptions usual;
  usual.links = made_of.links;
  usual.link = made_of.link / scale;
  usual.speed = made_of.speed / scale;
  usual.feeding = made_of.feeding / scale;
  usual.rod.contact.friction = options.friction;
  usual.level = options.level;
  return scaled(usual, scale);
}

}  // namespace

std::unique_ptr<Wire> make_wire(const Options& options, const physics::CatheterOptions& made_of, physics::World* world,
                                const physics::Route* route) {
  if (options.rod) {
    const double scale = made_of.look_ahead / physics::CatheterOptions().look_ahead;
    return std::make_unique<RodWire>(world->scene(), route, rod_of(options, made_of, scale));
  }
  return std::make_unique<SpringWire>(world, route, made_of);
}

}  // namespace insertion
