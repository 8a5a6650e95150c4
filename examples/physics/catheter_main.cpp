// Pushes a catheter through the generated vessel: catheter [--spacing MM] [--seconds S] [--dt S] [--integrator NAME] [--speed MM_S]
// [--friction MU] [--level LEVEL] [--json FILE]
//
// Every step is verified. Exit code 1: the catheter was not free at some step, or lost; 2: an option can't be used.
#include <getopt.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "catheter.h"
#include "lumen.h"
#include "table.h"
#include "verify.h"

namespace {

struct Options {
  double spacing = 1.3, seconds = 2.5, dt = 1e-3;
  physics::CatheterOptions catheter;
  std::string json;
};

struct Figures {
  std::size_t steps = 0, exactly_free = 0, contacts = 0, inserted = 0, removed = 0, refused = 0;
  double all_seconds = 0, library_seconds = 0;
};

int usage(const char* wrong) {
  std::cerr
      << "catheter: cannot use '" << wrong << "'\n"
      << "usage: catheter [--spacing MM] [--seconds S] [--dt S] [--integrator symplectic_euler|implicit_euler|xpbd] "
         "[--speed MM_S] [--friction MU] [--json FILE]\n";
  return 2;
}

bool read_integrator(const std::string& name, physics::Integrator* integrator) {
  for (const auto known :
       {physics::Integrator::kSymplecticEuler, physics::Integrator::kImplicitEuler, physics::Integrator::kXpbd}) {
    if (name == physics::name_of(known)) {
      *integrator = known;
      return true;
    }
  }
  return false;
}

int read_options(int argc, char** argv, Options* options) {
  static const option kOptions[] = {
      {"spacing", required_argument, nullptr, 'm'}, {"seconds", required_argument, nullptr, 's'},
      {"dt", required_argument, nullptr, 'd'},      {"integrator", required_argument, nullptr, 'i'},
      {"speed", required_argument, nullptr, 'v'},   {"friction", required_argument, nullptr, 'f'},
      {"json", required_argument, nullptr, 'j'},    {nullptr, 0, nullptr, 0}};
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == '?') {
      return usage(argv[optind - 1]);
    }
    char* end = nullptr;
    const double number = std::strtod(optarg, &end);
    const bool is_number = *optarg != 0 && *end == 0 && number >= 0 && number <= 1e6;
    if (letter == 'j') {
      options->json = optarg;
    } else if (letter == 'i') {
      if (!read_integrator(optarg, &options->catheter.body.integrator.method)) {
        return usage(optarg);
      }
    } else if (!is_number || (letter != 'f' && number == 0)) {
      return usage(optarg);
    } else {
      (letter == 'm'   ? options->spacing
       : letter == 's' ? options->seconds
       : letter == 'd' ? options->dt
       : letter == 'v' ? options->catheter.speed
                       : options->catheter.body.friction.otherwise) = number;
    }
  }
  return optind == argc ? 0 : usage(argv[optind]);
}

Figures push(const Options& options, physics::World* world, physics::Catheter* catheter) {
  using Clock = std::chrono::steady_clock;
  Figures f;
  for (double time = 0; time < options.seconds; time += options.dt) {
    const auto start = Clock::now();
    catheter->step(options.dt);
    f.all_seconds += std::chrono::duration<double>(Clock::now() - start).count();
    const physics::StepReport& report = world->report(0);
    f.library_seconds += report.library_seconds;
    f.contacts += report.move.contact_count;
    f.inserted += report.inserted;
    f.removed += report.removed;
    f.refused += report.status == DSW_STATUS_OK ? 0 : 1;
    f.exactly_free += physics::verify(world->scene(), catheter->body().id()).good() ? 1 : 0;
    ++f.steps;
  }
  return f;
}

physics::Row row_of(const Options& options, const Figures& f, const physics::Catheter& catheter, double length) {
  const double simulated = static_cast<double>(f.steps) * options.dt;
  physics::Row row;
  row.add("integrator", physics::name_of(options.catheter.body.integrator.method)).add("dt", options.dt);
  row.add("steps", static_cast<double>(f.steps)).add("exactly_free_steps", static_cast<double>(f.exactly_free));
  row.add("vertices", static_cast<double>(catheter.body().count())).add("contacts", static_cast<double>(f.contacts));
  row.add("inserted", static_cast<double>(f.inserted)).add("removed", static_cast<double>(f.removed));
  row.add("refused", static_cast<double>(f.refused));
  row.add("reached_mm", catheter.reached()).add("way_mm", length);
  row.add("largest_stretch", catheter.body().springs.largest_stretch(catheter.body().points.position));
  row.add("realtime_factor", simulated / f.all_seconds);
  row.add("realtime_factor_detection", simulated / f.library_seconds);
  return row;
}

int run(const Options& options) {
  demo_mesh mesh;
  const int code = mesh_make_vessel(options.spacing, &mesh);
  if (code != 0) {
    return code;
  }
  const physics::Environment environment(create_environment(nullptr, &mesh));
  mark_wall(environment.get(), &mesh);
  demo_flow flow;
  physics::check(flow_create(environment.get(), &mesh, &flow), "finding the ways through the vessel");
  mesh_free(&mesh);
  physics::World world(environment.get());
  physics::Catheter catheter(&world, &flow, options.catheter);
  const Figures f = push(options, &world, &catheter);
  const physics::Row row = row_of(options, f, catheter, flow.length);
  flow_destroy(&flow);
  row.write_json(std::cout);
  std::cout << '\n';
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    row.write_json(file);
    file << '\n';
    file.close();
    if (!file) {
      std::cerr << "catheter: cannot write '" << options.json << "'\n";
      return 2;
    }
  }
  return f.exactly_free == f.steps ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const int code = read_options(argc, argv, &options);
  try {
    return code != 0 ? code : run(options);
  } catch (const std::exception& error) {
    std::cerr << "catheter: " << error.what() << '\n';
    return 1;
  }
}
