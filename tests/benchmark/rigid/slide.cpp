// Moves that slide as a whole, beside those that stop: where they end, in rational arithmetic, how much nearer, and what they cost.
#include <cmath>
#include <stdexcept>

#include "../timing.h"
#include "judge.h"
#include "parts.h"
#include "response/rigid_move.h"
#include "room.h"

namespace dsw::rigid {

namespace {

/** The root of the mean square of the distances of vertices from their targets. */
double distance(const std::vector<Point>& places, const std::vector<Point>& targets) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) sum += dot(places[i] - targets[i], places[i] - targets[i]);
  return std::sqrt(sum / static_cast<double>(places.size()));
}

struct Slides {
  std::size_t stops = 0, not_free = 0, worse = 0, bent = 0, arrived = 0;
  std::vector<double> left, contacts, stop_ns, slide_ns;
};

template <int D>
void slide(const Room& room, const Case& c, const Figure& others, Slides& slides) {
  dsw_body_id body{};
  dsw_move_report report{};
  const auto make = [&](bool is_sliding) {
    if (!add_body(room.scene(), c.body, 0, body)) throw std::runtime_error("a body has no room where it was");
    dsw_move_options options;
    dsw_move_options_init(&options, sizeof options);
    options.flags = is_sliding ? DSW_MOVE_SLIDE_WHOLE : 0;
    const double ns =
        bench::cpu_time_ns([&] { check(dsw_body_move_rigid(room.scene(), body, &c.motion, &options, &report)); });
    const std::vector<Point> places = room.places(body);
    check(dsw_body_destroy(room.scene(), body));
    return std::pair(places, ns);
  };
  const auto [stopped, stop_ns] = make(false);
  if (report.fraction == 1) return;
  const auto [slid, slide_ns] = make(true);
  const RigidMotion<D> whole = RigidMove<D>(c.motion.rotation, c.motion.centre, c.motion.translation).part(1);
  std::vector<Point> targets(stopped.size());
  double size = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    whole.place(c.body.points[i].data(), targets[i].data());
    for (const double x : slid[i]) size = std::max(size, std::fabs(x));
  }
  ++slides.stops;
  slides.not_free += is_free(D, c.body, slid, room.walls(), true) && is_free(D, c.body, slid, others, false) ? 0 : 1;
  const double before = distance(stopped, targets), after = distance(slid, targets);
  slides.worse += after > before ? 1 : 0;
  slides.arrived += after <= 0x1p-40 * size ? 1 : 0;
  slides.left.push_back(after / before);
  slides.contacts.push_back(report.contact_count);
  slides.stop_ns.push_back(stop_ns);
  slides.slide_ns.push_back(slide_ns);
  bool is_bent = false;
  for (std::size_t i = 0; i < slid.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      is_bent |= std::fabs(length(slid[i] - slid[k]) - length(c.body.points[i] - c.body.points[k])) > 0x1p-44 * size;
    }
  }
  slides.bent += is_bent ? 1 : 0;
}

}  // namespace

bool run_slides(const Options& options, Report& report) {
  Slides slides;
  for (std::size_t i = 0; i < options.moves / 4; ++i) {
    Random random(options.seed * 2000003 + i);
    const int dimension = i % 3 == 0 ? 2 : 3;
    Room room(dimension, 0.06, random);
    const Case c = draw_case(room, random);
    dsw_body_id body{};
    if (!room.add(c.body, 0, body)) continue;
    Figure others;
    for (const Figure& other : c.others) {
      dsw_body_id id{};
      if (room.add(other, 0, id)) others.add(other);
    }
    check(dsw_body_destroy(room.scene(), body));
    if (dimension == 2) {
      slide<2>(room, c, others, slides);
    } else {
      slide<3>(room, c, others, slides);
    }
  }
  const auto set = [&](const char* name, double value) { report.set(std::string("rigid.slide.") + name, value); };
  set("stops", static_cast<double>(slides.stops));
  set("not_free", static_cast<double>(slides.not_free));
  set("worse", static_cast<double>(slides.worse));
  set("bent", static_cast<double>(slides.bent));
  set("arrived", static_cast<double>(slides.arrived));
  set("left_over_stop_median", bench::median(slides.left));
  set("left_over_stop_p90", bench::quantile(slides.left, 0.9));
  set("contacts_median", bench::median(slides.contacts));
  set("us_over_stop", bench::median_ratio(slides.slide_ns, slides.stop_ns));
  return slides.not_free + slides.worse + slides.bent == 0;
}

}  // namespace dsw::rigid
