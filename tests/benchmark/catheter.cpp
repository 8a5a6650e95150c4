// A catheter in a vessel of 200,000 tetrahedra: long edges against Embree, and sliding along the wall. (Figure 9 of
// [JCD10] is examples/paper/catheter_length.cpp.)
#include "parts.h"

#include "chain_case.h"
#include "embree.h"
#include "timing.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

namespace dsw::bench {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector along(const Vector& a, double times, const Vector& b) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}
Vector unit(const Vector& a) {
  const double size = std::sqrt(dot(a, a));
  return {a[0] / size, a[1] / size, a[2] / size};
}
Vector vertex(const std::vector<double>& positions, std::size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

constexpr std::uint32_t kSleeve = 3;  // vertices of a ring

/** A closed tube round the chain: rings joined by triangles, its ends closed by one each. */
BodyShape sleeve(std::size_t rings) {
  BodyShape shape;
  shape.vertices = kSleeve * rings;
  const auto at = [](std::uint32_t ring, std::uint32_t i) { return kSleeve * ring + i % kSleeve; };
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t i = 0; i < kSleeve; ++i) {
      shape.corners.insert(shape.corners.end(), {at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      shape.corners.insert(shape.corners.end(), {at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
  }
  const auto last = static_cast<std::uint32_t>(rings - 1);
  shape.corners.insert(shape.corners.end(), {at(0, 0), at(0, 2), at(0, 1)});
  shape.corners.insert(shape.corners.end(), {at(last, 0), at(last, 1), at(last, 2)});
  return shape;
}

std::vector<double> sleeve_at(const std::vector<double>& chain) {
  constexpr double kRadius = 0.4;
  std::vector<double> positions;
  for (std::size_t i = 0; i < chain.size(); i += 3) {
    for (std::uint32_t k = 0; k < kSleeve; ++k) {
      const double angle = 2.0943951023931953 * k;
      positions.insert(positions.end(),
                       {chain[i], chain[i + 1] + kRadius * std::cos(angle), chain[i + 2] + kRadius * std::sin(angle)});
    }
  }
  return positions;
}

/** What a move casts: every particle on its way, then its edges. */
Segments segments_of(const std::vector<double>& before, const std::vector<double>& targets) {
  Segments segments;
  const std::size_t count = before.size() / 3;
  const auto cast = [&](const double* from, std::size_t v) {
    segments.from.insert(segments.from.end(), from, from + 3);
    segments.to.insert(segments.to.end(), &targets[3 * v], &targets[3 * v] + 3);
  };
  for (std::size_t v = 0; v < count; ++v) {
    cast(&before[3 * v], v);
    if (v > 0) cast(&targets[3 * (v - 1)], v);
    if (v + 1 < count) cast(&before[3 * (v + 1)], v);
  }
  segments.batch = segments.count();
  return segments;
}

using Times = std::map<std::string, std::vector<double>>;

/** Moves variants of a body in turns, and whatever else, in blocks of steps. */
template <typename Targets, typename Beside>
Times time_variants(const VesselCase& vessel, const std::vector<Variant>& variants, const BodyShape& shape,
                    std::size_t steps, Targets&& targets_at, Beside&& beside, Report& report) {
  constexpr std::size_t kBlock = 20;
  std::vector<std::unique_ptr<Flock>> flocks;
  for (const Variant& variant : variants) {
    flocks.push_back(std::make_unique<Flock>(vessel.world.environment(), variant, shape, targets_at(std::size_t{0})));
  }
  Times times;
  std::map<std::string, double> swept, skipped;
  for (std::size_t step = 1; step <= steps; ++step) {
    const auto targets = targets_at(step);
    const auto keep = [&](const std::string& name, double ns) {
      auto& of = times[name];
      if ((step - 1) % kBlock == 0) of.push_back(0.0);
      of.back() += ns / static_cast<double>(kBlock);
    };
    std::vector<double> before;
    std::vector<dsw_volume_id> volumes;
    flocks[0]->places(before, volumes);
    beside(before, targets, keep);
    for (std::size_t i = 0; i < flocks.size(); ++i) {
      Flock& flock = *flocks[(step + i) % flocks.size()];
      keep(flock.variant().name, cpu_time_ns([&] { flock.move(targets.data()); }));
      swept[flock.variant().name] += static_cast<double>(flock.swept());
      skipped[flock.variant().name] += static_cast<double>(flock.skipped());
    }
  }
  for (const Variant& variant : variants) {
    if (variant.flags != 0) {
      report.set("edges.long.skipped_share." + variant.name, skipped[variant.name] / swept[variant.name]);
    }
  }
  return times;
}

void run_long(const VesselCase& vessel, const Options& options, Report& report) {
  const std::size_t steps = options.quick ? 400 : 2000;
  std::unique_ptr<Engine> embree;
  double casts = 0;
  const std::vector<Variant> variants = {{"edges", DSW_LEVEL_EDGES, 0},
                                         {"edges_sequences", DSW_LEVEL_EDGES, DSW_BODY_SEQUENCES},
                                         {"edges_clearance", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_CLEARANCE},
                                         {"swept", DSW_LEVEL_EDGES_SWEPT, 0},
                                         {"swept_sequences", DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SEQUENCES}};
  Times times = time_variants(
      vessel, variants, chain(kChainParticles), steps,
      [&](std::size_t step) { return chain_at(vessel.line, kChainParticles, step); },
      [&](const std::vector<double>& before, const std::vector<double>& targets, const auto& keep) {
        const Segments segments = segments_of(before, targets);
        if (!embree) embree = keep_fastest(make_embrees(vessel.walls), segments);
        casts = static_cast<double>(segments.batch);
        embree->prepare(segments);
        keep("embree", cpu_time_ns([&] { embree->run(0, segments.batch); }));
      },
      report);
  for (const auto& [name, ns] : times) report.set("edges.long.ns_per_cast." + name, median(ns) / casts);
  const auto over = [&](const char* name, const char* below) { return median_ratio(times[name], times[below]); };
  report.set("edges.long.vs_embree", over("embree", "edges_sequences"));
  report.set("edges.long.vs_embree.no_sequences", over("embree", "edges"));
  report.set("edges.long.vs_embree.swept", over("embree", "swept_sequences"));
  report.set("edges.long.vs_embree.swept_no_sequences", over("embree", "swept"));
  report.set("edges.swept_over_edges.catheter", over("swept", "edges"));
  report.set("edges.swept_over_edges.catheter_sequences", over("swept_sequences", "edges"));

  const std::vector<Variant> surfaces = {{"edges", DSW_LEVEL_EDGES, 0},
                                         {"faces", DSW_LEVEL_FACES, 0},
                                         {"faces_sequences", DSW_LEVEL_FACES, DSW_BODY_SEQUENCES}};
  Times tube = time_variants(
      vessel, surfaces, sleeve(kChainParticles), steps / 4,
      [&](std::size_t step) { return sleeve_at(chain_at(vessel.line, kChainParticles, step + 20)); },
      [](const auto&, const auto&, const auto&) {}, report);
  report.set("edges.faces_over_edges.catheter", median_ratio(tube["faces"], tube["edges"]));
  report.set("edges.faces_over_edges.catheter_sequences", median_ratio(tube["faces_sequences"], tube["edges"]));
}

/** A catheter is pressed on the wall, then pushed along it: vertices that touch aim a little into the facet. */
void run_sliding(const VesselCase& vessel, dsw_response response, const std::string& key, const Options& options,
                 Report& report) {
  constexpr double kPress = 0.5;      // of the step, into the wall
  constexpr double kProgress = 1e-3;  // of the step: less is none
  dsw_move_options moves;
  dsw_move_options_init(&moves, sizeof moves);
  moves.vertex_response = response;
  moves.edge_response = response;
  dsw_move_options pressing = moves;
  pressing.vertex_response = pressing.edge_response = DSW_RESPONSE_SLIDE;
  scenes::Random random(41);
  std::size_t tried = 0, stuck = 0;
  for (int trial = 0; trial < (options.quick ? 40 : 400); ++trial) {
    const Vector aside = unit({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const auto start = static_cast<std::size_t>(random.index(2 * kStroke));
    Flock flock(vessel.world.environment(), {"", DSW_LEVEL_EDGES_SWEPT, 0}, chain(kChainParticles),
                chain_at(vessel.line, kChainParticles, start));
    std::vector<double> at;
    std::vector<dsw_volume_id> volumes;
    const auto shifted = [&](double by) {
      flock.places(at, volumes);
      std::vector<double> targets = at;
      for (std::size_t i = 0; i < targets.size(); ++i) targets[i] += by * aside[i % 3];
      return targets;
    };
    for (int step = 0; step < 60; ++step) flock.move(shifted(0.1).data(), &pressing);
    for (int step = 0; step < 20; ++step) {
      const dsw_body_contact* contacts = nullptr;
      std::size_t count = 0;
      check(dsw_body_get_contacts(flock.scene(), flock.bodies().front(), &contacts, &count));
      std::vector<double> targets = shifted(kPush);
      std::map<std::size_t, Vector> ways;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = contacts[i].vertex.index;
        const Vector normal = {contacts[i].contact.normal[0], contacts[i].contact.normal[1],
                               contacts[i].contact.normal[2]};
        const std::size_t ahead = v == 0 ? 0 : v - 1, behind = v == 0 ? 1 : v;
        const Vector axis = unit(along(vertex(at, ahead), -1.0, vertex(at, behind)));
        const Vector on_wall = along(axis, -dot(axis, normal), normal);
        if (dot(on_wall, on_wall) < 0.01) {
          continue;  // it is pushed straight into the wall
        }
        ways[v] = unit(on_wall);
        const Vector target = along(along(vertex(at, v), kPush, ways[v]), -kPress * kPush, normal);
        std::copy(target.begin(), target.end(), &targets[3 * v]);
      }
      flock.move(targets.data(), &moves);
      std::vector<double> now;
      flock.places(now, volumes);
      for (const auto& [v, way] : ways) {
        ++tried;
        stuck += dot(along(vertex(now, v), -1.0, vertex(at, v)), way) < kProgress * kPush ? 1 : 0;
      }
    }
  }
  report.set("response.sliding_moves" + key, static_cast<double>(tried));
  report.set("response.stuck_share" + key,
             static_cast<double>(stuck) / static_cast<double>(std::max<std::size_t>(tried, 1)));
}

}  // namespace

void run_catheter(const Options& options, Report& report) {
  const std::string line = options.data + "/vessels/vascular_phantom_centreline.csv";
  const bool real = !options.vessel.empty() && std::filesystem::exists(line);
  if (!real) std::printf("  no data: a generated vessel instead of the phantom\n");
  const VesselCase vessel(real ? options.vessel : "", line);
  report.set("edges.catheter.cells", static_cast<double>(vessel.mesh.cell_count()));
  run_long(vessel, options, report);
  run_sliding(vessel, DSW_RESPONSE_SLIDE, "", options, report);
  run_sliding(vessel, DSW_RESPONSE_STOP, ".stop", options, report);
}

}  // namespace dsw::bench
