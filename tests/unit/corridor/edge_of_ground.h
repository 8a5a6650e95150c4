// An edge in an environment that goes on and on, each move from where the last one led.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "body/body.h"
#include "corridor/moving_corridors.h"
#include "edge_ground.h"
#include "locate/locate.h"

namespace dsw::test {

/** Where the corners of the lattice are. kOnLattice: exactly there, as ends of edges often are, so that much is exactly on
 * something. kSheared: about there, so that much is almost on something. kJittered: beside. kMoved: beside, and elsewhere
 * after a while. */
enum class Points { kOnLattice, kSheared, kJittered, kMoved };

struct Kind {
  const char* name;
  int dimension, size[3];
  bool mixed;
  Points points;
  double cells, facets, edges, vertices;  // shares that are marked
  double least_known;                     // of the ways that touch nothing, the share of those that are known to
  double least_followed;                  // of these, those of which the corridor of the end is known
};
inline std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

struct Counts {
  size_t asked = 0, free = 0, by_rings = 0, known = 0, at_ends = 0, clear = 0, followed = 0, facets = 0, most = 0,
         first_found = 0, changes = 0, at_facet = 0;
};

template <int D>
class EdgeOfGround {
 public:
  EdgeOfGround(const Kind& kind, uint64_t seed, Counts& counts)
      : kind_(kind),
        random_(seed),
        counts_(counts),
        env_(make()),
        obstacles_(*env_),
        corridors_(*env_),
        fresh_(*env_),
        rings_(*env_) {
    obstacles_.collect();
    reserve(body_, 2, 1, 0);
    reserve(other_, 2, 1, 0);
    for (Body<D>* body : {&body_, &other_}) {
      for (int i = 0; i < 2; ++i) add_vertex(*body, env_->point(0), env_->map.cell(0));
      add_edge(*body, 0, 1);
    }
  }

  void run(int starts, int moves) {
    for (int i = 0; i < starts && !testing::Test::HasFatalFailure(); ++i) {
      if (chance(0.3)) change();
      if (!start()) continue;
      for (int k = 0; k < moves && !testing::Test::HasFatalFailure(); ++k) {
        if (propose()) ask();
      }
    }
  }

 private:
  std::unique_ptr<Environment<D>> make() {
    TestMesh<D> mesh;
    const int* const n = kind_.size;
    if constexpr (D == 2) fill(mesh, n[0], n[1], kind_.mixed, random_);
    if constexpr (D == 3) fill(mesh, n[0], n[1], n[2], kind_.mixed, random_);
    for (size_t v = 0; v < mesh.points.size() / D; ++v) place(&mesh.points[D * v]);
    auto env = mesh.build();
    if (kind_.points == Points::kMoved) {
      let_points_move(*env);
      moved_.assign(env->points, env->points + mesh.points.size());
    }
    reserve_vertex_marks(*env);
    for_each_cell(env->map, [&](Cell c) {
      if (chance(kind_.cells)) set_cell_mark(*env, c, true);
      const Shape shape = env->map.shape(c);
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        if (chance(kind_.facets)) set_facet_mark(*env, env->map.half_facet(c, f), true);
      }
      for (uint32_t d = 0; D == 3 && d < shape.dart_count(); ++d) {
        if (chance(kind_.edges)) mark_edge(*env, c, d);
      }
    });
    for (uint32_t v = 0; v < env->map.vertex_count; ++v) {
      if (chance(kind_.vertices)) set_vertex_mark(*env, v, true);
    }
    return env;
  }
  static void mark_edge(Environment<D>& env, Cell c, uint32_t dart) {
    const Shape shape = env.map.shape(c);
    reserve_edge_marks(env, 1);
    set_edge_mark(env, env.map.vertex(c, shape.dart_vertex(dart)),
                  env.map.vertex(c, shape.dart_vertex(shape.beta1(dart))), true);
  }
  /** Where a corner of the lattice is. */
  void place(double* p) {
    if (kind_.points == Points::kOnLattice) return;
    const double jitter = kind_.points == Points::kSheared ? 0 : kind_.mixed ? 0.04 : 0.14;
    for (int k = 0; k < D; ++k) p[k] += jitter * side();
    double sheared[D];
    for (int k = 0; k < D; ++k) {
      sheared[k] = p[k];
      for (int j = 0; j < D; ++j) sheared[k] += j == k ? 0 : (0.01371 * (j + 1) - 0.0253 * k) * p[j];
    }
    std::copy_n(sheared, D, p);
  }
  /** Something becomes impassable, or passable again, or points are elsewhere. What is kept of the edge stays. */
  void change() {
    const Cell c = env_->map.cell(static_cast<uint32_t>(random_.below(static_cast<int>(env_->map.cell_count))));
    const Shape shape = env_->map.shape(c);
    const auto facet = static_cast<uint32_t>(random_.below(static_cast<int>(shape.facet_count())));
    const bool on = chance(0.5);
    const Array<uint32_t>& kept = body_.corridors[0].facets;
    if (kind_.cells > 0) set_cell_mark(*env_, c, on);
    if (kind_.facets > 0) set_facet_mark(*env_, env_->map.half_facet(c, facet), on);
    if (kind_.facets > 0 && !kept.empty() && kept[0] != kNoFacet && on)
      set_facet_mark(*env_, {kept[kept.size() / 2]}, on);
    if (kind_.edges > 0 && on) mark_edge(*env_, c, shape.facet_first(facet));
    if (kind_.vertices > 0) set_vertex_mark(*env_, env_->map.vertex(c, 0), on);
    if (kind_.points == Points::kMoved) {
      for (size_t i = 0; i < moved_.size(); ++i) moved_[i] = env_->owned_points[i] + 0.02 * side();
      env_->points = moved_.data();
      env_->note_move();
      env_->checked.forget_all();
    }
    obstacles_.collect();
    ++counts_.changes;
  }

