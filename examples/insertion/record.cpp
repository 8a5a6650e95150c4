#include "record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "output.h"

namespace insertion {
namespace {

const char* const kAbout[][2] = {
    {"time", "s, at the frame"},
    {"reached", "how far along the route the tip is, at the frame"},
    {"vertices", "of the catheter, at the frame"},
    {"contacts", "sum over the steps since the frame before"},
    {"cells_tested_share", "largest of one step: cells tested over all cells of the mesh"},
    {"orientation_tests", "of casts, those of floods not counted; sum over the steps since the frame before"},
    {"detection_ms", "mean of a step: the library's near rows and move"},
    {"step_ms", "mean of a step: physics and the library's move, verification left out"},
    {"verified", "1: exactly free after every step since the frame before"}};

// Seven digits are what a screen can show; all of them would double the file.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return std::strtod(text, nullptr);
}

Json rounded(const double* values, std::size_t count) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    list.push_back(rounded(values[i]));
  }
  return list;
}

Json contacts_of(const Run& run, const std::vector<std::size_t>& line) {
  std::size_t count = 0;
  const dsw_body_contact* contacts = run.contacts(&count);
  const std::vector<double> impulse = run.wire().impulses(count);
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const dsw_body_contact& contact = contacts[i];
    const auto at = std::find(line.begin(), line.end(), contact.vertex.index);
    list.push_back({{"point", rounded(contact.point, 3)},
                    {"normal", rounded(contact.contact.normal, 3)},
                    {"kind", name_of(contact.contact.kind)},
                    {"time", rounded(contact.time)},
                    {"tag", contact.contact.tag},
                    {"vertex", at == line.end() ? -1 : at - line.begin()},
                    {"impulse", rounded(impulse[i])}});
  }
  return list;
}

std::string source_of(const Options& options) {
  if (!options.source.empty()) {
    return options.source;
  }
  return options.mesh.empty() ? "generated vessel" : options.mesh.substr(options.mesh.find_last_of('/') + 1);
}

// The least of the sorted values that a share of all do not exceed.
double not_exceeded(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted.empty() ? 0 : sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

void check_written(std::ofstream* file, const std::string& name) {
  file->close();
  if (!*file) {
    throw BadInput("cannot write '" + name + "'");
  }
}

}  // namespace

Json summary_of(const Options& options, const Vessel& vessel, const Run& run) {
  const Totals& t = run.totals();
  const auto steps = static_cast<double>(t.steps), whole = static_cast<double>(t.whole_steps);
  const auto cells = static_cast<double>(vessel.info().volume_count);
  const auto share = [](double part, double of) { return of > 0 ? rounded(part / of) : 0.0; };
  Json s;
  s["demo.steps"] = t.steps;
  s["demo.exactly_free_steps"] = t.exactly_free;
  s["demo.lost"] = t.lost;
  if (options.statistics) {
    s["demo.cells_tested_share_max"] = rounded(static_cast<double>(t.most_cells) / cells);
    s["demo.cells_tested_share_mean"] = rounded(static_cast<double>(t.cells) / steps / cells);
    s["demo.orientation_tests_per_step"] = share(static_cast<double>(t.orientation_tests), steps);
  }
  std::vector<double> detection = t.whole_detection;
  std::sort(detection.begin(), detection.end());
  const double detected = std::accumulate(detection.begin(), detection.end(), 0.0);
  s["demo.realtime_factor"] = share(options.dt * whole, detected);
  s["demo.realtime_factor.whole_step"] = share(options.dt * steps, t.step_seconds);
  s["demo.detection_ms"] = share(1e3 * detected, whole);
  s["demo.detection_ms_p999"] = rounded(1e3 * not_exceeded(detection, 0.999));
  s["demo.detection_ms_max"] = rounded(1e3 * not_exceeded(detection, 1));
  s["demo.edges"] = share(static_cast<double>(t.whole_edges), whole);
  s["demo.contacts_per_step"] = share(static_cast<double>(t.whole_contacts), whole);
  s["demo.steps_with_all_links"] = t.whole_edges > 0 ? t.whole_steps : 0;
  s["demo.contacts"] = run.table().total();
  s["demo.vertices_inserted"] = t.inserted;
  s["demo.vertices_removed"] = t.removed;
  s["demo.vertices_max"] = t.most_vertices;
  s["demo.reached"] = rounded(t.reached);
  s["demo.route_length"] = rounded(vessel.route().length());
  s["demo.reached_share"] = rounded(t.reached / vessel.route().length());
  s["demo.largest_stretch"] = rounded(t.largest_stretch);
  s["demo.refused_steps"] = t.refused;
  s["demo.volumes"] = vessel.info().volume_count;
  s["demo.passable_volumes"] = vessel.flow().count;
  s["demo.lumen_radius"] = rounded(vessel.radius());
  s["demo.link"] = rounded(run.made_of().link);
  s["demo.speed"] = rounded(run.made_of().speed);
  s["demo.dt"] = options.dt;
  s["demo.friction"] = options.friction;
  s["demo.physics"] = options.rod ? "rod" : "springs";
  if (options.rod) {
    s["demo.rows_ms"] = share(1e3 * t.rod.rows_seconds, whole);
    s["demo.rod_ms"] = share(1e3 * t.rod.rod_seconds, whole);
    s["demo.rows_per_step"] = share(static_cast<double>(t.rod.rows), whole);
    s["demo.rows_pressing_per_step"] = share(static_cast<double>(t.rod.pressing), whole);
  } else {
    s["demo.integrator"] = physics::name_of(options.integrator);
    s["demo.response"] = options.inserts ? "insert" : "slide";
    s["demo.contact_memory"] = options.contact_memory;
  }
  s["demo.level"] = options.level == DSW_LEVEL_EDGES ? "edges" : "edges_swept";
  return s;
}

