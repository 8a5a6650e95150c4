// Facets that follow each other round an edge, inside of the piece, are neighbours: so an edge has two triangles, also
// where the piece touches itself there, and what is round a vertex falls into fans. Two edges can then still have the
// same ends; all but one of them are split in the middle.

#include "cutting/surface.h"

#include "base/key_table.h"
#include "base/sort.h"

namespace dsw {
namespace {

/** The facets of the surface with their darts, numbered facet by facet. */
class Net {
 public:
  Net(const Environment<3>& env, const Piece& piece)
      : map_(env.map),
        piece_(piece),
        facets_(env.memory),
        first_(env.memory),
        partners_(env.memory),
        vertices_(env.memory) {
    first_.push_back(0);
    for (size_t i = 0; i < piece.size(); ++i) {
      for (uint32_t f = 0, facets = map_.facets_of(piece[i]); f < facets; ++f) {
        const HalfFacet h = map_.half_facet(piece[i], f);
        if (!piece.is_surface(h)) continue;
        facets_.insert(h.word);
        first_.push_back(first_.back() + map_.shape(piece[i]).facet_size(f));
      }
    }
    partners_.resize(first_.back());
    for (uint32_t f = 0; f < facets_.size(); ++f) {
      for (uint32_t k = first_[f]; k < first_[f + 1]; ++k) partners_[k] = find_partner(dart(f, k));
    }
  }

  uint32_t facet_count() const { return facets_.size(); }
  uint32_t dart_count() const { return first_.back(); }
  HalfFacet facet(uint32_t f) const { return {static_cast<uint32_t>(facets_[f])}; }
  uint32_t first(uint32_t f) const { return first_[f]; }
  uint32_t partner(uint32_t k) const { return partners_[k]; }
  /** The surface's vertex at a dart. */
  uint32_t vertex(uint32_t k) const { return vertices_[k]; }
  Dart dart(uint32_t f, uint32_t k) const {
    const Cell c = map_.cell_of(facet(f));
    return {c, map_.shape(c).facet_first(map_.local_of(facet(f), c)) + k - first_[f]};
  }

  /** One vertex for each fan. */
  void number_vertices(Array<SurfaceVertex>& out) {
    vertices_.assign(dart_count(), kNoCell);
    for (uint32_t f = 0; f < facet_count(); ++f) {
      for (uint32_t k = first_[f]; k < first_[f + 1]; ++k) {
        if (vertices_[k] != kNoCell) continue;
        const Dart d = dart(f, k);
        const uint32_t v = dart_vertex(map_, d);
        for (uint32_t at = k; vertices_[at] == kNoCell; at = next(partners_[at])) {
          vertices_[at] = static_cast<uint32_t>(out.size());
        }
        out.push_back({{v, v}, d.cell});
      }
    }
  }

 private:
  uint32_t facet_of(uint32_t k) const {
    return static_cast<uint32_t>(std::upper_bound(first_.begin(), first_.end(), k) - first_.begin() - 1);
  }
  uint32_t next(uint32_t k) const {
    const uint32_t f = facet_of(k);
    return k + 1 == first_[f + 1] ? first_[f] : k + 1;
  }
  /** The dart of the same edge in the next facet of the surface, on round the edge inside of the piece. It ends: this
   * orbit is a chain between two such facets. */
  uint32_t find_partner(Dart d) const {
    Dart e = beta2(map_, d);
    while (!piece_.is_surface(half_facet(map_, e))) e = beta2(map_, across(e));
    const uint32_t f = facets_.find(half_facet(map_, e).word);
    return first_[f] + e.local - map_.shape(e.cell).facet_first(map_.shape(e.cell).dart_facet(e.local));
  }
  /** beta3, over the cracks that are to be sewn, too. */
  Dart across(Dart d) const {
    const HalfFacet o = piece_.behind(half_facet(map_, d));
    const Cell c = map_.cell_of(o);
    uint32_t e = map_.shape(c).facet_first(map_.local_of(o, c));
    while (dart_vertex(map_, {c, e}) != dart_target(map_, d)) ++e;
    return {c, e};
  }

