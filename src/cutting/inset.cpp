// A vertex drawn along d leaves all triangles at it behind if d points behind each of them. Of all such directions the
// one that is farthest from being along a triangle is opposite to the point nearest to the origin of the convex hull of
// their unit normals, which is found as by Gilbert, Johnson and Keerthi ("A fast procedure for computing the distance",
// 1988). Where there is no such direction, as at a saddle, that to the middle of the cells can still do: the better of
// the two comes first.

#include "cutting/inset.h"

#include <initializer_list>

#include "base/search.h"
#include "base/sort.h"
#include "base/vec.h"
#include "walk/cast.h"

namespace dsw {
namespace {

constexpr double kMost = 0.25;  // of the longest edge at a vertex, by which it is drawn in

/** The point of the hull of some points that is nearest to the origin, and which of them it lies between. */
struct Nearest {
  Vec point;
  Vec between[3];
  size_t count = 0;
  double square = HUGE_VAL;

  void take(const Vec& p, std::initializer_list<Vec> of) {
    if (!(dot(p, p) < square)) return;
    point = p;
    square = dot(p, p);
    count = of.size();
    std::copy(of.begin(), of.end(), between);
  }
  void look_at(const Vec& a) { take(a, {a}); }
  void look_at(const Vec& a, const Vec& b) {
    const Vec ab = b - a;
    const double t = -dot(a, ab) / dot(ab, ab);
    if (t > 0 && t < 1) take(a + t * ab, {a, b});
  }
  void look_at(const Vec& a, const Vec& b, const Vec& c) {
    const Vec n = (b - a).cross(c - a);
    const bool inside = dot(a.cross(b), n) > 0 && dot(b.cross(c), n) > 0 && dot(c.cross(a), n) > 0;
    if (inside) take(dot(a, n) / dot(n, n) * n, {a, b, c});
  }
  /** Looks at what `last` and up to three others span. */
  void look_at_all(const Vec* others, size_t size, const Vec& last) {
    look_at(last);
    for (size_t i = 0; i < size; ++i) {
      look_at(others[i], last);
      for (size_t k = 0; k < i; ++k) look_at(others[k], others[i], last);
    }
  }
};

/** Opposite to the nearest point of the normals' hull. It comes nearer in every round, and there are few of them. */
Vec away_from(const Vec* normals, size_t count) {
  Nearest nearest;
  nearest.look_at(normals[0]);
  for (;;) {
    const Vec* first = normals;
    for (const Vec* n = normals; n != normals + count; ++n) {
      if (dot(*n, nearest.point) < dot(*first, nearest.point)) first = n;
    }
    Nearest next;
    next.look_at_all(nearest.between, nearest.count, *first);
    if (!(next.square < nearest.square)) return unit(-1.0 * nearest.point);
    nearest = next;
  }
}

/** How far a direction points behind all triangles: the sine of the least angle. */
double depth(const Vec& direction, const Vec* normals, size_t count) {
  double least = 1;
  for (const Vec* n = normals; n != normals + count; ++n) least = std::min(least, -dot(direction, *n));
  return least;
}

/** To the middle of the cells and away from all normals, the better one first. */
void choose(const Vec& middle, const Array<Vec>& normals, double (&directions)[2][3]) {
  Vec first = unit(middle), second = first;
  if (!normals.empty()) {
    second = away_from(normals.data(), normals.size());
    if (depth(second, normals.data(), normals.size()) > depth(first, normals.data(), normals.size()))
      std::swap(first, second);
  }
  store<3>(first, directions[0]);
  store<3>(second, directions[1]);
}

}  // namespace

Inset::Inset(const Environment<3>& env, const Piece& piece, const PieceSurface& surface)
    : env_(env), surface_(surface), ways_(surface.vertices.size(), Way{}, env.memory) {
  // Corners of triangles, vertex by vertex.
  Array<uint32_t> corners(surface.triangles.size() * 3, 0, env.memory);
  const auto vertex_of = [&](uint32_t corner) { return surface.triangles[corner / 3].corners[corner % 3]; };
  for (uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  dsw::sort(corners.begin(), corners.end(),
            [&](uint32_t a, uint32_t b) { return vertex_of(a) != vertex_of(b) ? vertex_of(a) < vertex_of(b) : a < b; });
  Array<Vec> normals{env.memory};
  const uint32_t* corner = corners.data();
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
    first_.push_back(cells_.size());
    find_cells(piece, v);
    normals.clear();
    ways_[v].shortest = HUGE_VAL;
    for (; corner != corners.data() + corners.size() && vertex_of(*corner) == v; ++corner) {
      const SurfaceTriangle& triangle = surface.triangles[*corner / 3];
      double p[3][3];
      for (uint32_t k = 0; k < 3; ++k) origin(triangle.corners[(*corner + k) % 3], p[k]);
      const Vec a = difference<3>(p[1], p[0]), b = difference<3>(p[2], p[0]);
      ways_[v].shortest = std::min({ways_[v].shortest, length(a), length(b)});
      ways_[v].longest = std::max({ways_[v].longest, length(a), length(b)});
      const Vec normal = unit(unit(a).cross(unit(b)));
      if (!is_zero(normal)) normals.push_back(normal);
    }
    double middle[3];
    find_middle(v, middle);
    choose(to_vec<3>(middle), normals, ways_[v].directions);
  }
  first_.push_back(cells_.size());
}

void Inset::origin(uint32_t vertex, double* position) const {
  const uint32_t* const from = surface_.vertices[vertex].from;
  if (from[0] == from[1]) {
    std::copy_n(env_.point(from[0]), 3, position);
  } else {
    point_at<3>(env_.point(from[0]), env_.point(from[1]), 0.5, position);
  }
}

/** On from one cell through facets at the vertex, or at both of those in whose middle it is. */
void Inset::find_cells(const Piece& piece, uint32_t vertex) {
  const Map<3>& map = env_.map;
  const SurfaceVertex& of = surface_.vertices[vertex];
  const size_t first = cells_.size();
  cells_.push_back(of.cell);
  for (size_t i = first; i < cells_.size(); ++i) {
    const Cell c = cells_[i];
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (piece.is_surface(h)) continue;
      const Shape shape = map.shape(c);
      uint32_t found = 0;
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        const uint32_t v = map.vertex(c, shape.dart_vertex(d));
        found |= (v == of.from[0] ? 1u : 0u) | (v == of.from[1] ? 2u : 0u);
      }
      const Cell beyond = map.cell_of(piece.behind(h));
      if (found == 3 &&
          dsw::find(cells_.begin() + static_cast<std::ptrdiff_t>(first), cells_.end(), beyond) == cells_.end())
        cells_.push_back(beyond);
    }
  }
}

void Inset::find_middle(uint32_t vertex, double* way) const {
  double at[3];
  origin(vertex, at);
  Vec middle;
  for (size_t i = first_[vertex]; i < cells_.size(); ++i) {
    double apex[3];
    centre(env_, cells_[i], apex);
    middle += difference<3>(apex, at);
  }
  store<3>(middle, way);
}

bool Inset::place(uint32_t vertex, uint32_t attempt, double share, double* position, Cell* cell) const {
  double at[3];
  origin(vertex, at);
  const Way& way = ways_[vertex];
  const uint32_t round = attempt / 2;
  const auto scale = static_cast<double>(uint64_t{1} << (round + 1) / 2);
  const double first = share * way.shortest, distance = round % 2 == 1 ? first / scale : first * scale;
  if (round != 0 && distance > kMost * way.longest) return false;
  store<3>(to_vec<3>(at) + distance * to_vec<3>(way.directions[attempt % 2]), position);
  for (size_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
    if (!contains(env_, cells_[i], position)) continue;
    *cell = cells_[i];
    return true;
  }
  return false;
}

}  // namespace dsw
