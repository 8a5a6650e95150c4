// What a scene pays for what it enables, and what it does not pay for the rest: bytes, orientation tests and time of
// one scene, each level, feature and way to leave out work on and off. A program of its own: it needs no peer, and
// runs on two builds of the library.
#include "fig11_case.h"
#include "report.h"
#include "timing.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

namespace dsw::bench {

namespace {

#ifdef LEFT_OUT_WITH_LIBCCD
constexpr const char* kLibccd = "built";
#else
constexpr const char* kLibccd = "not built";
#endif

/** What a scene asks for. */
struct Setting {
  std::string feature, setting;
  std::uint32_t features = 0;  // of the scene
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;
  std::uint32_t flags = 0;  // of its bodies
  dsw_response vertex_response = DSW_RESPONSE_STOP, edge_response = DSW_RESPONSE_STOP;
  dsw_search search = DSW_SEARCH_EXACT;
  // What a host does with the bodies.
  std::uint32_t move_flags = 0, passes = 0;
  double radius = 0;
  bool asks_for_rows = false, moves_at_once = false, records = false;
  std::string off{};  // the setting of this feature that is `off` or the default, where another row has measured it
};

Setting level(const char* name, dsw_level value) {
  Setting made{"level", name};
  made.level = value;
  return made;
}

Setting feature(const char* name, std::uint32_t bits) {
  Setting made{name, "on"};
  made.features = bits;
  made.off = "off";
  return made;
}

/** Sets flags of bodies at DSW_LEVEL_EDGES, where all of these flags do something. */
Setting flag(const char* name, std::uint32_t bits) {
  Setting made{name, "on"};
  made.level = DSW_LEVEL_EDGES;
  made.flags = bits;
  made.off = "off";
  return made;
}

Setting response(const char* name, dsw_response vertices, dsw_response edges) {
  Setting made{"response", name};
  made.vertex_response = vertices;
  made.edge_response = edges;
  made.off = "stop";
  return made;
}

/** What a host asks for beside that, at DSW_LEVEL_EDGES_SWEPT. */
template <class Change>
Setting use(const char* name, Change change) {
  Setting made{name, "on"};
  change(made);
  made.off = "off";
  return made;
}

Setting search(const char* name, dsw_search value) {
  Setting made{"contact detail", name};
  made.search = value;
  made.off = "exact";
  return made;
}

/** Beside `slide`. */
Setting keep_walls() {
  Setting made = response("slide_keep_walls", DSW_RESPONSE_SLIDE, DSW_RESPONSE_SLIDE);
  made.move_flags = DSW_MOVE_KEEP_WALLS;
  return made;
}

constexpr std::uint32_t kAll = DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS | DSW_FEATURE_DEFORMING |
                               DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_LIVE_CHANGES;

/** The one at level EDGES_SWEPT enables nothing else: it is the `off` of what is no flag, that at EDGES of flags. */
std::vector<Setting> all_settings() {
  return {level("points", DSW_LEVEL_POINTS),
          level("edges", DSW_LEVEL_EDGES),
          level("edges_swept", DSW_LEVEL_EDGES_SWEPT),
          level("faces", DSW_LEVEL_FACES),
          feature("statistics", DSW_FEATURE_STATISTICS),
          feature("crossings", DSW_FEATURE_CROSSINGS),
          feature("deforming", DSW_FEATURE_DEFORMING),
          feature("body contacts", DSW_FEATURE_BODY_CONTACTS),
          feature("live changes", DSW_FEATURE_LIVE_CHANGES),
          feature("all five", kAll),
          flag("sequences", DSW_BODY_SEQUENCES),
          flag("skip by environment", DSW_BODY_SKIP_BY_ENVIRONMENT),
          flag("skip by clearance", DSW_BODY_SKIP_BY_CLEARANCE),
          flag("skip similar motion", DSW_BODY_SKIP_SIMILAR_MOTION),
          flag("skip back edges", DSW_BODY_SKIP_BACK_EDGES),
          flag("hybrid", DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BACK_EDGES),
          flag("left back edges", DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES),
          flag("rigid", DSW_BODY_RIGID),
          use("no sequences", [](Setting& s) { s.flags = DSW_BODY_NO_SEQUENCES; }),
          use("self contacts",
              [](Setting& s) {
                s.features = DSW_FEATURE_BODY_CONTACTS;
                s.flags = DSW_BODY_SELF_CONTACTS;
              }),
          use("radius", [](Setting& s) { s.radius = 1e-3; }),
          use("passes", [](Setting& s) { s.passes = 4; }),
          use("near rows", [](Setting& s) { s.asks_for_rows = true; }),
          use("together", [](Setting& s) { s.moves_at_once = true; }),
          use("recording", [](Setting& s) { s.records = true; }),
          response("slide", DSW_RESPONSE_SLIDE, DSW_RESPONSE_SLIDE),
          response("adaptive_one", DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_ONE),
          response("adaptive_many", DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_MANY),
          response("hybrid", DSW_RESPONSE_SLIDE, DSW_RESPONSE_HYBRID),
          response("adaptive_slide", DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_SLIDE),
          keep_walls(),
          search("all", DSW_SEARCH_EXHAUSTIVE),
          search("bisection", DSW_SEARCH_BISECTION)};
}

/** Bodies that may get new vertices: these aim at the point between the targets of the ends of their edge. */
class Bodies {
 public:
  Bodies(dsw_environment* environment, const Setting& setting, const BodyShape& shape,
         const std::vector<double>& positions, std::uint32_t more_features = 0)
      : flock_(environment, {setting.setting, setting.level, setting.flags}, shape, positions,
               setting.features | more_features),
        vertices_(shape.vertices),
        inserted_(flock_.bodies().size()) {
    dsw_move_options_init(&options_, sizeof options_);
    options_.vertex_response = setting.vertex_response;
    options_.edge_response = setting.edge_response;
    options_.search = setting.search;
    options_.flags = setting.move_flags;
    options_.passes = setting.passes;
    asks_for_rows_ = setting.asks_for_rows;
    moves_at_once_ = setting.moves_at_once;
    for (const dsw_body_id body : flock_.bodies()) {
      if (setting.radius > 0) check(dsw_body_set_radius(scene(), body, setting.radius));
    }
    if (setting.records) start_recording();
    options_.min_length = 0.1;  // of edges half a cell long, so that there is an end to insertions
    adaptive_ = setting.edge_response != DSW_RESPONSE_STOP && setting.edge_response != DSW_RESPONSE_SLIDE;
  }