void print(const Json& summary, const Run& run, std::ostream& out) {
  const Totals& t = run.totals();
  for (const auto& [key, value] : summary.items()) {
    out << key << ' ' << (value.is_string() ? value.get<std::string>() : value.dump()) << '\n';
  }
  out << '\n';
  run.table().print(out);
  out << "\nverified after every step, by other calls than those that moved it: " << t.edges_verified
      << " edges cast through the environment, " << t.vertices_verified << " vertices found again without a hint.\n"
      << "exactly free at " << t.exactly_free << " of " << t.steps << " steps; " << t.not_free
      << " edges were not free, " << t.lost << " vertices lost.\n";
}

Record::Record(const Options& options, const Vessel* vessel, const Run* run)
    : options_(options), vessel_(vessel), run_(run), csv_(options.out + "/steps.csv") {
  csv_ << "step,time,vertices,contacts,inserted,removed,volumes_visited,orientation_tests,detection_ms,step_ms,reached,"
          "free\n";
  if (!csv_.flush()) {  // now, not after all steps
    throw BadInput("cannot write '" + options.out + "/steps.csv'");
  }
  for (const auto& about : kAbout) {
    series_[about[0]] = Json::array();
  }
}

void Record::add(const Step& step) {
  ++steps_;
  char line[256];
  std::snprintf(line, sizeof line, "%zu,%.9g,%zu,%zu,%zu,%zu,%llu,%llu,%.6g,%.6g,%.6g,%d\n", steps_,
                static_cast<double>(steps_) * options_.dt, step.vertices, step.contacts, step.inserted, step.removed,
                static_cast<unsigned long long>(step.volumes_visited),
                static_cast<unsigned long long>(step.orientation_tests), 1e3 * step.detection_seconds,
                1e3 * step.step_seconds, step.reached, step.free ? 1 : 0);
  csv_ << line;
  window_.push_back(step);
  // Frames lie evenly: number k is due after k / frames of all steps.
  if (steps_ * options_.frames / options_.steps > frames_.size() || steps_ == options_.steps) {
    add_to_series();
    add_frame();
    window_.clear();
  }
}

void Record::add_to_series() {
  const Step& last = window_.back();
  std::size_t contacts = 0;
  std::uint64_t cells = 0, tests = 0;
  double detection = 0, whole = 0;
  bool free = true;
  for (const Step& step : window_) {
    contacts += step.contacts;
    cells = std::max(cells, step.volumes_visited);
    tests += step.orientation_tests;
    detection += step.detection_seconds;
    whole += step.step_seconds;
    free = free && step.free;
  }
  const auto count = static_cast<double>(window_.size());
  series_["time"].push_back(rounded(static_cast<double>(steps_) * options_.dt));
  series_["reached"].push_back(rounded(last.reached));
  series_["vertices"].push_back(last.vertices);
  series_["contacts"].push_back(contacts);
  series_["cells_tested_share"].push_back(
      rounded(static_cast<double>(cells) / static_cast<double>(vessel_->info().volume_count)));
  series_["orientation_tests"].push_back(tests);
  series_["detection_ms"].push_back(rounded(1e3 * detection / count));
  series_["step_ms"].push_back(rounded(1e3 * whole / count));
  series_["verified"].push_back(free ? 1 : 0);
}

