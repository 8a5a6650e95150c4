// Figure 12 of [JCD10]: a closed surface of 12,000 vertices falls among obstacles in an environment of pyramids,
// presses on them and is lifted again. What edges cost over vertices alone, and what every elimination saves.
#include "parts.h"

#include "embree.h"
#include "fall_case.h"
#include "surface_bodies.h"
#include "timing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace dsw::bench {

namespace {

constexpr std::size_t kBlock = 10;  // steps that are timed together

/** What was cast for a move: every vertex on its way, then its edges from where their other ends were. */
Segments segments_of(const Fall& fall, const std::vector<double>& before, const std::vector<double>& after,
                     const std::vector<double>& targets) {
  Segments segments;
  const auto cast = [&](const double* from, std::size_t v) {
    segments.from.insert(segments.from.end(), from, from + 3);
    segments.to.insert(segments.to.end(), &targets[3 * v], &targets[3 * v] + 3);
  };
  for (std::size_t v = 0; v < fall.shape.vertices; ++v) cast(&before[3 * v], v);
  for (std::size_t e = 0; e < fall.shape.edges.size(); e += 2) {
    const std::size_t a = fall.shape.edges[e], b = fall.shape.edges[e + 1];
    cast(&before[3 * b], a);  // a < b: b has not moved when it is a's turn
    cast(&after[3 * a], b);
  }
  segments.batch = segments.count();
  return segments;
}

/** Casts that a body does not make, since with no flag set an edge that stays in one convex cell is seen to be free: 6.1 for
 * nothing. Of a move from one place to another, as in segments_of. */
struct Spared {
  std::vector<double> from, to;
  std::vector<dsw_volume_id> starts;
  std::vector<dsw_flight> flights;

  void find(const Fall& fall, const std::vector<double>& before, const std::vector<dsw_volume_id>& left,
            const std::vector<double>& after, const std::vector<dsw_volume_id>& reached) {
    from.clear(), to.clear(), starts.clear();
    const auto add = [&](const double* a, dsw_volume_id in, const double* b, dsw_volume_id end) {
      if (in.index != end.index) return;
      from.insert(from.end(), a, a + 3);
      to.insert(to.end(), b, b + 3);
      starts.push_back(in);
    };
    for (std::size_t e = 0; e < fall.shape.edges.size(); e += 2) {
      const std::size_t a = fall.shape.edges[e], b = fall.shape.edges[e + 1];
      add(&after[3 * a], reached[a], &before[3 * b], left[b]);
      add(&after[3 * b], reached[b], &after[3 * a], reached[a]);
    }
    flights.resize(starts.size());
  }
  void cast(const World& world) {
    dsw_cast_options options;
    dsw_cast_options_init(&options, sizeof options);
    options.flags = DSW_CAST_START_KNOWN | DSW_CAST_NO_DETAIL;
    check(dsw_environment_cast_segments(world.environment(), starts.size(), starts.data(), from.data(), to.data(), 0,
                                        &options, flights.data()));
  }
};

/** Edges of a body that meet something where it is. */
std::size_t count_not_free(const Fall& fall, const World& world, const Flock& flock) {
  std::vector<double> at, from, to;
  std::vector<dsw_volume_id> volumes, starts;
  flock.places(at, volumes);
  for (std::size_t e = 0; e < fall.shape.edges.size(); e += 2) {
    const std::size_t a = fall.shape.edges[e], b = fall.shape.edges[e + 1];
    from.insert(from.end(), &at[3 * a], &at[3 * a] + 3);
    to.insert(to.end(), &at[3 * b], &at[3 * b] + 3);
    starts.push_back(volumes[a]);
  }
  std::vector<dsw_flight> flights(starts.size());
  check(dsw_environment_cast_segments(world.environment(), starts.size(), starts.data(), from.data(), to.data(), 0,
                                      nullptr, flights.data()));
  return static_cast<std::size_t>(std::count_if(flights.begin(), flights.end(),
                                                [](const dsw_flight& f) { return f.outcome != DSW_OUTCOME_REACHED; }));
}

std::set<std::uint32_t> touched(const Flock& flock) {
  const dsw_body_contact* contacts = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_contacts(flock.scene(), flock.bodies().front(), &contacts, &count));
  std::set<std::uint32_t> vertices;
  for (std::size_t i = 0; i < count; ++i) vertices.insert(contacts[i].vertex.index);
  return vertices;
}