  const Map<3>& map_;
  const Piece& piece_;
  KeyTable facets_;
  Array<uint32_t> first_;  // dart of each facet; one more at the end
  Array<uint32_t> partners_, vertices_;
};

/** A side of a triangle, from its corner number `side` on. */
struct Side {
  uint64_t ends;
  uint32_t edge;  // what tells edges with the same ends apart
  uint32_t triangle, side;
  bool operator<(const Side& o) const {
    if (ends != o.ends) return ends < o.ends;
    if (edge != o.edge) return edge < o.edge;
    return triangle != o.triangle ? triangle < o.triangle : side < o.side;
  }
};

class Triangles {
 public:
  Triangles(const Environment<3>& env, const Net& net, PieceSurface& out)
      : map_(env.map), net_(net), out_(out), sides_(env.memory), middles_(env.memory), whole_(env.memory) {}

  void make() {
    for (uint32_t f = 0; f < net_.facet_count(); ++f) add_facet(f);
    split_edges();
    for (uint32_t t = 0; t < whole_.size(); ++t) add_parts(whole_[t], &middles_[size_t{t} * 3]);
  }

 private:
  void add_facet(uint32_t f) {
    const HalfFacet h = net_.facet(f);
    const Cell c = map_.cell_of(h);
    const Shape shape = map_.shape(c);
    const uint32_t facet = map_.local_of(h, c), begin = shape.facet_first(facet), size = shape.facet_size(facet);
    const auto place_of = [&](uint32_t local) {
      uint32_t k = 0;
      while (shape.dart_vertex(begin + k) != local) ++k;
      return k;
    };
    for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
      const auto t = static_cast<uint32_t>(whole_.size());
      uint32_t places[3];
      for (uint32_t k = 0; k < 3; ++k) places[k] = place_of(shape.simplices()[3 * s + k]);
      const auto vertex = [&](uint32_t k) { return net_.vertex(net_.first(f) + places[k % 3]); };
      whole_.push_back({{vertex(0), vertex(1), vertex(2)}, h});
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t dart = net_.first(f) + places[k];
        const bool is_inside = places[(k + 1) % 3] != (places[k] + 1) % size;
        const uint32_t edge = is_inside ? net_.dart_count() + f : std::min(dart, net_.partner(dart));
        sides_.push_back({pair_key(vertex(k), vertex(k + 1)), edge, t, k});
      }
    }
  }

  void split_edges() {
    middles_.assign(whole_.size() * 3, kNoCell);
    dsw::sort(sides_.begin(), sides_.end());
    for (size_t i = 1; i < sides_.size(); ++i) {
      const Side &side = sides_[i], &last = sides_[i - 1];
      if (side.ends != last.ends) continue;
      uint32_t& middle = middles_[size_t{side.triangle} * 3 + side.side];
      if (side.edge == last.edge) {
        middle = middles_[size_t{last.triangle} * 3 + last.side];
        continue;
      }
      const SurfaceTriangle& triangle = whole_[side.triangle];
      const uint32_t a = triangle.corners[side.side], b = triangle.corners[(side.side + 1) % 3];
      middle = static_cast<uint32_t>(out_.vertices.size());
      out_.vertices.push_back({{out_.vertices[a].from[0], out_.vertices[b].from[0]}, map_.cell_of(triangle.facet)});
    }
  }

  /** A fan from one of its middles. */
  void add_parts(const SurfaceTriangle& whole, const uint32_t* middles) {
    uint32_t loop[6], size = 0, base = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      loop[size++] = whole.corners[k];
      if (middles[k] == kNoCell) continue;
      base = size;
      loop[size++] = middles[k];
    }
    for (uint32_t k = 1; k + 1 < size; ++k) {
      out_.triangles.push_back({{loop[base], loop[(base + k) % size], loop[(base + k + 1) % size]}, whole.facet});
    }
  }

  const Map<3>& map_;
  const Net& net_;
  PieceSurface& out_;
  Array<Side> sides_;
  Array<uint32_t> middles_;  // three for each triangle: the vertex that splits a side, or kNoCell
  Array<SurfaceTriangle> whole_;
};

}  // namespace

PieceSurface::PieceSurface(const Environment<3>& env, const Piece& piece)
    : vertices(env.memory), triangles(env.memory) {
  Net net(env, piece);
  net.number_vertices(vertices);
  Triangles(env, net, *this).make();
}

}  // namespace dsw
