// Figures 8 and 9 of [JCD10]: how much of a vessel's mesh is looked at while a catheter of 20 particles gets longer, and where it lies.
//
// usage: catheter_length [--mesh FILE] [--spacing MM] [--length MM] [--steps N] [--csv FILE] [--json FILE] [--picture FILE]
//
// The catheter is pushed into the vessel and gets no new particle: its edges stretch. An edge that touches stops (the paper's static
// response), a vertex slides.
// It is pushed in twice: first its edges catch at the wall and are released, then the physics keeps contacts for a step and the catheter
// slides on. After each step the casts of [JCD10] 4.1 that its motion asks for are made again, path by path, and the different cells that
// they enter are counted: no counter of the library has that. --json: the figures of the benchmark. --picture: the wall of the vessel and
// the catheter at the end, as JSON.
// Exit code 1: a call failed, or a step was not free; 2: an option or a mesh can't be used.
#include <getopt.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include <nlohmann/json.hpp>

#include "stretched_catheter.h"
#include "table.h"
#include "verify.h"
#include "vessel.h"

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  insertion::Options vessel;
  std::string csv, json, picture;
  double length = 0;  // at rest, at the end; 0: the way from the inlet to the farthest end
  std::size_t steps = 1000;
  paper::StretchedOptions catheter;
};

int usage(const char* wrong) {
  std::cerr
      << "catheter_length: cannot use '" << wrong << "'\n"
      << "usage: catheter_length [--mesh FILE] [--spacing MM] [--length MM] [--steps N] [--csv FILE] [--json FILE] "
         "[--picture FILE]\n";
  return 2;
}

int read_options(int argc, char** argv, Options* options) {
  static const option kOptions[] = {
      {"mesh", required_argument, nullptr, 'm'},    {"spacing", required_argument, nullptr, 's'},
      {"length", required_argument, nullptr, 'n'},  {"steps", required_argument, nullptr, 't'},
      {"csv", required_argument, nullptr, 'c'},     {"json", required_argument, nullptr, 'j'},
      {"picture", required_argument, nullptr, 'p'}, {nullptr, 0, nullptr, 0}};
  options->vessel.spacing = 0.98;
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == '?') {
      return usage(argv[optind - 1]);
    }
    if (letter == 'm' || letter == 'c' || letter == 'j' || letter == 'p') {
      (letter == 'm'   ? options->vessel.mesh
       : letter == 'c' ? options->csv
       : letter == 'j' ? options->json
                       : options->picture) = optarg;
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(optarg, &end);
    if (*optarg == 0 || *end != 0 || !(number > 0 && number <= 1e6) || (letter == 't' && number < 1)) {
      return usage(optarg);
    }
    if (letter == 't') {
      options->steps = static_cast<std::size_t>(number);
    } else {
      (letter == 's' ? options->vessel.spacing : options->length) = number;
    }
  }
  return optind == argc ? 0 : usage(argv[optind]);
}

// Where the particles are.
struct State {
  physics::Positions position;
  std::vector<dsw_volume_id> volume;
};

class Counter {
 public:
  explicit Counter(const dsw_environment* environment) : environment_(environment), crossings_(1024) {}

  // Different cells that the motion from `before` to where the line is asks for, particle by particle as the library makes it.
  std::size_t count(const State& before, const physics::SoftBody& body) {
    entered_.clear();
    const physics::Positions& after = body.points.position;
    for (std::size_t i = 0; i < after.size(); ++i) {
      enter(before.volume[i], before.position[i], after[i]);
      if (i > 0) {
        enter(body.volumes[i], after[i], after[i - 1]);
      }
      if (i + 1 < after.size()) {
        enter(body.volumes[i], after[i], before.position[i + 1]);
      }
    }
    return entered_.size();
  }

 private:
  void enter(dsw_volume_id start, const physics::Vector3& from, const physics::Vector3& to) {
    std::size_t count = 0;
    dsw_status status;
    while ((status = dsw_environment_cast_path(environment_, start, from.data(), to.data(), nullptr, crossings_.data(),
                                               crossings_.size(), &count, nullptr)) == DSW_STATUS_BUFFER_TOO_SMALL) {
      crossings_.resize(count);
    }
    physics::check(status, "casting again");
    for (std::size_t k = 0; k < count; ++k) {
      entered_.insert(crossings_[k].volume.index);
    }
  }

  const dsw_environment* environment_;
  std::vector<dsw_crossing> crossings_;
  std::unordered_set<std::uint32_t> entered_;
};

// Since the last call.
dsw_statistics counters(dsw_scene* scene) {
  dsw_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  physics::check(dsw_scene_get_statistics(scene, &statistics), "reading counters");
  physics::check(dsw_scene_reset_statistics(scene), "resetting counters");
  return statistics;
}

double farthest(const physics::Positions& before, const physics::Positions& after) {
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, (after[i] - before[i]).norm());
  }
  return most;
}

struct Course {
  double largest_share = 0;
  bool free = true;
};

