// Figure 9 of [JCD10]: how much of a vessel's mesh is looked at while a catheter gets longer.
//
// usage: catheter_length [--mesh FILE] [--spacing MM] [--link MM] [--length MM] [--rows N] [--csv FILE]
//
// The catheter of examples/physics is pushed through the vessel. After each step the casts of [JCD10] 4.1 that its motion asks
// for are made again, path by path, and the different cells that they enter are counted: no counter of the library has that.
// Exit code 1: a call failed, or a step was not free; 2: an option or a mesh can't be used.
#include <getopt.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include "catheter.h"
#include "lumen.h"
#include "table.h"
#include "verify.h"

namespace {

struct Options {
  std::string mesh, csv;
  double spacing = 0.98, length = 0;  // 0: the way from the inlet to the farthest end
  std::size_t rows = 60;
  physics::CatheterOptions catheter;
};

int usage(const char* wrong) {
  std::cerr
      << "catheter_length: cannot use '" << wrong << "'\n"
      << "usage: catheter_length [--mesh FILE] [--spacing MM] [--link MM] [--length MM] [--rows N] [--csv FILE]\n";
  return 2;
}

int read_options(int argc, char** argv, Options* options) {
  static const option kOptions[] = {{"mesh", required_argument, nullptr, 'm'},
                                    {"spacing", required_argument, nullptr, 's'},
                                    {"link", required_argument, nullptr, 'l'},
                                    {"length", required_argument, nullptr, 'n'},
                                    {"rows", required_argument, nullptr, 'r'},
                                    {"csv", required_argument, nullptr, 'c'},
                                    {nullptr, 0, nullptr, 0}};
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == '?') {
      return usage(argv[optind - 1]);
    }
    if (letter == 'm' || letter == 'c') {
      (letter == 'm' ? options->mesh : options->csv) = optarg;
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(optarg, &end);
    if (*optarg == 0 || *end != 0 || !(number > 0 && number <= 1e6) || (letter == 'r' && number < 1)) {
      return usage(optarg);
    }
    if (letter == 'r') {
      options->rows = static_cast<std::size_t>(number);
    } else {
      (letter == 's' ? options->spacing : letter == 'l' ? options->catheter.link : options->length) = number;
    }
  }
  return optind == argc ? 0 : usage(argv[optind]);
}

// What one step, or the worst of several, looks at.
struct Work {
  std::size_t different = 0;  // cells
  std::size_t visits = 0;     // every cell of every swept edge, however often
  double orientation_tests = 0;

  void keep_larger(const Work& other) {
    different = std::max(different, other.different);
    visits = std::max(visits, other.visits);
    orientation_tests = std::max(orientation_tests, other.orientation_tests);
  }
};

// Where the vertices are.
struct State {
  physics::Positions position;
  std::vector<dsw_volume_id> volume;
};

class Counter {
 public:
  explicit Counter(const dsw_scene* scene) : environment_(dsw_scene_get_environment(scene)), crossings_(1024) {}

