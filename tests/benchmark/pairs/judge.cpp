#include "judge.h"

#include "../report.h"
#include "../timing.h"
#include "measure.h"
#include "rigid.h"

#include <dartsweep/pairs.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

namespace dsw::pairs {

namespace {

struct Options {
  bool quick = false;
  std::string queries, out = ".";
  std::size_t generated = 0, ask_alone = 0;
  std::uint64_t seed = 1;
};

struct Named {
  std::string name, key;  // the key is empty for ours
  std::unique_ptr<Method> method;
};

struct Kind {
  int number;
  const char *name, *key;
};
constexpr Kind kKinds[] = {{DSW_PAIR_VERTEX_FACE, "vertex-face", "vertex_face"},
                           {DSW_PAIR_EDGE_EDGE, "edge-edge", "edge_edge"},
                           {DSW_PAIR_VERTEX_EDGE, "vertex-edge", "vertex_edge"}};
constexpr Kind kAll = {-1, "", ""};

/** A set and what every method did on it; methods that do not know its kinds have no entry. */
struct Result {
  QuerySet set;
  std::vector<Truth> truths;
  std::vector<Measured> measured;
};

Result run(QuerySet set, const std::vector<Named>& methods, const Options& options) {
  std::printf("%s: %zu queries\n", set.name.c_str(), set.list.size());
  std::fflush(stdout);
  Result result{std::move(set), {}, {}};
  for (Query& query : result.set.list) {
    const Truth truth = exact_truth(query);
    if (!result.set.has_truth) query.set_truth = truth.touches;
    result.truths.push_back(truth);
  }
  const bool plane = !result.set.list.empty() && result.set.list[0].kind == DSW_PAIR_VERTEX_EDGE;
  std::vector<Method*> asked;
  for (const Named& method : methods) {
    if (plane && !method.key.empty()) break;
    asked.push_back(method.method.get());
  }
  MeasureOptions how;
  // Generated queries are many, and some keep peers busy for a second.
  if (options.quick || !result.set.has_truth) how.rounds = 3;
  how.set_budget_ns = result.set.has_truth ? (options.quick ? 5e9 : 6e10) : (options.quick ? 2e9 : 1e10);
  result.measured = measure(result.set.list, asked, how);
  return result;
}

/** What a method did on several sets, as if they were one.
 * @param beside only queries count that this method has answered, too. */
Judged judge_together(const std::vector<Result>& results, std::size_t method, int kind, std::size_t beside) {
  std::vector<Query> queries;
  std::vector<Truth> truths;
  Measured measured;
  for (const Result& result : results) {
    if (std::max(method, beside) >= result.measured.size()) continue;
    const Measured& m = result.measured[method];
    const auto count = static_cast<std::ptrdiff_t>(std::min(m.answers.size(), result.measured[beside].answers.size()));
    queries.insert(queries.end(), result.set.list.begin(), result.set.list.begin() + count);
    truths.insert(truths.end(), result.truths.begin(), result.truths.begin() + count);
    measured.answers.insert(measured.answers.end(), m.answers.begin(), m.answers.begin() + count);
    measured.ns.insert(measured.ns.end(), m.ns.begin(), m.ns.begin() + count);
  }
  return judge(queries, truths, measured, kind);
}

void write_table(const std::string& path, const std::vector<Result>& results, const std::vector<Named>& methods) {
  std::ofstream file(path);
  file << "set,kind,method,queries,touching,missed,invented,late,time_error,time_off_median,time_off_max,ns_median,"
          "ns_p999,ns_max\n";
  for (const Result& result : results) {
    for (const Kind& kind : kKinds) {
      for (std::size_t m = 0; m < result.measured.size(); ++m) {
        const Judged j = judge(result.set.list, result.truths, result.measured[m], kind.number);
        if (j.queries == 0) continue;
        file << result.set.name << ',' << kind.name << ",\"" << methods[m].name << "\"," << j.queries << ','
             << j.touching << ',' << j.missed << ',' << j.invented << ',' << j.late << ',' << j.time_error << ','
             << j.time_off_median << ',' << j.time_off_max << ',' << j.ns_median << ',' << j.ns_p999 << ',' << j.ns_max
             << '\n';
      }
    }
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

/** Nanoseconds of a query if all are asked in one call, on one thread: the least of the rounds. */
double batch_ns(const std::vector<Result>& results, int rounds) {
  std::vector<std::uint8_t> kinds;
  std::vector<double> from, to;
  for (const Result& result : results) {
    for (const Query& query : result.set.list) {
      kinds.push_back(query.kind);
      for (std::size_t i = 0; i < 4; ++i) {
        from.insert(from.end(), query.start[i].begin(), query.start[i].end());
        to.insert(to.end(), query.end[i].begin(), query.end[i].end());
      }
    }
  }
  std::vector<dsw_pair_touch> touches(kinds.size());
  double least = 0;
  for (int round = 0; round < rounds; ++round) {
    const double ns = bench::time_ns([&] {
      if (dsw_sweep_pairs(nullptr, 3, kinds.size(), kinds.data(), from.data(), to.data(), 0, 0, touches.data()) !=
          DSW_STATUS_OK) {
        throw std::runtime_error(dsw_last_error_message());
      }
    });
    least = round == 0 ? ns : std::min(least, ns);
  }
  return least / static_cast<double>(kinds.size());
}

/** The figures of some sets. @return whether every answer of the library is exact. */
bool report_sets(bench::Report& report, const std::string& key, const std::vector<Result>& results,
                 const std::vector<Named>& methods, const std::vector<Kind>& kinds) {
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  bool exact = true;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string mine = key + (methods[m].key.empty() ? "" : methods[m].key + ".");
    const Judged all = judge_together(results, m, kAll.number, m);
    report.set(mine + "queries", number(all.queries));
    report.set(mine + "touching", number(all.touching));
    report.set(mine + "missed", number(all.missed));
    report.set(mine + "false", number(all.invented));
    report.set(mine + "late", number(all.late));
    report.set(mine + "time_error", number(all.time_error));
    report.set(mine + "time_off_max", all.time_off_max);
    if (m == 0) exact = all.missed + all.invented + all.time_error == 0;
    const auto times = [&](const Judged& j, const std::string& suffix) {
      report.set(mine + "ns_median" + suffix, j.ns_median);
      report.set(mine + "ns_mean" + suffix, j.ns_mean);
      report.set(mine + "ns_p999" + suffix, j.ns_p999);
      report.set(mine + "ns_max" + suffix, j.ns_max);
    };
    times(all, "");
    for (const Kind& kind : kinds) {
      const Judged j = judge_together(results, m, kind.number, m);
      if (j.queries > 0) times(j, std::string(".") + kind.key);
    }
    if (m == 0) continue;
    const std::string over = key + "over_" + methods[m].key;
    const auto ours_ns = [&results, m](const Kind& kind) {
      return std::max(judge_together(results, 0, kind.number, m).ns_median, 1.0);
    };
    report.set(over, all.ns_median / ours_ns(kAll));
    for (const Kind& kind : kinds) {
      const Judged theirs = judge_together(results, m, kind.number, m);
      if (theirs.queries == 0) continue;
      report.set(over + "." + kind.key, theirs.ns_median / ours_ns(kind));
    }
  }
  return exact;
}

/** For callgrind: asks the library alone, the first queries of each public set once. */
int ask_alone(const Options& options) {
  const std::unique_ptr<Method> ours = make_ours();
  for (const QuerySet& set : read_sets(options.queries)) {
    for (std::size_t i = 0; i < std::min(set.list.size(), options.ask_alone); ++i) {
      ours->prepare(set.list[i]);
      ours->ask();
    }
  }
  return 0;
}

int run_all(const Options& options, const TightInclusionLibrary& library) {
  std::vector<Named> methods;
  methods.push_back({"Dartsweep", "", make_ours()});
  methods.push_back({"FCL (Newton)", "fcl", make_fcl(true, false)});
  methods.push_back({"FCL (Newton, scaled)", "fcl_scaled", make_fcl(true, true)});
  methods.push_back({"FCL (closed form, scaled)", "fcl_closed", make_fcl(false, true)});
  if (library.vertex_face != nullptr && library.edge_edge != nullptr) {
    methods.push_back({"Tight-Inclusion", "tight_inclusion", make_tight_inclusion(library)});
  } else {
    std::printf("pairs: Tight-Inclusion is not there: it is left out\n");
  }
  bench::Report report;
  bool exact = true;
  std::vector<Result> results;
  if (options.queries.empty()) {
    std::printf("pairs: DARTSWEEP_CCD_QUERIES names no folder: the public sets are left out\n");
  } else {
    std::size_t inexact = 0, differs = 0;
    for (QuerySet& set : read_sets(options.queries)) {
      inexact += set.inexact;
      results.push_back(run(std::move(set), methods, options));
      const Result& result = results.back();
      for (std::size_t i = 0; i < result.truths.size(); ++i) {
        differs += result.truths[i].touches != result.set.list[i].set_truth ? 1 : 0;
      }
    }
    if (results.empty()) throw std::runtime_error(options.queries + ": no queries in this folder");
    exact = report_sets(report, "pairs.", results, methods, {kKinds[0], kKinds[1]});
    report.set("pairs.inexact", static_cast<double>(inexact));
    report.set("pairs.set_differs", static_cast<double>(differs));
    report.set("pairs.batch_ns", batch_ns(results, options.quick ? 3 : 9));
  }
  if (options.generated > 0) {
    std::vector<Result> generated;
    for (QuerySet& set : generate_sets(options.generated, options.seed)) {
      generated.push_back(run(std::move(set), methods, options));
    }
    exact = report_sets(report, "pairs.generated.", generated, methods, {kKinds[0], kKinds[1], kKinds[2]}) && exact;
    exact = report_rigid_pairs(report, options.generated / 20, options.seed) && exact;
    std::move(generated.begin(), generated.end(), std::back_inserter(results));
  }
  if (!results.empty()) write_table(options.out + "/exact_pairs.csv", results, methods);
  if (!report.write(options.out + "/exact_pairs.json")) throw std::runtime_error("cannot write to " + options.out);
  return exact ? 0 : 1;
}

}  // namespace

}  // namespace dsw::pairs

int dartsweep_pairs(int argc, const char* const* argv, void* vertex_face, void* edge_edge) {
  dsw::pairs::Options options;
  const char* folder = std::getenv("DARTSWEEP_CCD_QUERIES");
  if (folder != nullptr) options.queries = folder;
  CLI::App app("Exact times of moving pairs beside peers, on public queries and on generated ones.");
  app.add_option("--queries", options.queries, "Folder with the public sets; DARTSWEEP_CCD_QUERIES if not given");
  app.add_option("--generated", options.generated, "Generated queries");
  app.add_option("--out", options.out, "Folder for exact_pairs.csv and exact_pairs.json");
  app.add_option("--seed", options.seed, "Of generated queries");
  app.add_option("--ask-alone", options.ask_alone, "Asks the library alone so many queries of each public set");
  app.add_flag("--quick", options.quick, "Fewer rounds, less time for peers");
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.ask_alone > 0) return dsw::pairs::ask_alone(options);
    std::filesystem::create_directories(options.out);
    return dsw::pairs::run_all(options, {vertex_face, edge_edge});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pairs: %s\n", error.what());
    return 2;
  }
}
