// Runs a scene without a window. Writes a line of JSON: messages, times of a step, and what components of Dartsweep found.
// usage: sofa_run_scene SCENE STEPS [--plugin FILE]... [--set PATH=VALUE]... [--energy PATH]
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
#include <cstring>
#include <iostream>
#include <map>
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

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

bool is_ours(const sofa::core::objectmodel::BaseComponent& component) {
  return component.getClassName().rfind("Dartsweep", 0) == 0;
}

void show(sofa::simulation::Node& root, const Counter& counter, const Times& times, int steps) {
  std::cout << "{\"errors\": " << counter.errors << ", \"warnings\": " << counter.warnings << ", \"steps\": " << steps;
  for (const auto& [name, values] : times.all)
    if (!values.empty()) std::cout << ", \"us " << name << "\": " << median(values);
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  sofa::simulation::graph::init();
  Counter counter;
  sofa::helper::logging::MessageDispatcher::clearHandlers();
  sofa::helper::logging::MessageDispatcher::addHandler(&counter);
  std::vector<std::string> watched;
  std::vector<std::pair<std::string, std::string>> settings;
  for (int i = 3; i + 1 < argc; i += 2) {
    const std::string value = argv[i + 1];
    if (!std::strcmp(argv[i], "--plugin")) {
      sofa::helper::system::PluginManager::getInstance().loadPluginByPath(value);
    } else if (!std::strcmp(argv[i], "--path")) {
      sofa::helper::system::PluginRepository.addFirstPath(value);
    } else if (!std::strcmp(argv[i], "--set")) {
      settings.emplace_back(value.substr(0, value.find('=')), value.substr(value.find('=') + 1));
    } else if (!std::strcmp(argv[i], "--watch")) {
      watched.push_back(value);
    }
  }
  const sofa::simulation::Node::SPtr root = sofa::simulation::node::load(argv[1]);
  if (!root) return 1;
  for (const auto& [path, value] : settings) {
    auto* data = find_data(*root, path);
    if (!data || !data->read(value)) std::cerr << "error: no " << path << "\n", ++counter.errors;
  }
  sofa::simulation::node::initRoot(root.get());
  AdvancedTimer::setEnabled("Animate", true);
  AdvancedTimer::setInterval("Animate", 1);
  AdvancedTimer::setOutputType("Animate", "gui");
  Times times;
  const int steps = std::stoi(argv[2]);
  for (int step = 0; step < steps; ++step) {
    AdvancedTimer::begin("Animate");
    sofa::simulation::node::animate(root.get());
    times.take();
    AdvancedTimer::end("Animate");
    for (const std::string& path : watched)
      if (const auto* data = find_data(*root, path))
        std::cerr << "watch " << step << " " << path << " " << data->getValueString() << "\n";
  }
  show(*root, counter, times, steps);
  sofa::simulation::node::unload(root);
  const bool failed = counter.errors > 0;
  sofa::helper::logging::MessageDispatcher::clearHandlers();
  sofa::simulation::graph::cleanup();
  return failed ? 1 : 0;
}