  bool chance(double share) { return random_.unit() < share; }
  double side() { return 2 * random_.unit() - 1; }
  /** Often exactly on something. */
  Point<D> rounded(Point<D> p) {
    if (kind_.points != Points::kOnLattice || chance(0.2)) return p;
    const double unit = random_.below(3) == 0 ? 1 : random_.below(2) == 0 ? 0.5 : 0.125;
    for (double& x : p) x = unit * std::round(x / unit);
    return p;
  }
  Point<D> mix(const Point<D>& a, const Point<D>& b, double share) const {
    Point<D> p;
    for (size_t k = 0; k < D; ++k) p[k] = a[k] + share * (b[k] - a[k]);
    return p;
  }
  Point<D> beside(Point<D> p, double reach) {
    for (double& x : p) x += reach * side();
    return p;
  }
  Cell cell_at(const Point<D>& p) {
    if (!env_->has_moved()) return locate(*env_, p.data(), Cell{}, nullptr).cell;
    Cell found;  // the tree of boxes is that of before
    for_each_cell(env_->map, [&](Cell c) { found = !found.valid() && contains(*env_, c, p.data()) ? c : found; });
    return found;
  }
  CastResult fly(const Point<D>& from, const Point<D>& to, Cell start) const {
    return cast(*env_, from.data(), to.data(), start);
  }