void Record::add_frame() {
  const Wire& wire = run_->wire();
  const std::vector<std::size_t> line = wire.line();
  Json positions = Json::array(), inserted = Json::array();
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (const double x : wire.positions()[line[i]]) {
      positions.push_back(rounded(x));
    }
    if (wire.was_inserted(line[i])) {
      inserted.push_back(i);
    }
  }
  frames_.push_back({{"step", steps_},
                     {"time", rounded(static_cast<double>(steps_) * options_.dt)},
                     {"positions", positions},
                     {"inserted", inserted},
                     {"contacts", contacts_of(*run_, line)}});
}

void Record::write_vtu() const {
  const Wire& wire = run_->wire();
  const std::vector<std::size_t> line = wire.line();
  std::vector<double> points, inserted, touches, normals;
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i < line.size(); ++i) {
    const physics::Vector3& at = wire.positions()[line[i]];
    points.insert(points.end(), at.begin(), at.end());
    inserted.push_back(wire.was_inserted(line[i]) ? 1 : 0);
    if (i > 0) {
      edges.insert(edges.end(), {i - 1, i});
    }
  }
  std::size_t count = 0;
  const dsw_body_contact* contacts = run_->contacts(&count);
  for (std::size_t i = 0; i < count; ++i) {
    touches.insert(touches.end(), contacts[i].point, contacts[i].point + 3);
    normals.insert(normals.end(), contacts[i].contact.normal, contacts[i].contact.normal + 3);
  }
  const Wall wall = wall_of(*vessel_);
  const vtu_field field_inserted = field("inserted", inserted.data(), 1);
  const char* out = options_.out.c_str();
  if (vtu_write(out, "catheter.vtu", points.data(), line.size(), edges.data(), 2, edges.size() / 2, &field_inserted,
                1) != 0 ||
      write_touches(out, "contacts.vtu", touches.data(), normals.data(), count) != 0 ||
      vtu_write(out, "wall.vtu", wall.positions.data(), wall.positions.size() / 3, wall.triangles.data(), 3,
                wall.triangles.size() / 3, nullptr, 0) != 0) {
    throw BadInput("");
  }
}

void Record::finish() {
  check_written(&csv_, options_.out + "/steps.csv");
  write_vtu();
  const Wall wall = wall_of(*vessel_);
  const std::string source = source_of(options_);
  Json j;
  j["format"] = 1;
  j["title"] = "A catheter of " + std::to_string(options_.vertices) + " vertices in " +
               (options_.mesh.empty() ? "a generated vessel" : source);
  j["unit"] = options_.unit;
  j["dt"] = options_.dt;
  j["environment"] = {{"volumes", vessel_->info().volume_count},
                      {"passable", vessel_->flow().count},
                      {"points", vessel_->info().vertex_count},
                      {"source", source}};
  j["wall"] = {{"positions", rounded(wall.positions.data(), wall.positions.size())}, {"triangles", wall.triangles}};
  j["summary"] = summary_of(options_, *vessel_, *run_);
  j["frames"] = frames_;
  j["series"] = series_;
  j["series_about"] = Json::object();
  for (const auto& about : kAbout) {
    j["series_about"][about[0]] = about[1];
  }
  Json rows = Json::array();
  for (const auto& [name, counts] : run_->table().rows()) {
    Json row = {name};
    for (const std::size_t count : counts) {
      row.push_back(count);
    }
    rows.push_back(row);
  }
  j["contact_table"] = {{"columns", run_->table().columns()}, {"rows", rows}};
  std::ofstream file(options_.out + "/insertion.json");
  // A file's name may be no UTF-8.
  file << j.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  check_written(&file, options_.out + "/insertion.json");
}

}  // namespace insertion