// Pushes the catheter in; one row for each step.
Course push(const char* name, std::size_t steps, double dt, const insertion::Vessel& vessel, physics::World* world,
            paper::StretchedCatheter* catheter, physics::Table* table) {
  const auto cells = static_cast<double>(vessel.info().volume_count);
  physics::SoftBody& body = catheter->body();
  Counter counter(vessel.environment());
  Course course;
  for (std::size_t step = 1; step <= steps && course.free; ++step) {
    const State before = {body.points.position, body.volumes};
    counters(world->scene());
    catheter->step(dt);
    const dsw_statistics work = counters(world->scene());
    const auto different = static_cast<double>(counter.count(before, body));
    course.free = physics::verify(world->scene(), body.id()).good();
    course.largest_share = std::max(course.largest_share, different / cells);
    physics::Row line;
    line.add("push", name).add("step", static_cast<double>(step));
    line.add("length_mm", catheter->length()).add("rest_length_mm", catheter->rest_length());
    line.add("longest_edge_mm", catheter->longest_edge()).add("reached_mm", catheter->reached());
    line.add("vertices", static_cast<double>(body.count()));
    line.add("displacement_mm", farthest(before.position, body.points.position));
    line.add("touches", static_cast<double>(body.touches().size()));
    line.add("cells_tested", different).add("cell_visits", static_cast<double>(work.volumes_visited));
    line.add("orientation_tests", static_cast<double>(work.orientation_tests)).add("cells", cells);
    line.add("cells_tested_share", different / cells)
        .add("cell_visits_share", static_cast<double>(work.volumes_visited) / cells);
    table->push_back(line);
  }
  if (!course.free) {
    std::cerr << "catheter_length: step " << table->size() << " was not free\n";
  }
  return course;
}

Json picture_of(const insertion::Vessel& vessel, const physics::SoftBody& body) {
  const insertion::Wall wall = insertion::wall_of(vessel);
  Json line = Json::array();
  for (const physics::Vector3& at : body.points.position) {
    line.push_back({at.x(), at.y(), at.z()});
  }
  return {{"cells", vessel.info().volume_count},
          {"positions", wall.positions},
          {"triangles", wall.triangles},
          {"catheter", line}};
}

template <class Write>
void write(const std::string& path, const Write& contents) {
  std::ofstream file(path);
  contents(file);
  file.close();
  if (!file) {
    throw insertion::BadInput("cannot write '" + path + "'");
  }
}

int run(const Options& options) {
  const insertion::Vessel vessel(options.vessel);
  const double length = options.length > 0 ? options.length : vessel.route().length();
  const double dt = (length - options.catheter.length) / options.catheter.speed / static_cast<double>(options.steps);
  if (!(dt > 0)) {
    throw insertion::BadInput("a length of " + std::to_string(length) +
                              " mm is not longer than the catheter is at first");
  }
  physics::Table table;
  Json figures = Json::object(), picture;
  double largest = 0;
  bool free = true;
  for (const int memory : {0, 1}) {
    const char* const name = memory == 0 ? "catches" : "slides";
    paper::StretchedOptions catheter_options = options.catheter;
    catheter_options.contact_memory = memory;
    physics::World world(vessel.environment(), DSW_FEATURE_STATISTICS);
    std::optional<paper::StretchedCatheter> catheter;
    try {
      catheter.emplace(&world, &vessel.route(), catheter_options);
    } catch (const physics::LibraryError& error) {
      throw insertion::BadInput(std::string("the catheter does not fit into the inlet; the mesh has to be in mm (") +
                                error.what() + ")");
    }
    const Course course = push(name, options.steps, dt, vessel, &world, &*catheter, &table);
    free = free && course.free;
    largest = std::max(largest, course.largest_share);
    const std::string key = std::string("edges.fig9.") + name;
    figures[key + ".cells_tested_share"] = course.largest_share;
    figures[key + ".length_mm"] = catheter->length();
    figures[key + ".reached_mm"] = catheter->reached();
    figures["edges.fig9.particles"] = catheter->body().count();
    picture = picture_of(vessel, catheter->body());
  }
  figures["edges.fig9.cells_tested_share_max"] = largest;
  figures["edges.fig9.cells"] = vessel.info().volume_count;
  figures["edges.fig9.not_free"] = free ? 0 : 1;
  if (options.csv.empty()) {
    physics::write_csv(table, std::cout);
  } else {
    write(options.csv, [&](std::ostream& out) { physics::write_csv(table, out); });
  }
  if (!options.json.empty()) {
    write(options.json, [&](std::ostream& out) { out << figures.dump(1) << '\n'; });
  }
  if (!options.picture.empty()) {
    write(options.picture, [&](std::ostream& out) { out << picture.dump() << '\n'; });
  }
  return free ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const int code = read_options(argc, argv, &options);
  try {
    return code != 0 ? code : run(options);
  } catch (const insertion::BadInput& error) {
    if (error.what()[0] != 0) {
      std::cerr << "catheter_length: " << error.what() << '\n';
    }
    return 2;
  } catch (const std::invalid_argument& error) {  // the mesh leads nowhere
    std::cerr << "catheter_length: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "catheter_length: " << error.what() << '\n';
    return 1;
  }
}