  /** Another place for the edge: anywhere, round an obstacle, or where it was, with the same cells. What is kept of it
   * stays. */
  bool start() {
    const int how = random_.below(4);
    for (int tries = 0; tries < 50; ++tries) {
      Point<D> ends[2];
      if (how == 0 && place_of(0).valid()) {
        for (uint32_t i = 0; i < 2; ++i) ends[i] = rounded(beside(at(i), 0.2));
      } else if (how == 1) {
        // An edge on a lattice is placed so that it often touches the obstacle.
        const Point<D> any = anywhere(), x = beside(of_obstacle(any), chance(0.5) ? 0 : chance(0.5) ? 0.2 : 1e-9);
        const double most = chance(0.5) ? 1 : 6;
        Point<D> way;
        for (double& each : way) each = chance(0.3) ? side() : (random_.below(9) - 4) / 8.0;
        for (const int sign : {-1, 1}) {
          const double length =
              kind_.points == Points::kOnLattice ? std::ceil(most * random_.unit()) : most * random_.unit();
          for (size_t k = 0; k < D; ++k) ends[sign > 0][k] = x[k] + sign * length * way[k];
        }
      } else {
        ends[0] = rounded(anywhere());
        ends[1] = rounded(chance(0.2) ? beside(ends[0], 1) : anywhere());
      }
      const Cell first = cell_at(ends[0]);
      if (!first.valid() || is_closed(*env_, first)) continue;
      const CastResult between = fly(ends[0], ends[1], first);
      if (between.end != CastEnd::kReached) continue;
      if (how == 0 && (first != place_of(0) || between.cell != place_of(1))) continue;
      for (Body<D>* body : {&body_, &other_}) {
        put_vertex(*body, 0, ends[0].data(), first);
        put_vertex(*body, 1, ends[1].data(), between.cell);
      }
      return true;
    }
    return false;
  }
  Cell place_of(uint32_t i) const { return body_.vertices[i].cell; }
  Point<D> at(uint32_t i) const {
    Point<D> p;
    std::copy_n(body_.position(i), D, p.begin());
    return p;
  }
  Point<D> anywhere() {
    Point<D> p;
    for (size_t k = 0; k < D; ++k) p[k] = env_->lower[k] + random_.unit() * (env_->upper[k] - env_->lower[k]);
    return p;
  }
  /** A place on an obstacle that is near a point, more often than not inside of the environment. */
  Point<D> of_obstacle(const Point<D>& point) {
    const bool inner = chance(0.8);
    const double share = random_.below(3) * 0.5, any = random_.unit();
    double least = 1e300;
    Point<D> nearest = point;
    for (const auto& line : obstacles_.lines()) {
      if ((line.is_outer && inner) || chance(0.5)) continue;
      Point<D> ends[2];
      for (int i = 0; i < 2; ++i) std::copy_n(env_->point(line.ends[i]), D, ends[i].begin());
      const Point<D> x = mix(ends[0], ends[1], any < 0.5 ? share : any);
      double distance = 0;
      for (size_t k = 0; k < D; ++k) distance = std::max(distance, std::fabs(x[k] - point[k]));
      if (distance >= least) continue;
      least = distance;
      nearest = x;
    }
    return nearest;
  }

  /** Chooses where both ends go. Whether both paths are free. */
  bool propose() {
    for (int tries = 0; tries < 4; ++tries) {
      way_ = {{at(0), at(1)}, {at(0), at(1)}};
      choose_ends();
      if (chance(0.1)) way_.to[random_.below(2)] = way_.from[0];
      if (chance(0.1)) way_.to[1] = way_.from[1];
      bool is_free = true;
      for (uint32_t i = 0; i < 2; ++i) {
        ends_[i].start = body_.position(i);
        ends_[i].end = way_.to[i].data();
        ends_[i].from = ends_[i].arrival = place_of(i);
        if (way_.from[i] == way_.to[i]) continue;  // what its last path crossed stays
        const CastResult path = fly(way_.from[i], way_.to[i], place_of(i));
        is_free = is_free && path.end == CastEnd::kReached;
        ends_[i].arrival = path.end == CastEnd::kReached ? path.cell : Cell{};
        ends_[i].crossed = path_facets(env_->map, place_of(i), path);
      }
      if (is_free) return true;
    }
    return chance(0.2);
  }
  void choose_ends() {
    Point<D>&p = way_.to[0], &q = way_.to[1];
    const Point<D> from[2] = {p, q};
    const double reach = std::array<double, 5>{1e-13, 0.05, 0.2, 0.6, 1.5}[static_cast<size_t>(random_.below(5))];
    switch (random_.below(8)) {
      case 0:  // each for itself
        for (Point<D>& end : way_.to) end = beside(end, reach);
        break;
      case 1: {  // together
        const Point<D> way = beside({}, reach);
        for (Point<D>& end : way_.to) {
          for (size_t k = 0; k < D; ++k) end[k] += way[k];
          if (chance(0.5)) end = beside(end, 0.1 * reach);
        }
        break;
      }
      case 2: {  // round one of its points, up to half a turn, at which it has no length in between
        const double angle = chance(0.2) ? 3.14159265358979 : 3.2 * side() * random_.unit(), share = random_.unit();
        const Point<D> centre = mix(from[0], from[1], share), other = beside(centre, 2);
        for (size_t i = 0; i < 2; ++i) {
          for (size_t k = 0; k < D; ++k) {
            way_.to[i][k] = centre[k] + std::cos(angle) * (from[i][k] - centre[k]) +
                            std::sin(angle) * (i == 0 ? 1 : -1) * (other[k] - centre[k]);
          }
        }
        break;
      }
      case 3:  // along itself, or so that it turns round or has no length
        p = mix(from[0], from[1], chance(0.7) ? reach * side() : random_.below(4) / 2.0);
        q = mix(from[1], from[0], chance(0.7) ? reach * side() : random_.below(4) / 2.0);
        break;
      default: {  // past an obstacle, or hardly so
        const Point<D> y = mix(from[0], from[1], chance(0.3) ? 0.1 * random_.unit() : random_.unit()),
                       x = of_obstacle(y);
        const double share = std::array<double, 6>{0.5, 1 - 1e-9, 1, 1, 1.1, 2}[static_cast<size_t>(random_.below(6))];
        const double shares[2] = {chance(0.2) ? 2 * random_.unit() : 1, chance(0.2) ? 2 * random_.unit() : 1};
        for (size_t i = 0; i < 2; ++i) {
          for (size_t k = 0; k < D; ++k) way_.to[i][k] += shares[i] * share * (x[k] - y[k]);
        }
      }
    }
    for (Point<D>& end : way_.to) end = rounded(end);
  }

