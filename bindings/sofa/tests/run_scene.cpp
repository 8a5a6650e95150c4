// Runs a scene without a window. Writes a line of JSON: messages, times of a step, and what components of Dartsweep found.
// usage: sofa_run_scene SCENE STEPS [--plugin FILE]... [--path FOLDER]... [--set DATA=VALUE]... [--watch DATA]...
//                       [--forces SOLVER] [--seconds LIMIT]
// --watch writes a Data after each step. --forces sums the normal forces of contacts, of three lines each, that a solver
// with computeConstraintForces has found. --seconds ends the run early.
#include <sofa/core/behavior/BaseMechanicalState.h>
#include <sofa/core/objectmodel/BaseNode.h>
#include <sofa/helper/AdvancedTimer.h>
#include <sofa/helper/logging/ConsoleMessageHandler.h>
#include <sofa/helper/logging/Message.h>
#include <sofa/helper/logging/MessageDispatcher.h>
#include <sofa/helper/logging/MessageHandler.h>
#include <sofa/helper/system/FileRepository.h>
#include <sofa/helper/system/PluginManager.h>
#include <sofa/helper/system/thread/CTime.h>
#include <sofa/simulation/Node.h>
#include <sofa/simulation/Simulation.h>
#include <sofa/simulation/graph/init.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace {

using sofa::helper::AdvancedTimer;
using sofa::helper::Record;
using sofa::helper::logging::Message;

struct Counter : sofa::helper::logging::MessageHandler {
  void process(Message& message) override {
    if (message.type() == Message::Error || message.type() == Message::Fatal) {
      ++errors;
      if (errors <= 5) std::cerr << "error: " << message.sender() << ": " << message.message().str() << "\n";
    }
    if (message.type() == Message::Warning && ++warnings <= 8)
      std::cerr << "warning: " << message.sender() << ": " << message.message().str() << "\n";
  }
  std::string getName() const override { return "Counter"; }
  int errors = 0, warnings = 0;
};

struct Times {
  // Microseconds of the parts of the last step, by name; parts of the same name add up.
  void take() {
    std::map<std::string, double> now;
    std::vector<std::pair<std::string, sofa::helper::system::thread::ctime_t>> open;
    const double scale = 1e6 / static_cast<double>(sofa::helper::system::thread::CTime::getTicksPerSec());
    for (const Record& record : AdvancedTimer::getRecords("Animate")) {
      if (record.type == Record::RSTEP_BEGIN) {
        open.emplace_back(record.label, record.time);
      } else if (record.type == Record::RSTEP_END && !open.empty()) {
        now[open.back().first] += static_cast<double>(record.time - open.back().second) * scale;
        open.pop_back();
      }
    }
    for (const auto& [name, value] : now) all[name].push_back(value);
  }
  std::map<std::string, std::vector<double>> all;
};