  dsw_scene* scene() const { return flock_.scene(); }
  std::size_t vertex_count() const {
    std::size_t count = vertices_ * inserted_.size();
    for (const auto& each : inserted_) count += each.size();
    return count;
  }

  /** All bodies take one step. @return ns that the library takes. */
  double move(const std::vector<double>& script) {
    if (moves_at_once_) return cpu_time_ns([&] { flock_.move_together(script.data(), DSW_TOGETHER_STOP_FEATURE); });
    if (!adaptive_) {
      return cpu_time_ns([&] {
        flock_.move(script.data(), &options_);
        if (asks_for_rows_) find_rows();
      });
    }
    targets_.clear();
    for (std::size_t body = 0; body < inserted_.size(); ++body) {
      const std::size_t first = targets_.size();
      const auto* own = &script[3 * vertices_ * body];
      targets_.insert(targets_.end(), own, own + 3 * vertices_);
      for (const Inserted& each : inserted_[body]) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = targets_[first + 3 * each.ends[0] + k], b = targets_[first + 3 * each.ends[1] + k];
          targets_.push_back(a + each.share * (b - a));
        }
      }
    }
    const double ns = cpu_time_ns([&] {
      check(dsw_scene_move_bodies(scene(), flock_.bodies().data(), inserted_.size(), targets_.data(),
                                  targets_.size() / 3, 0, &options_, nullptr));
    });
    for (std::size_t body = 0; body < inserted_.size(); ++body) {
      const dsw_body_edit* edits = nullptr;
      std::size_t count = 0;
      check(dsw_body_get_edits(scene(), flock_.bodies()[body], &edits, &count));
      for (std::size_t i = 0; i < count; ++i) {  // none is removed: noise_share is 0, so indices follow each other
        inserted_[body].push_back({{edits[i].ends[0].index, edits[i].ends[1].index}, edits[i].edge_parameter});
      }
    }
    return ns;
  }