  // The motion from `before` to where the body is, vertex by vertex as the library makes it. Vertices that are new have not moved.
  Work count(const State& before, const physics::SoftBody& body) {
    const std::size_t count = body.points.size();
    std::vector<std::vector<std::size_t>> neighbours(count);
    for (const physics::DistanceSpring& spring : body.springs.distances) {
      neighbours[spring.a].push_back(spring.b);
      neighbours[spring.b].push_back(spring.a);
    }
    entered_.clear();
    from_.clear(), to_.clear(), fixed_.clear(), starts_.clear();
    for (std::size_t i = 0; i < std::min(count, before.position.size()); ++i) {
      if (neighbours[i].empty()) {
        continue;  // removed
      }
      enter(before.volume[i], before.position[i], body.points.position[i]);
      for (const std::size_t j : neighbours[i]) {
        const bool there = j < i || j >= before.position.size();
        const physics::Vector3& fixed = there ? body.points.position[j] : before.position[j];
        enter(body.volumes[i], body.points.position[i], fixed);
        from_.push_back(before.position[i]), to_.push_back(body.points.position[i]), fixed_.push_back(fixed);
        starts_.push_back(before.volume[i]);
      }
    }
    Work work;
    work.different = entered_.size();
    work.visits = visits_of_sweeps();
    return work;
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

  std::size_t visits_of_sweeps() {
    sweeps_.resize(starts_.size());
    if (starts_.empty()) {
      return 0;
    }
    physics::check(dsw_environment_sweep_edges(environment_, starts_.size(), starts_.data(), from_.front().data(),
                                               to_.front().data(), fixed_.front().data(), sizeof(physics::Vector3),
                                               nullptr, sweeps_.data()),
                   "sweeping again");
    std::size_t visits = 0;
    for (const dsw_sweep& sweep : sweeps_) {
      visits += sweep.cells_visited;
    }
    return visits;
  }

  const dsw_environment* environment_;
  std::vector<dsw_crossing> crossings_;
  std::unordered_set<std::uint32_t> entered_;
  physics::Positions from_, to_, fixed_;
  std::vector<dsw_volume_id> starts_;
  std::vector<dsw_sweep> sweeps_;
};

double length_of(const physics::SoftBody& body) {
  double length = 0;
  for (const physics::DistanceSpring& spring : body.springs.distances) {
    length += (body.points.position[spring.b] - body.points.position[spring.a]).norm();
  }
  return length;
}

// Since the last call.
double orientation_tests(dsw_scene* scene) {
  dsw_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  physics::check(dsw_scene_get_statistics(scene, &statistics), "reading counters");
  physics::check(dsw_scene_reset_statistics(scene), "resetting counters");
  return static_cast<double>(statistics.orientation_tests);
}

// Pushes the catheter in and adds a row each time that it has got longer by a part of `length`: the worst step since the last row.
// False: a step was not free.
bool push(const Options& options, double length, physics::World* world, physics::Catheter* catheter,
          physics::Table* table) {
  constexpr double kStep = 1e-3;  // s
  dsw_environment_info info = {};
  info.struct_size = sizeof info;
  physics::check(dsw_environment_get_info(dsw_scene_get_environment(world->scene()), &info), "asking the environment");
  const auto cells = static_cast<double>(info.volume_count);
  physics::SoftBody& body = catheter->body();
  Counter counter(world->scene());
  Work worst;
  for (std::size_t row = 1, step = 1; row <= options.rows; ++step) {
    body.read_positions();  // volumes of what has come in, too
    const State before = {body.points.position, body.volumes};
    orientation_tests(world->scene());
    catheter->step(kStep);
    const double tests = orientation_tests(world->scene());
    body.read_positions();
    Work work = counter.count(before, body);
    work.orientation_tests = tests;
    worst.keep_larger(work);
    if (!physics::verify(world->scene(), body.id()).good()) {
      std::cerr << "catheter_length: step " << step << " was not free\n";
      return false;
    }
    const double inserted = options.catheter.speed * kStep * static_cast<double>(step);
    if (inserted < length * static_cast<double>(row) / static_cast<double>(options.rows)) {
      continue;
    }
    physics::Row line;
    line.add("step", static_cast<double>(step)).add("length_mm", length_of(body));
    line.add("reached_mm", catheter->reached()).add("vertices", static_cast<double>(body.count()));
    line.add("cells_tested", static_cast<double>(worst.different))
        .add("cell_visits", static_cast<double>(worst.visits));
    line.add("orientation_tests", worst.orientation_tests).add("cells", cells);
    line.add("cells_tested_share", static_cast<double>(worst.different) / cells);
    line.add("cell_visits_share", static_cast<double>(worst.visits) / cells);
    table->push_back(line);
    worst = Work();
    ++row;
  }
  return true;
}

int run(const Options& options) {
  demo_mesh mesh;
  const int code =
      options.mesh.empty() ? mesh_make_vessel(options.spacing, &mesh) : mesh_read(options.mesh.c_str(), &mesh);
  if (code != 0) {
    return code;
  }
  const physics::Environment environment(create_environment(nullptr, &mesh));
  mark_wall(environment.get(), &mesh);
  demo_flow flow;
  physics::check(flow_create(environment.get(), &mesh, 0, &flow), "finding the ways through the vessel");
  mesh_free(&mesh);
  const std::unique_ptr<demo_flow, decltype(&flow_destroy)> owner(&flow, flow_destroy);
  const physics::Route route(environment.get(), flow);
  physics::World world(environment.get(), DSW_FEATURE_STATISTICS);
  std::optional<physics::Catheter> catheter;
  try {
    catheter.emplace(&world, &route, options.catheter);
  } catch (const physics::LibraryError& error) {
    throw std::invalid_argument("a link of " + std::to_string(options.catheter.link) +
                                " mm does not fit into the inlet; the mesh has to be in mm (" + error.what() + ")");
  }
  physics::Table table;
  const bool free = push(options, options.length > 0 ? options.length : route.length(), &world, &*catheter, &table);
  if (options.csv.empty()) {
    physics::write_csv(table, std::cout);
  } else {
    std::ofstream file(options.csv);
    physics::write_csv(table, file);
    file.close();
    if (!file) {
      std::cerr << "catheter_length: cannot write '" << options.csv << "'\n";
      return 2;
    }
  }
  return free ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const int code = read_options(argc, argv, &options);
  try {
    return code != 0 ? code : run(options);
  } catch (const std::invalid_argument& error) {  // the mesh leads nowhere, or a link is too long for it
    std::cerr << "catheter_length: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "catheter_length: " << error.what() << '\n';
    return 1;
  }
}
