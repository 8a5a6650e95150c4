#include "methods.h"

#include <dartsweep/pairs.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dsw::pairs {

namespace {

class Nothing final : public Method {
 public:
  Answer ask() override { return {}; }
};

class Ours final : public Method {
 public:
  Answer ask() override {
    const std::uint32_t dimension = query_->kind == DSW_PAIR_VERTEX_EDGE ? 2 : 3;
    dsw_pair_touch touch;
    const dsw_status status = dsw_sweep_pairs(nullptr, dimension, 1, &query_->kind, query_->start[0].data(),
                                              query_->end[0].data(), sizeof query_->start[0], 0, &touch);
    if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
    return {touch.touches != 0, touch.time};
  }
};

class Fcl final : public Method {
 public:
  Fcl(bool newton, bool scaled) : newton_(newton), scaled_(scaled) {}
  void prepare(const Query& query) override {
    query_ = &query;
    int exponent = 0;
    if (scaled_) {
      double largest = 0;
      for (const auto* points : {&query.start, &query.end}) {
        for (const auto& point : *points) {
          for (const double x : point) largest = std::max(largest, std::fabs(x));
        }
      }
      exponent = largest > 0 ? 10 - std::ilogb(largest) : 0;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<Eigen::Index>(axis);
        start_[i][row] = std::ldexp(query.start[i][axis], exponent);
        end_[i][row] = std::ldexp(query.end[i][axis], exponent);
      }
    }
  }
  Answer ask() override {
    using Test = fcl::detail::Intersect<double>;
    const auto &s = start_, &e = end_;
    Answer answer{};
    fcl::Vector3d point;
    // FCL takes the vertex last.
    answer.touches =
        query_->kind == DSW_PAIR_VERTEX_FACE
            ? Test::intersect_VF(s[1], s[2], s[3], s[0], e[1], e[2], e[3], e[0], &answer.time, &point, newton_)
            : Test::intersect_EE(s[0], s[1], s[2], s[3], e[0], e[1], e[2], e[3], &answer.time, &point, newton_);
    return answer;
  }

 private:
  bool newton_, scaled_;
  std::array<fcl::Vector3d, 4> start_, end_;
};

// A fixed vector of Eigen is its coordinates, and a reference to it is their address.
using TightInclusionTest = bool(const double*, const double*, const double*, const double*, const double*,
                                const double*, const double*, const double*, const double* error, double separation,
                                double* time, double tolerance, double end, long iterations, double* reached,
                                bool no_zero_time, int search);

class TightInclusion final : public Method {
 public:
  explicit TightInclusion(const TightInclusionLibrary& library)
      : vertex_face_(reinterpret_cast<TightInclusionTest*>(library.vertex_face)),
        edge_edge_(reinterpret_cast<TightInclusionTest*>(library.edge_edge)) {}
  Answer ask() override {
    constexpr double kTolerance = 1e-6;
    constexpr long kIterations = 1000000;
    constexpr int kBreadthFirst = 1;
    constexpr double kSingleQuery[3] = {-1, -1, -1};
    const auto &s = query_->start, &e = query_->end;
    TightInclusionTest* test = query_->kind == DSW_PAIR_VERTEX_FACE ? vertex_face_ : edge_edge_;
    Answer answer{};
    double reached = 0;
    answer.touches =
        test(s[0].data(), s[1].data(), s[2].data(), s[3].data(), e[0].data(), e[1].data(), e[2].data(), e[3].data(),
             kSingleQuery, 0, &answer.time, kTolerance, 1, kIterations, &reached, false, kBreadthFirst);
    return answer;
  }

 private:
  TightInclusionTest *vertex_face_, *edge_edge_;
};

}  // namespace

std::unique_ptr<Method> make_nothing() { return std::make_unique<Nothing>(); }
std::unique_ptr<Method> make_ours() { return std::make_unique<Ours>(); }
std::unique_ptr<Method> make_fcl(bool newton, bool scaled) { return std::make_unique<Fcl>(newton, scaled); }
std::unique_ptr<Method> make_tight_inclusion(const TightInclusionLibrary& library) {
  return std::make_unique<TightInclusion>(library);
}

}  // namespace dsw::pairs
