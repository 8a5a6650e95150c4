#include "insertion.h"

#include <algorithm>
#include <chrono>

namespace insertion {
namespace {

using physics::check;
using Clock = std::chrono::steady_clock;

constexpr double kPart = 0.97;      // of the way, that the tip is to make in all steps
constexpr double kSlow = 5;         // radii a second: a careful hand
constexpr double kUsualRadius = 2;  // mm, of the lumen that the numbers of CatheterOptions are for

std::uint32_t features_of(const Options& options) { return options.statistics ? DSW_FEATURE_STATISTICS : 0; }

}  // namespace

physics::CatheterOptions fit_catheter(const Options& options, double radius, double way) {
  const double scale = radius / kUsualRadius;
  physics::CatheterOptions usual;
  usual.links = options.vertices - 1;
  const double link =
      options.link > 0 ? options.link : std::min(3 * radius, 0.5 * way / static_cast<double>(usual.links));
  const double seconds = static_cast<double>(options.steps) * options.dt;
  const double whole_way = (kPart * way - link) / seconds, slow = kSlow * radius;
  usual.link = link / scale;
  usual.speed = (options.speed > 0 ? options.speed : options.slow ? slow : whole_way) / scale;
  usual.feeding = options.slow ? 2 * link * static_cast<double>(usual.links) / seconds / scale : 0;
  usual.body.integrator.method = options.integrator;
  usual.body.friction.otherwise = options.friction;
  usual.body.level = options.level;
  usual.body.contact_memory = options.contact_memory;
  if (!options.inserts) {
    usual.body.move.edge_response = DSW_RESPONSE_SLIDE;
    usual.body.move.noise_share = 0;
    usual.body.move.flags = DSW_MOVE_KEEP_WALLS;
  }
  return scaled(usual, scale);
}

Run::Run(const Options& options, const Vessel* vessel)
    : options_(options),
      made_of_(fit_catheter(options, vessel->radius(), vessel->route().length())),
      world_(vessel->environment(), features_of(options)) {
  start_recording();
  try {
    wire_ = make_wire(options_, made_of_, &world_, &vessel->route());
  } catch (const physics::LibraryError& error) {
    throw BadInput("a link of " + std::to_string(made_of_.link) +
                   " does not fit into the inlet; try a smaller --link (" + error.what() + ")");
  }
}

void Run::start_recording() {
  if (options_.record.empty()) {
    return;
  }
  dsw_recording_desc desc;
  dsw_recording_desc_init(&desc, sizeof desc);
  desc.path = options_.record.c_str();
  desc.flags = DSW_RECORDING_STATES;
  if (dsw_scene_start_recording(world_.scene(), &desc) != DSW_STATUS_OK) {
    throw BadInput(std::string("recording: ") + dsw_last_error_message());
  }
}

void Run::stop_recording() {
  if (dsw_scene_stop_recording(world_.scene()) != DSW_STATUS_OK) {
    throw BadInput("cannot write all of '" + options_.record + "'");
  }
}

void Run::count_cells(Step* step) {
  if (!options_.statistics) {
    return;
  }
  dsw_statistics statistics;
  statistics.struct_size = sizeof statistics;
  check(dsw_scene_get_statistics(world_.scene(), &statistics), "reading statistics");
  check(dsw_scene_reset_statistics(world_.scene()), "resetting statistics");
  step->volumes_visited = statistics.volumes_visited;
  step->orientation_tests = statistics.orientation_tests;
}

Step Run::step() {
  Step step;
  const auto start = Clock::now();
  wire_->step(options_.dt);
  step.step_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  count_cells(&step);

  const physics::StepReport& report = wire_->report();
  step.contacts = report.move.contact_count;
  step.inserted = report.inserted;
  step.removed = report.removed;
  step.reached = wire_->reached();
  step.rod = wire_->rod_part();
  step.detection_seconds = report.library_seconds + step.rod.rows_seconds;
  step.all_in = wire_->links() >= made_of_.links;
  std::size_t count = 0;
  const dsw_body_contact* all = contacts(&count);
  std::for_each(all, all + count, [this](const dsw_body_contact& contact) { table_.add(contact); });

  const physics::Validation validation = physics::verify(world_.scene(), wire_->id());
  step.free = validation.good() && validation.from_own == 0;  // nothing bends: no volume lies over another
  step.vertices = validation.vertices;
  totals_.not_free += validation.not_free;
  totals_.lost += validation.lost + validation.from_own;
  totals_.edges_verified += validation.edges;
  totals_.vertices_verified += validation.vertices;
  totals_.refused += report.status == DSW_STATUS_OK ? 0 : 1;
  add(step, validation.edges);
  return step;
}

void Run::add(const Step& step, std::size_t edges) {
  Totals& t = totals_;
  if (step.all_in && t.whole_edges == 0) {
    t.whole_steps = t.whole_contacts = 0;
    t.rod = Wire::RodPart();
    t.whole_detection.clear();
  }
  ++t.steps;
  t.exactly_free += step.free ? 1 : 0;
  t.inserted += step.inserted;
  t.removed += step.removed;
  t.most_vertices = std::max(t.most_vertices, step.vertices);
  t.most_cells = std::max(t.most_cells, step.volumes_visited);
  t.cells += step.volumes_visited;
  t.orientation_tests += step.orientation_tests;
  t.detection_seconds += step.detection_seconds;
  t.step_seconds += step.step_seconds;
  t.reached = std::max(t.reached, step.reached);
  t.largest_stretch = std::max(t.largest_stretch, wire_->largest_stretch());
  t.rod.rows_seconds += step.rod.rows_seconds;
  t.rod.rod_seconds += step.rod.rod_seconds;
  t.rod.rows += step.rod.rows;
  t.rod.pressing += step.rod.pressing;
  ++t.whole_steps;
  t.whole_contacts += step.contacts;
  t.whole_edges += step.all_in ? edges : 0;
  t.whole_detection.push_back(step.detection_seconds);
}

const dsw_body_contact* Run::contacts(std::size_t* count) const {
  const dsw_body_contact* contacts = nullptr;
  check(dsw_body_get_contacts(world_.scene(), wire_->id(), &contacts, count), "reading contacts");
  return contacts;
}

}  // namespace insertion