 private:
  /** Records to nowhere: what writing costs without a disc. */
  void start_recording() {
    dsw_recording_desc desc;
    dsw_recording_desc_init(&desc, sizeof desc);
    desc.write = [](void*, const void*, std::size_t) { return 0; };
    check(dsw_scene_start_recording(scene(), &desc));
  }

  void find_rows() {
    dsw_near_options options;
    dsw_near_options_init(&options, sizeof options);
    options.margin = 0.1;
    std::size_t count = 0;
    for (const dsw_body_id body : flock_.bodies()) check(dsw_body_find_near_rows(scene(), body, &options, &count));
  }

  struct Inserted {
    std::size_t ends[2];
    double share;
  };

  Flock flock_;
  std::size_t vertices_;                         // of one body, at first
  std::vector<std::vector<Inserted>> inserted_;  // of each body, in the order of their indices
  std::vector<double> targets_;
  dsw_move_options options_{};
  bool adaptive_ = false, asks_for_rows_ = false, moves_at_once_ = false;
};

/** One scene in an environment of its own, whose memory is counted. */
class Run {
 public:
  Run(const Fig11Case& scene, const Script& script, Setting what)
      : setting_(std::move(what)), scene_(scene), script_(script), world_(scene.grid.mesh, 1, true) {
    mark_cells(world_, scene.grid.obstacle);
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = setting_.features;
    dsw_scene* empty = nullptr;
    std::uint64_t own = 0;
    check(dsw_scene_create(world_.environment(), &desc, &empty));
    check(dsw_scene_get_memory_bytes(empty, &own));
    environment_bytes_ = bytes() - static_cast<double>(own);
    check(dsw_scene_destroy(empty));
    start();
  }

  const Setting& setting() const { return setting_; }
  const World& world() const { return world_; }

  /** The bodies begin anew, in a scene of their own. */
  void start(std::uint32_t more_features = 0) {
    bodies_.reset();
    bodies_ = std::make_unique<Bodies>(world_.environment(), setting_, scene_.skin, script_.starts, more_features);
  }
  void stop() { bodies_.reset(); }

  void step(std::size_t index) { ns_.push_back(bodies_->move(script_.targets[index])); }

  /** All that was taken from the host. */
  double bytes() const { return static_cast<double>(world_.memory().now); }
  double bytes_per_cell() const { return environment_bytes_ / static_cast<double>(scene_.grid.mesh.cell_count()); }
  double bytes_per_vertex() const {
    return (bytes() - environment_bytes_) / static_cast<double>(bodies_->vertex_count());
  }
  double microseconds() const { return median(ns_) / 1000; }

  /** Orientation tests of a step: of a second scene, which counts them. */
  double count_tests() {
    start(DSW_FEATURE_STATISTICS);
    check(dsw_scene_reset_statistics(bodies_->scene()));
    for (const auto& targets : script_.targets) bodies_->move(targets);
    dsw_statistics statistics{};
    statistics.struct_size = sizeof statistics;
    check(dsw_scene_get_statistics(bodies_->scene(), &statistics));
    return static_cast<double>(statistics.orientation_tests) / static_cast<double>(script_.steps);
  }

 private:
  Setting setting_;
  const Fig11Case& scene_;
  const Script& script_;
  World world_;
  double environment_bytes_ = 0;  // with what naming features adds to it
  std::unique_ptr<Bodies> bodies_;
  std::vector<double> ns_;  // of each step
};