  /** Coordinates of a lattice moved by what is small beside it, and large beside rounding: as the shift decides. */
  static bool is_coarse(const Way<D>& way) {
    for (const auto* ends : {way.from, way.to}) {
      for (int i = 0; i < 2; ++i) {
        for (const double x : ends[i]) {
          if (8 * x != std::round(8 * x) || std::fabs(x) >= 32) return false;
        }
      }
    }
    return true;
  }
  static Way<D> shifted(Way<D> way) {
    for (auto* ends : {way.from, way.to}) {
      for (int i = 0; i < 2; ++i) {
        for (size_t k = 0; k < D; ++k) ends[i][k] += std::ldexp(1, -18 - 14 * static_cast<int>(k));
      }
    }
    return way;
  }

  void ask() {
    ++counts_.asked;
    const bool touches = obstacles_.touch(way_);
    counts_.free += touches ? 0 : 1;
    Corridor<D> before = KnownRings<D>::none();
    rings_.passes(way_.from[0], way_.from[1], place_of(0), before);
    const bool rings = rings_.are_free(way_, place_of(0)), known = says_nothing(corridors_, body_);
    check_features();
    const bool is_at_facet = corridors_.keeps_to_facet(ends_);
    SCOPED_TRACE(testing::Message() << describe());
    // Asks again about an edge of which nothing is known.
    other_.corridors.own(0, env_->obstacle_version).clear();
    const bool anew = says_nothing(fresh_, other_);
    ASSERT_TRUE(kind_.mixed || known == anew) << "what was kept matters";
    ASSERT_TRUE(kind_.mixed || known || !rings);
    ASSERT_TRUE(!is_at_facet || known) << "what keeps to one facet is not known";
    counts_.at_facet += is_at_facet ? 1 : 0;
    if (known || anew || rings) {
      ASSERT_TRUE(!touches || may_touch()) << "it touches something";
      ASSERT_FALSE(kind_.points == Points::kOnLattice && is_coarse(way_) && obstacles_.touch(shifted(way_)));
    }
    counts_.by_rings += rings && !touches ? 1 : 0;
    if (!known) return;
    ++counts_.known;
    counts_.at_ends += touches ? 1 : 0;
    for (Body<D>* body : {&body_, &other_}) {
      if (body == &body_ || anew) check_corridor(*body, before);
    }
    if (chance(0.2)) return;  // it does not go there
    for (Body<D>* body : {&body_, &other_}) {
      for (uint32_t i = 0; i < 2; ++i) put_vertex(*body, i, way_.to[i].data(), ends_[i].arrival);
    }
  }
  /** Whether an edge whose paths are free is known to touch nothing. */
  bool says_nothing(MovingCorridors<D>& corridors, Body<D>& body) {
    answer_ = corridors.ask(body.corridors.own(0, env_->obstacle_version), body.call, ends_,
                            {ends_[0].end, ends_[1].end}, true);
    return answer_ == Verdict::kHolds && ends_[0].arrival.valid() && ends_[1].arrival.valid();
  }
  /** What the edge touches first is among what it may touch: on a lattice what the shifted edge touches first. */
  void check_features() {
    if (answer_ != Verdict::kStopsAtRidge || kind_.mixed) return;
    const bool is_on_lattice = kind_.points == Points::kOnLattice;
    if (is_on_lattice && !is_coarse(way_)) return;
    const auto* const first = obstacles_.first_line(is_on_lattice ? shifted(way_) : way_);
    if (first == nullptr) return;
    ++counts_.first_found;
    const CandidateView<D> found = corridors_.features();
    ASSERT_TRUE(std::any_of(found.begin(), found.end(), [&](const Candidate& each) {
      return each.name.vertices[0] == first->ends[0] && each.name.vertices[1] == first->ends[1];
    })) << "what is touched first is not found";
  }
  /** Whether what is touched may count as not touched. */
  bool may_touch() const {
    if (obstacles_.have_an_end(way_)) return true;
    // A polygon may have a corner in the middle of a straight side, along which the edge lies or an end goes.
    const auto touch = [&](const Point<D>(&from)[2], const Point<D>(&to)[2]) {
      return obstacles_.touch({{from[0], from[1]}, {to[0], to[1]}});
    };
    const Point<D>(&from)[2] = way_.from, (&to)[2] = way_.to;
    return kind_.mixed && (touch(from, from) || touch(to, to) || touch({from[0], from[0]}, {to[0], to[0]}) ||
                           touch({from[1], from[1]}, {to[1], to[1]}));
  }
  /** What is kept where a way is known to be free. */
  void check_corridor(Body<D>& body, const Corridor<D>& before) {
    Corridor<D> truth{Array<uint32_t>::allocator_type(nullptr)};
    ASSERT_TRUE(rings_.passes(way_.to[0], way_.to[1], ends_[0].arrival, truth));
    ASSERT_TRUE(truth.portal.back == ends_[1].arrival || truth.facets.empty());
    const auto follows_it = [&](Corridor<D>& each) {
      return dsw::follows(*env_, each, way_.to[0].data(), way_.to[1].data(), ends_[0].arrival, ends_[1].arrival);
    };
    Corridor<D> kept = body.corridors[0];
    ASSERT_TRUE(kept.known());
    const bool follows = follows_it(kept);
    kept.place_count = 0;
    ASSERT_EQ(follows, follows_it(kept)) << "what is remembered of places";
    ASSERT_TRUE(!follows || kept.facets == truth.facets);
    if (!truth.known() || !follows_it(truth)) return;  // nobody can tell
    if (truth.facets == before.facets) return;         // nothing was to be done
    ++counts_.clear;
    counts_.followed += follows ? 1 : 0;
    counts_.facets += truth.facets.size();
    counts_.most = std::max(counts_.most, truth.facets.size());
  }

  std::string describe() const {
    std::string text = kind_.name;
    char number[32];
    for (const auto* ends : {way_.from, way_.to}) {
      for (int i = 0; i < 2; ++i) {
        text += ends == way_.from ? "\nfrom" : "\nto";
        for (const double x : ends[i]) {
          std::snprintf(number, sizeof number, " %.17g", x);
          text += number;
        }
      }
    }
    return text;
  }

  const Kind& kind_;
  Random random_;
  Counts& counts_;
  std::vector<double> moved_;
  std::unique_ptr<Environment<D>> env_;
  Obstacles<D> obstacles_;
  Body<D> body_{nullptr}, other_{nullptr};
  PointWay ends_[2] = {};
  MovingCorridors<D> corridors_, fresh_;
  KnownRings<D> rings_;
  Verdict answer_{};
  Way<D> way_;
};

}  // namespace dsw::test