/** @param count of variants. */
void run_fall(const std::string& path, double cube, std::size_t count, const std::string& prefix,
              const Options& options, Report& report) {
  const Fall fall = make_fall(path, cube);
  World world(fall.pyramids.mesh, 1);
  mark_obstacles(world, fall);
  const WallMesh walls(fall.pyramids.mesh.points, scenes::pyramid_walls(fall.pyramids));
  report.set(prefix + "vertices", static_cast<double>(fall.shape.vertices));
  report.set(prefix + "cells", static_cast<double>(fall.pyramids.mesh.cell_count()));

  std::map<std::string, std::unique_ptr<Flock>> flocks;
  for (std::size_t i = 0; i < count; ++i) {
    const Variant& variant = fall_variants()[i];
    flocks[variant.name] = std::make_unique<Flock>(world.environment(), variant, fall.shape, fall.surface.points);
  }
  std::unique_ptr<Engine> embree;
  std::map<std::string, std::vector<double>> times;  // of each block
  std::map<std::string, std::size_t> swept, skipped;
  std::size_t contacts = 0, stops = 0, spared_casts = 0;
  Spared spared;
  struct Lost {
    std::size_t missed = 0, not_free = 0;
  };
  std::map<std::string, Lost> lossy = {
      {"back_edge", {}}, {"hybrid", {}}, {"similar_motion", {}}, {"paper_62", {}}, {"paper_63", {}}};
  const std::size_t steps = options.quick ? 60 : 360;
  const double per_block = static_cast<double>(fall.shape.vertices * kBlock);
  for (std::size_t step = 1; step <= steps; ++step) {
    const auto targets = place(fall, step);
    std::vector<double> before, after;
    std::vector<dsw_volume_id> left, reached;
    flocks["edges"]->places(before, left);
    const bool new_block = (step - 1) % kBlock == 0;
    const auto keep = [&](const std::string& name, double ns) {
      auto& of = times[name];
      if (new_block) of.push_back(0.0);
      of.back() += ns / per_block;
    };
    for (auto& [name, flock] : flocks) {
      keep(name, cpu_time_ns([&, at = flock.get()] { at->move(targets.data()); }));
      swept[name] += flock->swept();
      skipped[name] += flock->skipped();
    }
    flocks["edges"]->places(after, reached);
    spared.find(fall, before, left, after, reached);
    spared_casts += spared.starts.size();
    keep("spared", cpu_time_ns([&] { spared.cast(world); }));
    const Segments segments = segments_of(fall, before, after, targets);
    if (!embree) embree = keep_fastest(make_embrees(walls), segments);
    embree->prepare(segments);
    keep("embree", cpu_time_ns([&] { embree->run(0, segments.batch); }));

    const auto all = touched(*flocks["edges"]);
    contacts += all.size();
    stops += flocks["edges"]->stopped();
    for (auto& [name, of] : lossy) {
      const auto seen = touched(*flocks["edges_" + name]);
      for (const std::uint32_t v : all) of.missed += seen.count(v) == 0 ? 1 : 0;
      of.not_free += count_not_free(fall, world, *flocks["edges_" + name]);
    }
  }
  for (const auto& [name, ns] : times) report.set(prefix + "ns." + name, median(ns));
  for (const auto& [name, times_skipped] : skipped) {
    if (times_skipped != 0) {
      const bool of_edges = name.rfind("edges_", 0) == 0;
      report.set(prefix + "skipped_share." + (of_edges ? name.substr(6) : name),
                 static_cast<double>(times_skipped) / static_cast<double>(swept[name]));
    }
  }
  const auto over = [&](const std::string& name, const std::string& below) {
    return median_ratio(times[name], times[below]);
  };
  std::vector<double> none = times["edges"];
  for (std::size_t i = 0; i < none.size(); ++i) none[i] += times["spared"][i];
  report.set(prefix + "none", median_ratio(none, times["points"]));
  report.set(prefix + "spared_casts_share",
             static_cast<double>(spared_casts) / static_cast<double>(steps * fall.shape.edges.size()));
  report.set(prefix + "paper_62", over("edges_paper_62", "points"));
  report.set(prefix + "paper_63", over("edges_paper_63", "points"));
  report.set(prefix + "back_edge_over_edges", over("edges_back_edge", "edges"));
  report.set(prefix + "overhead", over("edges", "points"));
  report.set(prefix + "overhead_environment", over("edges_environment", "points"));
  report.set(prefix + "overhead_back_edge", over("edges_back_edge", "points"));
  report.set(prefix + "overhead_hybrid", over("edges_hybrid", "points"));
  report.set(prefix + "overhead_similar_motion", over("edges_similar_motion", "points"));
  if (times.count("swept") != 0) {
    report.set(prefix + "overhead_clearance", over("edges_clearance", "points"));
    report.set(prefix + "overhead_sequences", over("edges_sequences", "points"));
    report.set(prefix + "swept_over_edges", over("swept", "edges"));
    report.set(prefix + "faces_over_edges", over("faces", "edges"));
    report.set(prefix + "vs_embree.sequences", over("embree", "edges_sequences"));
    report.set(prefix + "vs_embree.swept", over("embree", "swept"));
  }
  report.set(prefix + "vs_embree", over("embree", "edges"));
  report.set(prefix + "vs_embree.environment", over("embree", "edges_environment"));
  report.set(prefix + "vs_embree.hybrid", over("embree", "edges_hybrid"));
  report.set(prefix + "contacts", static_cast<double>(contacts));
  report.set(prefix + "stopped_share", static_cast<double>(stops) / static_cast<double>(steps * fall.shape.vertices));
  for (const auto& [name, of] : lossy) {
    report.set(prefix + name + "_missed_share",
               static_cast<double>(of.missed) / static_cast<double>(std::max<std::size_t>(contacts, 1)));
    report.set(prefix + name + "_not_free_after", static_cast<double>(of.not_free));
  }
}

}  // namespace

void run_fig12(const Options& options, Report& report) {
  const std::string path = hand_path(options.data);
  run_fall(path, kFineCube, fall_variants().size(), "edges.fig12.", options, report);
  run_fall(path, kCoarseCube, 8, "edges.fig12.coarse.", options, report);
}

}  // namespace dsw::bench
