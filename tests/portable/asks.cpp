#include "asks.h"

#include "defaults.h"

#include <algorithm>

namespace dsw::portable {
namespace {

dsw_volume_id some_hint(const Ground& ground, Rng& rng) {
  if (rng.chance(0.4)) return {0, 0};
  return {rng.below(ground.cells.size()), 1};
}

/// Points one after the other, as batches want them.
class Batch {
 public:
  Batch(const Ground& ground, Rng& rng) : dimension_(ground.dimension), places_(ground, rng) {}
  void add() {
    const Vec from = places_.start(), to = places_.target(from), fixed = places_.start();
    append(from_, from), append(to_, to), append(fixed_, fixed);
  }
  size_t size() const { return from_.size() / dimension_; }
  const double* from() const { return from_.data(); }
  const double* to() const { return to_.data(); }
  const double* fixed() const { return fixed_.data(); }
  const double* from(size_t i) const { return &from_[dimension_ * i]; }
  const double* to(size_t i) const { return &to_[dimension_ * i]; }

 private:
  void append(std::vector<double>& list, const Vec& p) {
    list.insert(list.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(dimension_));
  }

  size_t dimension_;
  GroundPlaces places_;
  std::vector<double> from_, to_, fixed_;
};

void ask_path(const dsw_environment* environment, const Batch& batch, const dsw_cast_options& options, Sum& sum) {
  std::vector<dsw_crossing> crossings(8);
  dsw_flight flight = {};
  size_t count = 0;
  dsw_status status = DSW_STATUS_OK;
  for (int tries = 0; tries < 2; ++tries) {
    crossings.resize(std::max(count, crossings.size()));
    status = dsw_environment_cast_path(environment, {0, 0}, batch.from(0), batch.to(0), &options, crossings.data(),
                                       crossings.size(), &count, &flight);
    if (status != DSW_STATUS_BUFFER_TOO_SMALL) break;
  }
  sum << status;
  if (status == DSW_STATUS_OK) sum.list(crossings.data(), count) << flight;
}

void ask_location(const dsw_environment* environment, const double* point, dsw_volume_id hint, Sum& sum) {
  dsw_volume_id volume = {0, 0};
  dsw_location location = DSW_LOCATION_NONE;
  dsw_cell cell = {};
  sum << dsw_environment_locate(environment, point, hint, &volume, &location) << volume << location;
  if (volume.generation != 0) sum << dsw_environment_classify(environment, point, volume, &cell) << cell;
}

}  // namespace

void ask_casts(const Ground& ground, size_t count, Rng& rng, Tally& tally) {
  constexpr size_t kBatch = 24;
  const dsw_environment* const environment = ground.environment.get();
  for (size_t done = 0; done < count;) {
    Batch batch(ground, rng);
    std::vector<dsw_volume_id> hints;
    while (batch.size() < kBatch) {
      batch.add();
      hints.push_back(some_hint(ground, rng));
    }
    dsw_cast_options options = oracle::defaults(dsw_cast_options_init);
    options.flags = rng.chance(0.2) ? uint32_t{DSW_CAST_NO_DETAIL} : 0;
    options.max_volumes = rng.chance(0.1) ? 1 + rng.below(4) : 0;
    dsw_flight flights[kBatch] = {};
    switch (rng.below(4)) {
      case 0:
        ask_path(environment, batch, options, tally.sum);
        ++done, ++tally.count;
        break;
      case 1:
        ask_location(environment, batch.from(0), hints[0], tally.sum);
        tally.sum << dsw_environment_cast(environment, hints[0], batch.from(0), batch.to(0), &options, flights);
        tally.sum << flights[0];
        ++done, ++tally.count;
        break;
      default:
        tally.sum << dsw_environment_cast_segments(environment, batch.size(), rng.chance(0.5) ? hints.data() : nullptr,
                                                   batch.from(), batch.to(), 0, &options, flights);
        tally.sum << flights;
        done += kBatch, tally.count += kBatch;
    }
  }
}

void ask_sweeps(const Ground& ground, size_t count, Rng& rng, Tally& tally) {
  Batch batch(ground, rng);
  while (batch.size() < count) batch.add();
  dsw_sweep_options options = oracle::defaults(dsw_sweep_options_init);
  options.level = static_cast<dsw_level>(rng.between(1, 3));
  options.max_volumes = rng.chance(0.1) ? 1 + rng.below(6) : 0;
  std::vector<dsw_sweep> sweeps(count);
  tally.sum << dsw_environment_sweep_edges(ground.environment.get(), batch.size(), nullptr, batch.from(), batch.to(),
                                           batch.fixed(), 0, &options, sweeps.data());
  tally.sum.list(sweeps.data(), sweeps.size());
  tally.count += count;
}

void ask_nearest(const Ground& ground, size_t count, Rng& rng, Tally& tally) {
  const dsw_environment* const environment = ground.environment.get();
  Batch batch(ground, rng);
  while (batch.size() < count) batch.add();
  const double radius = ground.size * rng.unit();
  std::vector<dsw_nearest> nearest(count);
  std::vector<dsw_segment_nearest> segments(count);
  std::vector<dsw_volume_id> volumes(count);
  std::vector<dsw_location> locations(count);
  for (size_t i = 0; i < count; ++i) {
    dsw_nearest one = {};
    const dsw_volume_id hint = some_hint(ground, rng);
    tally.sum << dsw_environment_find_nearest(environment, batch.from(i), hint, radius, &one) << one;
  }
  tally.sum << dsw_environment_find_nearest_to_points(environment, batch.from(), count, 0, nullptr, radius,
                                                      nearest.data(), volumes.data(), locations.data());
  tally.sum.list(nearest.data(), count).list(volumes.data(), count).list(locations.data(), count);
  tally.sum << dsw_environment_find_nearest_to_segments(environment, count, nullptr, batch.from(), batch.to(), 0,
                                                        radius, segments.data(), volumes.data(), locations.data());
  tally.sum.list(segments.data(), count).list(volumes.data(), count).list(locations.data(), count);
  tally.count += 3 * count;
}

void ask_pairs(const dsw_context* context, uint32_t dimension, size_t count, Rng& rng, Tally& tally) {
  constexpr size_t kBatch = 24;
  for (size_t done = 0; done < count; done += kBatch) {
    uint8_t kinds[kBatch];
    dsw_pair_touch touches[kBatch] = {};
    std::vector<double> points(2 * kBatch * (dimension + 1) * dimension);
    const bool is_lattice = rng.chance(0.5);
    const double sizes[] = {1, 1e-300, 1e300}, size = sizes[rng.below(3)];
    for (double& x : points) x = is_lattice ? size * rng.between(-2, 2) : size * rng.range(-1, 1);
    for (uint8_t& kind : kinds) kind = static_cast<uint8_t>(dimension == 2 ? 2u : rng.below(2));
    const double *const from = points.data(), *const to = from + points.size() / 2;
    tally.sum << dsw_sweep_pairs(context, dimension, kBatch, kinds, from, to, 0, DSW_PAIRS_RANK, touches) << touches;
    double motions[4][17] = {};
    for (auto& motion : motions) {
      for (size_t k = dimension == 2 ? 2 : 0; k < 8; ++k) {
        const bool is_there = dimension == 3 || (k != 4 && k != 5);
        if (is_there) motion[k] = is_lattice ? rng.between(-2, 2) : rng.range(-1, 1);
      }
      motion[3] += 3;
      motion[7] += 3;
      for (size_t k = 8; k < 17; ++k) motion[k] = (k - 8) % 3 < dimension ? size * rng.between(-1, 1) : 0;
    }
    uint32_t indices[2 * kBatch];
    for (uint32_t& index : indices) index = rng.below(4) == 0 ? UINT32_MAX : static_cast<uint32_t>(rng.below(4));
    tally.sum << dsw_sweep_rigid_pairs(context, dimension, kBatch, kinds, from, to, 0, motions[0], 4, indices,
                                       DSW_PAIRS_RANK, touches)
              << touches;
    tally.count += 2 * kBatch;
  }
}

void ask_for_all(const Ground& ground, Rng& rng, Tally& tally) {
  const dsw_environment* const environment = ground.environment.get();
  dsw_build_report report = {};
  report.struct_size = sizeof report;
  tally.sum << dsw_environment_check(environment, &report) << report;
  dsw_coarsen_options options = oracle::defaults(dsw_coarsen_options_init);
  options.max_faces = static_cast<uint32_t>(rng.between(6, 24));
  dsw_coarsen_report coarsened = {};
  coarsened.struct_size = sizeof coarsened;
  std::vector<uint32_t> map(ground.cells.size());
  dsw_environment* made = nullptr;
  tally.sum << dsw_environment_coarsen(environment, &options, &made, map.data(), map.size(), &coarsened);
  const oracle::EnvironmentPtr coarse(made);
  tally.count += 2;
  if (coarse == nullptr) return;
  tally.sum.all(coarsened.complete, coarsened.volume_count, coarsened.face_count, coarsened.passable_area,
                coarsened.trials);
  tally.sum.list(map.data(), map.size());
  size_t size = 0;
  dsw_environment_save(coarse.get(), nullptr, 0, &size);
  std::vector<uint8_t> block(size);
  dsw_environment_save(coarse.get(), block.data(), size, &size);
  tally.sum.bytes(block.data(), size);
}

}  // namespace dsw::portable