/** What a scene that enables nothing pays for what another scene has enabled before it in its environment. Deforming is
 * left out: it says that walks stay those for warped volumes. */
void measure_not_enabled(const Fig11Case& scene, const Script& script, Report& report) {
  Run fresh(scene, script, level("edges_swept", DSW_LEVEL_EDGES_SWEPT));
  Run after(scene, script, level("edges_swept", DSW_LEVEL_EDGES_SWEPT));
  after.start(kAll ^ DSW_FEATURE_DEFORMING);
  for (std::size_t step = 0; step < script.steps; ++step) after.step(step);
  for (Run* run : {&fresh, &after}) {
    run->start();
    for (std::size_t step = 0; step < script.steps; ++step) run->step(step);
  }
  report.set("left_out.not_enabled_bytes", after.bytes() - fresh.bytes());
  report.set("left_out.not_enabled_orientation_tests", after.count_tests() - fresh.count_tests());
}

constexpr double kNothing = -1;  // an empty field

struct Row {
  std::string feature, setting;
  double bytes_per_cell = kNothing, bytes_per_vertex = kNothing, tests = kNothing, microseconds = kNothing;
};

/** Casts alone, with the whole report and with the least. */
void measure_casts(const World& world, const Segments& segments, std::vector<Row>& rows) {
  std::vector<dsw_flight> flights(segments.batch);
  std::map<std::uint32_t, std::vector<double>> ns;
  for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
    for (const std::uint32_t flags : {0u, static_cast<std::uint32_t>(DSW_CAST_NO_DETAIL)}) {
      dsw_cast_options options;
      dsw_cast_options_init(&options, sizeof options);
      options.flags = DSW_CAST_START_KNOWN | flags;
      ns[flags].push_back(cpu_time_ns([&] {
        check(dsw_environment_cast_segments(world.environment(), segments.batch, &segments.starts[first],
                                            &segments.from[3 * first], &segments.to[3 * first], 0, &options,
                                            flights.data()));
      }));
    }
  }
  for (const auto& [flags, each] : ns) {
    Row row{"detail of casts", flags == 0 ? "on" : "off"};
    row.microseconds = median(each) / 1000;
    rows.push_back(row);
  }
}

/** Squares and cubes: bytes of an environment of about so many cells. */
void measure_dimensions(std::size_t cells, std::vector<Row>& rows) {
  for (const std::uint32_t dimension : {2u, 3u}) {
    const auto side = static_cast<std::size_t>(std::round(std::pow(static_cast<double>(cells), 1.0 / dimension)));
    const std::size_t row = side + 1, layers = dimension == 3 ? side : 1;
    std::vector<double> points;
    std::vector<std::int64_t> corners;
    for (std::size_t z = 0; z <= (dimension == 3 ? side : 0); ++z) {
      for (std::size_t i = 0; i < row * row; ++i) {
        points.insert(points.end(), {static_cast<double>(i % row), static_cast<double>(i / row)});
        if (dimension == 3) points.push_back(static_cast<double>(z));
      }
    }
    for (std::size_t i = 0; i < side * side * layers; ++i) {
      const std::size_t x = i % side, y = i / side % side, first = (i / side / side * row + y) * row + x;
      const std::size_t base[4] = {first, first + 1, first + row + 1, first + row};
      for (std::size_t layer = 0; layer < (dimension == 3 ? 2u : 1u); ++layer) {
        for (const std::size_t corner : base) corners.push_back(static_cast<std::int64_t>(corner + layer * row * row));
      }
    }
    dsw_environment_desc desc;
    dsw_environment_desc_init(&desc, sizeof desc);
    desc.dimension = dimension;
    desc.points = points.data();
    desc.point_count = points.size() / dimension;
    desc.uniform_cell_type = dimension == 3 ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD;
    desc.volume_count = side * side * layers;
    desc.connectivity = corners.data();
    desc.connectivity_count = corners.size();
    dsw_environment* environment = nullptr;
    check(dsw_environment_create(nullptr, &desc, &environment, nullptr));
    dsw_environment_info info;
    info.struct_size = sizeof info;
    check(dsw_environment_get_info(environment, &info));
    Row made{"dimension", dimension == 3 ? "space" : "plane"};
    made.bytes_per_cell = static_cast<double>(info.memory_bytes) / static_cast<double>(info.volume_count);
    rows.push_back(made);
    dsw_environment_destroy(environment);
  }
}

