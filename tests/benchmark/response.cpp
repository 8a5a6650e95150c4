// How much of the motion that is asked of pressed bodies is made, of what walls without friction would leave.
#include "contact_parts.h"

#include "ours.h"
#include "pressed.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace dsw::bench {

namespace {

/** Options of a move by name. */
struct ResponseVariant {
  std::string suffix;  // of its figures
  dsw_response response;
  bool pulled_first;    // vertices in the order from the end that is pulled, the last
  std::uint32_t flags;  // of the move
};

const std::vector<ResponseVariant> kVariants = {{"", DSW_RESPONSE_SLIDE, false, 0},
                                                {".pulled_first", DSW_RESPONSE_SLIDE, true, 0},
                                                {".stop", DSW_RESPONSE_STOP, false, 0}};

constexpr std::size_t kRuns = 4;
constexpr double kWays[] = {0.02, 0.1};  // that are asked in a step

/** Made and allowed lengths, sums. */
struct Shares {
  double made = 0, allowed = 0;
  std::size_t contacts = 0;
};

class PressedBody {
 public:
  /** @param turn of the whole scene, so that nothing is in line with the axes. */
  PressedBody(const PressedScene& scene, const Eigen::Matrix3d& turn, const ResponseVariant& variant)
      : turn_(turn), world_(turned(scene.mesh, turn), 1), at_(scene.start) {
    dsw_move_options_init(&options_, sizeof options_);
    options_.vertex_response = options_.edge_response = variant.response;
    options_.flags = variant.flags;
    order_.resize(at_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::reverse(order_.begin(), order_.end());
    options_.order = variant.pulled_first ? order_.data() : nullptr;
    options_.order_count = variant.pulled_first ? order_.size() : 0;
    std::vector<std::uint32_t> edges;
    for (std::uint32_t i = 0; i + 1 < at_.size(); ++i) edges.insert(edges.end(), {i, i + 1});
    const Points start = out(at_);
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.positions = start.front().data();
    desc.vertex_count = start.size();
    desc.stride_bytes = sizeof(Point);
    desc.edges = edges.data();
    desc.edge_count = edges.size() / 2;
    desc.level = DSW_LEVEL_EDGES_SWEPT;
    check(dsw_body_create(world_.scene(), &desc, &body_));
  }

  const Points& at() const { return at_; }

  /** Moves all vertices. `shares` gets what the vertices that met something made and could have made. */
  void move(const Points& wanted, const PressedScene& scene, bool counts, Shares& shares) {
    const Points targets = out(wanted), before = at_;
    check(dsw_body_move(world_.scene(), body_, targets.front().data(), targets.size(), sizeof(Point), &options_,
                        nullptr));
    std::size_t slots = 0, count = 0;
    check(
        dsw_body_get_positions(world_.scene(), body_, at_.front().data(), at_.size(), sizeof(Point), nullptr, &slots));
    for (Point& point : at_) point = turn_.transpose() * point;
    const dsw_body_contact* contacts = nullptr;
    check(dsw_body_get_contacts(world_.scene(), body_, &contacts, &count));
    std::vector<Points> met(at_.size());  // normals
    for (std::size_t i = 0; i < count; ++i) {
      met[contacts[i].vertex.index].push_back(turn_.transpose() * Point(contacts[i].contact.normal));
    }
    for (std::size_t v = 0; v < at_.size() && counts; ++v) {
      if (met[v].empty()) continue;
      const Point way = wanted[v] - before[v];
      const Allowed allowed = scene.allowed ? scene.allowed(before[v], wanted[v]) : allowed_by(met[v], way);
      shares.made += std::clamp((at_[v] - before[v]).dot(allowed.direction), 0.0, allowed.length);
      shares.allowed += allowed.length;
      ++shares.contacts;
    }
  }

 private:
  static scenes::VolumeMesh turned(scenes::VolumeMesh mesh, const Eigen::Matrix3d& turn) {
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
      Eigen::Map<Point> point(&mesh.points[i]);
      point = (turn * point).eval();
    }
    return mesh;
  }

  Points out(const Points& points) const {
    Points turned;
    for (const Point& point : points) turned.push_back(turn_ * point);
    return turned;
  }

  Eigen::Matrix3d turn_;
  World world_;
  Points at_;
  std::vector<std::uint32_t> order_;
  dsw_move_options options_{};
  dsw_body_id body_{};
};

void press(const PressedScene& scene, const ResponseVariant& variant, Shares& shares) {
  for (std::size_t run = 0; run < kRuns; ++run) {
    scenes::Random random(71 + run);
    const Point axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double angle = run == 0 ? 0 : random.uniform(0.2, 2);  // one of the runs is in line with the axes
    PressedBody body(scene, Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), variant);
    for (std::size_t step = 0; step < scene.steps; ++step) {
      body.move(scene.targets(step, body.at(), random), scene, step >= scene.first, shares);
    }
  }
}

}  // namespace

void run_response(Report& report) {
  std::vector<std::vector<PressedScene>> all;
  for (const double way : kWays) all.push_back(pressed_scenes(way));
  for (const ResponseVariant& variant : kVariants) {
    double sum = 0, least = 1;
    for (std::size_t i = 0; i < all[0].size(); ++i) {
      double share = 0;
      for (const auto& scenes : all) {
        Shares shares;
        press(scenes[i], variant, shares);
        share += shares.made / shares.allowed / static_cast<double>(all.size());
        std::printf("    %zu moves with contacts, %.4f\n", shares.contacts, shares.made / shares.allowed);
      }
      report.set("response.motion_made_share." + all[0][i].name + variant.suffix, share);
      sum += share;
      least = std::min(least, share);
    }
    report.set("response.motion_made_share" + variant.suffix, sum / static_cast<double>(all[0].size()));
    report.set("response.motion_made_share.least" + variant.suffix, least);
  }
}

}  // namespace dsw::bench