// The sum of the normal forces of all contacts, from step to step.
struct Forces {
  void take(const sofa::core::objectmodel::BaseData& data) {
    const auto& lines = static_cast<const sofa::Data<sofa::type::vector<SReal>>&>(data).getValue();
    double total = 0;
    for (std::size_t line = 0; line < lines.size(); line += 3) total += lines[line];
    all.push_back(total);
  }
  void show() const {
    double sum = 0, changes = 0, largest = 0;
    for (std::size_t step = 0; step < all.size(); ++step) {
      const double change = step > 0 ? std::abs(all[step] - all[step - 1]) : 0;
      sum += all[step];
      changes += change;
      largest = std::max(largest, change);
    }
    const double count = static_cast<double>(std::max<std::size_t>(all.size(), 1));
    std::cout << ", \"force mean\": " << sum / count << ", \"force change mean\": " << changes / count
              << ", \"force change largest\": " << largest;
  }
  std::vector<double> all;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

bool is_ours(const sofa::core::objectmodel::BaseComponent& component) {
  return component.getClassName().rfind("Dartsweep", 0) == 0;
}

void show(sofa::simulation::Node& root, const Counter& counter, const Times& times, const Forces& forces, int steps) {
  std::cout << "{\"errors\": " << counter.errors << ", \"warnings\": " << counter.warnings << ", \"steps\": " << steps;
  for (const auto& [name, values] : times.all) {
    if (values.empty()) continue;
    std::cout << ", \"us " << name << "\": " << median(values) << ", \"mean us " << name
              << "\": " << std::accumulate(values.begin(), values.end(), 0.0) / steps;
  }
  if (!forces.all.empty()) forces.show();
  for (auto* component : root.getTreeObjects<sofa::core::objectmodel::BaseComponent>()) {
    if (!is_ours(*component)) continue;
    for (const auto* data : component->getDataFields()) {
      const std::string type = data->getValueTypeString();
      if (std::string(data->getHelp()).rfind("OUTPUT", 0) != 0 || (type != "I" && type != "d")) continue;
      std::cout << ", \"" << component->getName() << "." << data->getName() << "\": " << data->getValueString();
    }
  }
  std::cout << "}" << std::endl;
}

sofa::core::objectmodel::BaseData* find_data(sofa::simulation::Node& root, const std::string& path) {
  const std::size_t dot = path.rfind('.');
  for (auto* component : root.getTreeObjects<sofa::core::objectmodel::BaseComponent>())
    if (component->getName() == path.substr(0, dot)) return component->findData(path.substr(dot + 1));
  return nullptr;
}

struct Options {
  Options(int argc, char** argv) {
    for (int i = 3; i + 1 < argc; i += 2) {
      const std::string name = argv[i], value = argv[i + 1];
      if (name == "--plugin") sofa::helper::system::PluginManager::getInstance().loadPluginByPath(value);
      if (name == "--path") sofa::helper::system::PluginRepository.addFirstPath(value);
      if (name == "--set") settings.emplace_back(value.substr(0, value.find('=')), value.substr(value.find('=') + 1));
      if (name == "--watch") watched.push_back(value);
      if (name == "--forces") forces = value + ".constraintForces";
      if (name == "--seconds") seconds = std::stod(value);
    }
  }
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<std::string> watched;
  std::string forces;
  double seconds = 1e9;
};

// Makes the steps, at most so many and for about so long. Returns their number.
int run(sofa::simulation::Node& root, const Options& options, int steps, Times& times, Forces& forces) {
  AdvancedTimer::setEnabled("Animate", true);
  AdvancedTimer::setInterval("Animate", 1);
  AdvancedTimer::setOutputType("Animate", "gui");
  const auto begin = std::chrono::steady_clock::now();
  for (int step = 0; step < steps; ++step) {
    AdvancedTimer::begin("Animate");
    sofa::simulation::node::animate(&root);
    times.take();
    AdvancedTimer::end("Animate");
    if (!options.forces.empty())
      if (const auto* data = find_data(root, options.forces)) forces.take(*data);
    for (const std::string& path : options.watched)
      if (const auto* data = find_data(root, path))
        std::cerr << "watch " << step << " " << path << " " << data->getValueString() << "\n";
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > options.seconds)
      return step + 1;
  }
  return steps;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  sofa::simulation::graph::init();
  Counter counter;
  sofa::helper::logging::MessageDispatcher::clearHandlers();
  sofa::helper::logging::MessageDispatcher::addHandler(&counter);
  const Options options(argc, argv);
  const sofa::simulation::Node::SPtr root = sofa::simulation::node::load(argv[1]);
  if (!root) return 1;
  for (const auto& [path, value] : options.settings) {
    auto* data = find_data(*root, path);
    if (!data || !data->read(value)) std::cerr << "error: no " << path << "\n", ++counter.errors;
  }
  sofa::simulation::node::initRoot(root.get());
  Times times;
  Forces forces;
  const int steps = run(*root, options, std::stoi(argv[2]), times, forces);
  show(*root, counter, times, forces, steps);
  sofa::simulation::node::unload(root);
  const bool failed = counter.errors > 0;
  sofa::helper::logging::MessageDispatcher::clearHandlers();
  sofa::simulation::graph::cleanup();
  return failed ? 1 : 0;
}
