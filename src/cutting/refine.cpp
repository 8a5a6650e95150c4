#include "cutting/refine.h"

#include "base/search.h"
#include "base/vec.h"
#include "environment/marking.h"
#include "environment/recut.h"

namespace dsw {
namespace {

/** Vertices nearer to the middle plane than this share of the extent count as on it. */
constexpr double kNear = 0.1;

/** Whether a facet's loop runs from one vertex directly to another. */
bool has_side(const FacetDraft& facet, uint32_t a, uint32_t b) {
  const uint32_t at = facet.place_of(a);
  return at != facet.loop.size() && facet.after(at) == b;
}

}  // namespace

/** The plane in the middle of a piece, and on which side of it vertices are. */
struct Refinement::Plane {
  Array<uint32_t> vertices;
  Array<uint32_t> corners;  // of the piece's faces, by their places in `vertices`
  Array<int> sides;         // of vertices; 0: they count as on it
  Array<double> levels;     // above the plane

  explicit Plane(const Memory* memory) : vertices(memory), corners(memory), sides(memory), levels(memory) {}

  /** On which side a vertex is. One that came with a cut is on the plane. */
  int side_of(uint32_t vertex) const {
    const auto i = static_cast<size_t>(dsw::find(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    return i == vertices.size() ? 0 : sides[i];
  }
  /** On which side a facet is whose vertices are on one side. */
  int side_of(const FacetDraft& facet) const {
    int side = 0;
    for (size_t k = 0; side == 0 && k < facet.loop.size(); ++k) side = side_of(facet.loop[k]);
    return side;
  }
  /** The place on an edge between vertices in two places: in the middle if that is near enough. */
  Place place_between(uint32_t i, uint32_t j) const {
    if (vertices[i] > vertices[j]) std::swap(i, j);
    const double share = levels[i] / (levels[i] - levels[j]);
    return {vertices[i], vertices[j], std::fabs(share - 0.5) < kNear ? 0.5 : share};
  }
};

Refinement::Refinement(Environment<3>& env, const Blade<3>& blade, const Crossings<3>& crossings, double finest)
    : env_(env), map_(env.map), blade_(blade), crossings_(crossings), finest_(finest), record_(env.memory) {}

/** Where something comes out invalid, cells stay whole and all is written anew: each time more of them, so this
 * ends. */
void Refinement::prepare(std::optional<Edit<3>>& edit) {
  Array<uint32_t> invalid{env_.memory};
  for (;;) {
    edit.emplace(env_);
    if (!run(*edit)) continue;
    write(*edit);
    invalid.clear();
    edit->prepare(&invalid);
    if (invalid.empty()) break;
    for (const uint32_t draft : invalid) keep_whole(drafted_[draft]);
  }
  write_record(*edit);
}

/** False: a cell has to stay whole first. */
bool Refinement::run(Edit<3>& edit) {
  for (KeyTable* table : {&root_numbers_, &face_numbers_, &edges_, &marked_, &gone_}) table->clear();
  roots_.clear();
  pieces_.clear();
  faces_by_number_.clear();
  faces_.clear();
  first_of_edge_.clear();
  of_edges_.clear();
  record_.vertices.clear();
  pairs_ = 0;
  Array<uint32_t> waiting{env_.scratch.memory()};
  for (uint32_t i = crossings_.cell_count(); i-- != 0;) {
    const MetCell& met = crossings_.cell(i);
    if (met.invalid || !map_.marked(met.cell) || kept_.find(met.cell.unit) != KeyTable::kNone) continue;
    const uint32_t piece = read_cell(met.cell);
    roots_[pieces_[piece].root].splits = true;
    set_axes(piece);
    crossings_.for_each_simplex(i, [&](uint32_t simplex) { pieces_[piece].simplices.push_back(simplex); });
    waiting.push_back(piece);
  }
  // All pieces of one size before smaller ones: what is beside a piece then has few vertices on its faces.
  for (size_t next = 0; next < waiting.size(); ++next) {
    const uint32_t piece = waiting[next];
    switch (halve(edit, piece)) {
      case Halved::kFailed:
        kept_.insert(roots_[pieces_[piece].root].cell.unit);
        return false;
      case Halved::kYes:
        waiting.push_back(piece);
        waiting.push_back(static_cast<uint32_t>(pieces_.size() - 1));
        break;
      case Halved::kNo:
        break;
    }
  }
  return true;
}

/** The first piece of a cell. */
uint32_t Refinement::read_cell(Cell c) {
  const uint32_t root = root_numbers_.insert(c.unit);
  if (root != roots_.size()) return roots_[root].piece;
  CellDraft draft = draft_of(env_, c);
  const Memory* const memory = env_.scratch.memory();
  const auto piece = static_cast<uint32_t>(pieces_.size());
  roots_.push_back({c, piece, {}, false, false});
  pieces_.push_back({root, 0, false, Array<uint32_t>{memory}, Array<uint32_t>{memory}});
  for (FacetDraft& facet : draft.facets) {
    const uint32_t near = facet.near.word, far = facet.far.word;
    const uint32_t number = face_numbers_.insert(facet.far.valid() ? std::min(near, far) : near);
    if (number != faces_by_number_.size()) {
      faces_[faces_by_number_[number]].pieces[1] = piece;
      pieces_[piece].faces.push_back(faces_by_number_[number]);
      continue;
    }
    const auto face = static_cast<uint32_t>(faces_.size());
    faces_by_number_.push_back(face);
    faces_.push_back({std::move(facet), {piece, kNone}});
    if (faces_[face].facet.far.valid()) faces_[face].pieces[1] = kUnread;
    pieces_[piece].faces.push_back(face);
    add_edges(face);
  }
  return piece;
}

/** The longest edge, the longest edge seen along that one, and what is normal to both. */
void Refinement::set_axes(uint32_t piece) {
  const auto longest = [&](auto seen) {
    Vec best;
    double most = 0;
    for (const uint32_t face : pieces_[piece].faces) {
      const FacetDraft& facet = faces_[face].facet;
      for (uint32_t k = 0; k < facet.loop.size(); ++k) {
        const Vec edge = seen(difference<3>(env_.point(facet.after(k)), env_.point(facet.loop[k])));
        const double size = length(edge);
        if (!(size > most * (1 + 0x1p-20))) continue;  // of edges that are as long but for rounding, the first
        most = size;
        best = edge;
      }
    }
    return unit(best);
  };
  Vec* const axes = roots_[pieces_[piece].root].axes;
  axes[0] = longest([](const Vec& edge) { return edge; });
  axes[1] = longest([&](const Vec& edge) { return edge - axes[0] * dot(edge, axes[0]); });
  axes[2] = unit(axes[0].cross(axes[1]));
}

void Refinement::read_other_side(uint32_t face) {
  if (faces_[face].pieces[1] == kUnread) read_cell(map_.cell_of(faces_[face].facet.far));
}

void Refinement::add_to_edge(uint32_t a, uint32_t b, uint32_t face) {
  const uint32_t edge = edges_.insert(pair_key(a, b));
  if (edge == first_of_edge_.size()) first_of_edge_.push_back(kNone);
  of_edges_.push_back({face, first_of_edge_[edge]});
  first_of_edge_[edge] = static_cast<uint32_t>(of_edges_.size() - 1);
}

void Refinement::add_edges(uint32_t face) {
  for (uint32_t k = 0; k < faces_[face].facet.loop.size(); ++k) {
    const FacetDraft& facet = faces_[face].facet;
    add_to_edge(facet.loop[k], facet.after(k), face);
  }
}

void Refinement::list_vertices_of(uint32_t piece, Array<uint32_t>& out) const {
  out.clear();
  Numbering number(out);
  for (const uint32_t face : pieces_[piece].faces) {
    for (const uint32_t v : faces_[face].facet.loop) number(v);
  }
}

void Refinement::find_centre(uint32_t piece, double* out) const {
  Array<uint32_t> vertices{env_.scratch.memory()};
  list_vertices_of(piece, vertices);
  mean_point<3>(
      static_cast<uint32_t>(vertices.size()), [&](uint32_t i) { return env_.point(vertices[i]); }, out);
}

/** False only if a simplex does not: a box, or the simplex's plane, is between them. */
bool Refinement::may_meet(uint32_t simplex, const Array<uint32_t>& vertices) const {
  const BladeSimplex<3> blade = blade_.simplex(simplex);
  uint32_t common = ~0u;
  for (const uint32_t v : vertices) common &= blade.beyond_box(env_.point(v));
  if (common != 0) return false;
  bool before = false, behind = false;
  for (const uint32_t v : vertices) {
    const int side = blade.side(env_.point(v));
    before = before || side >= 0;
    behind = behind || side <= 0;
    if (before && behind) return true;
  }
  return false;
}

void Refinement::choose_simplices(uint32_t piece, const Array<uint32_t>& from) {
  Array<uint32_t> vertices{env_.scratch.memory()}, found{env_.scratch.memory()};
  list_vertices_of(piece, vertices);
  for (const uint32_t simplex : from) {
    if (may_meet(simplex, vertices)) found.push_back(simplex);
  }
  pieces_[piece].simplices.swap(found);
}

/** The upper half is the last piece then. */
Refinement::Halved Refinement::halve(Edit<3>& edit, uint32_t piece) {
  if (pieces_[piece].simplices.empty()) return Halved::kNo;
  Plane plane(env_.scratch.memory());
  Numbering number(plane.vertices);
  for (const uint32_t face : pieces_[piece].faces) {
    for (const uint32_t v : faces_[face].facet.loop) plane.corners.push_back(number(v));
  }
  struct Way {
    double extent;
    int axis;
  } ways[3];
  const Vec* const axes = roots_[pieces_[piece].root].axes;
  for (int axis = 0; axis < 3; ++axis) ways[axis] = {lay_plane(axes[axis], plane), axis};
  const auto swap_if_longer = [&](int i, int j) {
    if (ways[j].extent > ways[i].extent * (1 + 0x1p-20)) std::swap(ways[i], ways[j]);
  };
  swap_if_longer(0, 1);
  swap_if_longer(1, 2);
  swap_if_longer(0, 1);
  const double most = finest_ * (1 + 0x1p-20);  // halves of what is rounded can be longer
  if (!(ways[0].extent > most)) return Halved::kNo;
  Array<Arc> arcs{env_.scratch.memory()};
  for (const Way& way : ways) {
    if (!(way.extent > most) || pieces_[piece].halvings == kMostHalvings) break;
    lay_plane(axes[way.axis], plane);
    if (find_loop(piece, plane, arcs)) return divide(edit, piece, plane, arcs) ? Halved::kYes : Halved::kFailed;
  }
  pieces_[piece].is_long = true;
  return Halved::kNo;
}

/** Returns the extent along an axis. */
double Refinement::lay_plane(const Vec& axis, Plane& plane) const {
  plane.levels.clear();
  plane.sides.clear();
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const uint32_t v : plane.vertices) {
    const double level = dot(difference<3>(env_.point(v), env_.point(plane.vertices[0])), axis);
    plane.levels.push_back(level);
    lowest = std::min(lowest, level);
    highest = std::max(highest, level);
  }
  const double extent = highest - lowest, middle = lowest + extent / 2, near = kNear * extent;
  for (double& level : plane.levels) {
    level -= middle;
    plane.sides.push_back(level > near ? 1 : level < -near ? -1 : 0);
  }
  return extent;
}

/** The arc across a face that has vertices on both sides of the plane; its corners are those from `first` on. False:
 * that takes more than one. */
bool Refinement::cross_face(uint32_t face, const uint32_t* first, const Plane& plane, Array<Arc>& arcs) const {
  const auto size = static_cast<uint32_t>(faces_[face].facet.loop.size());
  Place places[2] = {};
  uint32_t count = 0, before = first[size - 1];
  bool above = false, below = false;
  for (uint32_t k = 0; k < size; ++k) {
    const uint32_t at = first[k], next = first[k + 1 == size ? 0 : k + 1];
    const int here = plane.sides[at], there = plane.sides[next];
    above = above || here > 0;
    below = below || here < 0;
    const bool on_edge = here * there < 0, on_vertex = here == 0 && plane.sides[before] * there < 0;
    before = at;
    if (!on_edge && !on_vertex) continue;
    const uint32_t v = plane.vertices[at];
    if (count < 2) places[count] = on_edge ? plane.place_between(at, next) : Place{v, v, 0};
    ++count;
  }
  if (!above || !below) return true;
  if (count == 2) arcs.push_back({places[0], places[1], face});
  return count == 2;
}

/** Arcs across faces, and edges on the plane between a face above and one below it, in the order of one loop. False:
 * they are none. */
bool Refinement::find_loop(uint32_t piece, const Plane& plane, Array<Arc>& arcs) const {
  arcs.clear();
  KeyTable above(env_.scratch.memory());  // edges on the plane of faces above it
  for (const int wanted : {1, -1}) {
    const uint32_t* first = plane.corners.data();
    for (const uint32_t face : pieces_[piece].faces) {
      const auto size = static_cast<uint32_t>(faces_[face].facet.loop.size());
      if (wanted > 0 && !cross_face(face, first, plane, arcs)) return false;
      int side = 0;
      for (uint32_t k = 0; side == 0 && k < size; ++k) side = plane.sides[first[k]];
      if (side == 0) return false;
      for (uint32_t k = 0; side == wanted && k < size; ++k) {
        const uint32_t i = first[k], j = first[k + 1 == size ? 0 : k + 1];
        if (plane.sides[i] != 0 || plane.sides[j] != 0) continue;
        const uint32_t a = plane.vertices[i], b = plane.vertices[j];
        if (side > 0) {
          above.insert(pair_key(a, b));
        } else if (above.find(pair_key(a, b)) != KeyTable::kNone) {
          arcs.push_back({{a, a, 0}, {b, b, 0}, kNone});
        }
      }
      first += size;
    }
  }
  return order_arcs(arcs);
}

/** Whether arcs are one loop; they are put in its order, and turned, from the first one on. */
bool Refinement::order_arcs(Array<Arc>& arcs) {
  if (arcs.size() < 3 || arcs.size() > kMostTriangulated) return false;
  for (size_t i = 0; i + 1 < arcs.size(); ++i) {
    const uint64_t at = arcs[i].to.key();
    size_t next = 0, found = 0;
    for (size_t k = i + 1; k < arcs.size(); ++k) {
      if (arcs[k].from.key() != at && arcs[k].to.key() != at) continue;
      next = k;
      ++found;
    }
    if (found != 1) return false;
    std::swap(arcs[i + 1], arcs[next]);
    if (arcs[i + 1].from.key() != at) std::swap(arcs[i + 1].from, arcs[i + 1].to);
  }
  return arcs.back().to.key() == arcs.front().from.key();
}

/** Writes the halves. False: faces have no triangles. */
bool Refinement::divide(Edit<3>& edit, uint32_t piece, const Plane& plane, const Array<Arc>& arcs) {
  Vertices loop(env_.scratch.memory());
  for (const Arc& arc : arcs) loop.push_back(arc.from.is_vertex() ? arc.from.a : split_edge(edit, arc.from));
  for (size_t i = 0; i < arcs.size(); ++i) {
    const uint32_t to = loop[i + 1 == arcs.size() ? 0 : i + 1];
    if (arcs[i].face != kNone && !split_face(arcs[i].face, loop[i], to)) return false;
  }
  const Memory* const memory = env_.scratch.memory();
  const auto upper = static_cast<uint32_t>(pieces_.size());
  const uint32_t root = pieces_[piece].root;
  roots_[root].changed = true;
  ++pieces_[piece].halvings;
  pieces_.push_back({root, pieces_[piece].halvings, false, Array<uint32_t>{memory}, Array<uint32_t>{memory}});
  Array<uint32_t> all{env_.scratch.memory()};
  all.swap(pieces_[piece].faces);
  for (const uint32_t face : all) {
    const int side = plane.side_of(faces_[face].facet);
    pieces_[side > 0 ? upper : piece].faces.push_back(face);
    if (side > 0) faces_[face].pieces[faces_[face].pieces[0] == piece ? 0 : 1] = upper;
  }
  if (!add_face_between(piece, upper, loop)) return false;
  Array<uint32_t> simplices{env_.scratch.memory()};
  simplices.swap(pieces_[piece].simplices);
  choose_simplices(piece, simplices);
  choose_simplices(upper, simplices);
  return true;
}

/** Adds the face between the two halves of a piece. False: it has no triangles. */
bool Refinement::add_face_between(uint32_t lower, uint32_t upper, const Vertices& loop) {
  FacetDraft facet(env_.scratch.memory());
  facet.loop = loop;
  facet.pair = pairs_++;
  for (const uint32_t face : pieces_[lower].faces) {
    if (!runs_along(face, lower, loop[0], loop[1])) continue;
    std::reverse(facet.loop.begin(), facet.loop.end());
    break;
  }
  double apex[3], beyond[3];
  find_centre(lower, apex);
  find_centre(upper, beyond);
  if (!cut_anew(env_, facet, facet.loop, apex, beyond)) return false;
  const auto face = static_cast<uint32_t>(faces_.size());
  faces_.push_back({std::move(facet), {lower, upper}});
  pieces_[lower].faces.push_back(face);
  pieces_[upper].faces.push_back(face);
  add_edges(face);
  return true;
}

/** Whether a face of a piece runs from one vertex directly to another, seen from outside of the piece. */
bool Refinement::runs_along(uint32_t face, uint32_t piece, uint32_t a, uint32_t b) const {
  return faces_[face].pieces[0] == piece ? has_side(faces_[face].facet, a, b) : has_side(faces_[face].facet, b, a);
}

/** A vertex on an edge, where the plane of the piece crosses it. */
uint32_t Refinement::split_edge(Edit<3>& edit, const Place& place) {
  const uint32_t a = place.a, b = place.b, edge = edges_.find(pair_key(a, b));
  double at[3];
  point_at<3>(env_.point(a), env_.point(b), place.share, at);
  const uint32_t middle = edit.add_vertex(at);
  record_.vertices.push_back({middle, a, b, place.share});
  if (edge_marked(env_, a, b) || marked_.find(pair_key(a, b)) != KeyTable::kNone) {
    for (const uint32_t end : {a, b}) marked_.insert(pair_key(end, middle));
  }
  gone_.insert(pair_key(a, b));
  const auto has_edge = [&](uint32_t face) {
    return has_side(faces_[face].facet, a, b) || has_side(faces_[face].facet, b, a);
  };
  // What is read has further faces at the edge, which come before those that are known.
  for (uint32_t first = kNone; first != first_of_edge_[edge];) {
    first = first_of_edge_[edge];
    for (uint32_t i = first; i != kNone; i = of_edges_[i].next) {
      if (has_edge(of_edges_[i].face)) read_other_side(of_edges_[i].face);
    }
  }
  for (uint32_t i = first_of_edge_[edge]; i != kNone; i = of_edges_[i].next) {
    const uint32_t face = of_edges_[i].face;
    if (!has_edge(face)) continue;
    insert_between(faces_[face].facet, a, b, middle);
    mark_changed(face);
    for (const uint32_t end : {a, b}) add_to_edge(end, middle, face);
  }
  return middle;
}

/** False: there are no triangles for one of the parts. */
bool Refinement::split_face(uint32_t face, uint32_t from, uint32_t to) {
  read_other_side(face);
  mark_changed(face);
  const FacetDraft whole = faces_[face].facet;
  FacetDraft parts[2] = {part_of(whole, from, to), part_of(whole, to, from)};
  const uint32_t front = faces_[face].pieces[0], back = faces_[face].pieces[1];
  if (!share_triangles(whole, parts[0], parts[1])) {
    double apex[3], beyond[3];
    find_centre(front, apex);
    if (back != kNone) find_centre(back, beyond);
    for (FacetDraft& part : parts) {
      part.triangles.clear();
      if (part.loop.size() > kMostTriangulated) return false;
      if (!cut_anew(env_, part, part.loop, apex, back != kNone ? beyond : nullptr)) return false;
    }
  }
  const auto other = static_cast<uint32_t>(faces_.size());
  faces_[face].facet = std::move(parts[0]);
  faces_.push_back({std::move(parts[1]), {front, back}});
  pieces_[front].faces.push_back(other);
  if (back != kNone) pieces_[back].faces.push_back(other);
  add_edges(other);
  add_to_edge(from, to, face);
  return true;
}

void Refinement::mark_changed(uint32_t face) {
  for (const uint32_t piece : faces_[face].pieces) {
    if (piece < kUnread) roots_[pieces_[piece].root].changed = true;
  }
}

/** A cell that was halved stays whole; for one that was not, those do with which it shares faces that came. */
void Refinement::keep_whole(uint32_t piece) {
  const auto keep = [&](uint32_t number) {
    const Root& root = roots_[pieces_[number].root];
    if (root.splits) kept_.insert(root.cell.unit);
    return root.splits;
  };
  const uint32_t before = kept_.size();
  if (keep(piece)) return;
  for (const uint32_t face : pieces_[piece].faces) {
    for (const uint32_t other : faces_[face].pieces) {
      if (other < kUnread) keep(other);
    }
  }
  for (uint32_t i = 0; kept_.size() == before && i < pieces_.size(); ++i) keep(i);
}

void Refinement::write(Edit<3>& edit) {
  drafts_.assign(pieces_.size(), 0);
  drafted_.clear();
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    if (roots_[pieces_[i].root].changed) write_piece(edit, i);
  }
  for (uint32_t i = 0; i < marked_.size(); ++i) {
    const uint64_t key = marked_[i];
    if (gone_.find(key) == KeyTable::kNone) {
      edit.set_mark(static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key), true);
    }
  }
}