std::vector<Row> measure(const Fig11Case& scene, const Script& script, bool libccd_only, Report& report) {
  std::vector<std::unique_ptr<Run>> runs;
  for (const Setting& setting : all_settings()) {
    if (!libccd_only || setting.setting == "edges_swept") runs.push_back(std::make_unique<Run>(scene, script, setting));
  }
  for (std::size_t step = 0; step < script.steps; ++step) {
    for (std::size_t i = 0; i < runs.size(); ++i) runs[(step + i) % runs.size()]->step(step);
  }
  std::vector<Row> rows;
  std::map<std::string, Row> of_level;
  for (const auto& run : runs) {
    const Setting& setting = run->setting();
    Row row{setting.feature, setting.setting, run->bytes_per_cell(), run->bytes_per_vertex(), 0, run->microseconds()};
    row.tests = run->count_tests();
    run->stop();
    if (setting.feature == "level") {
      of_level[setting.setting] = row;
    } else if (rows.back().feature != setting.feature) {
      rows.push_back(of_level.at(setting.level == DSW_LEVEL_EDGES ? "edges" : "edges_swept"));
      rows.back().feature = setting.feature;
      rows.back().setting = setting.off;
    }
    rows.push_back(row);
  }
  Row nothing_enabled = of_level.at("edges_swept");
  if (libccd_only) {
    nothing_enabled.feature = "libccd";
    nothing_enabled.setting = kLibccd;
    return {nothing_enabled};
  }
  report.set("left_out.bytes_per_cell", nothing_enabled.bytes_per_cell);
  report.set("left_out.bytes_per_vertex", nothing_enabled.bytes_per_vertex);
  report.set("left_out.orientation_tests_per_step", nothing_enabled.tests);
  measure_casts(runs.front()->world(), script.casts(0, script.steps), rows);
  measure_dimensions(scene.grid.mesh.cell_count(), rows);
  return rows;
}

void write_rows(const std::vector<Row>& rows, const std::string& path) {
  std::ofstream file(path);
  file << "feature,setting,bytes_per_cell,bytes_per_vertex,orientation_tests_per_step,microseconds_per_step\n";
  for (const Row& row : rows) {
    file << row.feature << ',' << row.setting;
    for (const double value : {row.bytes_per_cell, row.bytes_per_vertex, row.tests, row.microseconds}) {
      char text[32] = "";
      if (value != kNothing) std::snprintf(text, sizeof text, "%.7g", value);
      file << ',' << text;
    }
    file << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

}  // namespace dsw::bench

int main(int argc, char** argv) {
  using namespace dsw::bench;
  std::string csv = "left_out.csv", json = "left_out.json";
  std::size_t cells = 100000, steps = 100;
  bool libccd_only = false;
  CLI::App app("What a scene pays for what it enables.");
  app.add_option("--csv", csv, "Table to write");
  app.add_option("--json", json, "Figures to write");
  app.add_option("--cells", cells, "Of the lattice");
  app.add_option("--steps", steps, "Of the bodies");
  app.add_flag("--libccd-only", libccd_only, "Only the row that says whether libccd is built in");
  CLI11_PARSE(app, argc, argv);
  try {
    Fig11Case scene(cells);
    const Script script = scene.record(steps, false);
    Report report;
    if (!libccd_only) measure_not_enabled(scene, script, report);
    write_rows(measure(scene, script, libccd_only, report), csv);
    return report.write(json) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "left_out: %s\n", error.what());
    return 1;
  }
}