void Refinement::write_piece(Edit<3>& edit, uint32_t number) {
  const Piece& piece = pieces_[number];
  const Root& root = roots_[piece.root];
  const bool is_first = root.piece == number;
  if (is_first) edit.remove(root.cell);
  CellDraft draft(env_.scratch.memory());
  draft.from = root.cell;
  draft.keeps_index = is_first;
  draft.marked = map_.marked(root.cell);
  draft.region = env_.region(root.cell);
  draft.tag = env_.tag(root.cell);
  draft.facets.reserve(piece.faces.size());
  for (const uint32_t face : piece.faces) {
    const bool is_front = faces_[face].pieces[0] == number;
    draft.facets.push_back(is_front ? faces_[face].facet : turned(faces_[face].facet));
  }
  drafts_[number] = edit.add(std::move(draft));
  drafted_.push_back(number);
}

void Refinement::write_record(const Edit<3>& edit) {
  record_.met = crossings_.cell_count();
  for (const Root& root : roots_) record_.changed += root.changed ? 1u : 0u;
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    const Root& root = roots_[pieces_[i].root];
    record_.split += root.piece == i && pieces_[i].halvings != 0 ? 1u : 0u;
    if (!pieces_[i].is_long) continue;
    record_.whole.push_back(root.changed ? edit.cell(drafts_[i]) : root.cell);
  }
  for (uint32_t i = 0; i < kept_.size(); ++i) {
    const Cell c{static_cast<uint32_t>(kept_[i])};
    const uint32_t root = root_numbers_.find(c.unit);
    const bool is_changed = root != KeyTable::kNone && roots_[root].changed;
    record_.whole.push_back(is_changed ? edit.cell(drafts_[roots_[root].piece]) : c);
  }
}

}  // namespace dsw
