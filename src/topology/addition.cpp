// Volumes added to an environment: read, joined with each other and with what is there, cut so that they are valid.

#include "base/dimensions.h"
#include "base/error.h"
#include "base/sort.h"
#include "environment/mesh_reader.h"
#include "topology/operations.h"

namespace dsw {
namespace {

/** One facet among all new ones. */
struct Place {
  uint32_t cell, facet;
};

template <int D>
class Addition {
 public:
  Addition(Edit<D>& edit, const NewCells& input)
      : edit_(edit),
        env_(edit.environment()),
        in_(input),
        offsets_(input.offsets, input.index_bytes),
        connectivity_(input.connectivity, input.index_bytes) {}

  void run() {
    for (uint32_t i = 0; i < in_.cell_count; ++i) read(i);
    join();
    for (size_t i = 0; i < in_.sew_count; ++i) sew_to(in_.sew_to[i], i);
    if constexpr (D == 3) cut();
  }

 private:
  const Vertices& loop(const Place& at) { return facet(at).loop; }
  FacetDraft& facet(const Place& at) { return edit_.draft(at.cell).facets[at.facet]; }

  uint32_t vertex(uint32_t i, size_t at) const {
    const int64_t v = connectivity_[at];
    if (v < 0 || static_cast<uint64_t>(v) >= in_.vertex_count) {
      fail(DSW_STATUS_INDEX_OUT_OF_RANGE, "new volume %u names vertex %lld of %zu", i, static_cast<long long>(v),
           in_.vertex_count);
    }
    return in_.vertices[v];
  }

  void read(uint32_t i) {
    const CellType type = cell_type<D>(in_.cell_types != nullptr ? in_.cell_types[i] : in_.uniform_cell_type);
    if (!type.known) fail(DSW_STATUS_BAD_CELL_TYPE, "new volume %u has a type that is not supported", i);
    const bool uniform = in_.offsets == nullptr;
    const int64_t begin = uniform ? int64_t{i} * type.vertex_count : offsets_[i];
    const int64_t end = uniform ? begin + type.vertex_count : offsets_[size_t{i} + 1];
    const bool inside = begin >= 0 && begin <= end && static_cast<uint64_t>(end) <= in_.connectivity_count;
    if (!inside || (type.vertex_count != 0 && end - begin != static_cast<int64_t>(type.vertex_count))) {
      fail(DSW_STATUS_WRONG_SIZE,
           "new volume %u has offsets outside of connectivity, or not as many points as its type", i);
    }
    CellDraft draft(env_.scratch.memory());
    draft.region = in_.regions == nullptr ? 0 : in_.regions[i];
    draft.tag = in_.tags == nullptr ? 0 : in_.tags[i];
    if constexpr (D == 2) {
      read_polygon(i, static_cast<size_t>(begin), static_cast<size_t>(end), draft);
    } else if (type.form == Form::kGeneral) {
      read_stream(i, static_cast<size_t>(begin), static_cast<size_t>(end), draft);
    } else {
      read_standard(i, static_cast<size_t>(begin), type.form, draft);
    }
    edit_.add(std::move(draft));
  }

  void add_facet(uint32_t i, CellDraft& draft, FacetDraft&& facet) {
    Vertices sorted = facet.loop;
    dsw::sort(sorted.begin(), sorted.end());
    if (sorted.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      fail(DSW_STATUS_BAD_CELL, "a face of new volume %u has fewer than three vertices, or one vertex twice", i);
    }
    // From the lowest vertex, as at creation.
    const size_t base = facet.place_of(sorted[0]);
    for (size_t k = 1; k + 1 < sorted.size(); ++k) {
      for (const size_t step : {size_t{0}, k, k + 1}) {
        facet.triangles.push_back(facet.after(static_cast<uint32_t>(base), step));
      }
    }
    draft.facets.push_back(std::move(facet));
  }

  void read_standard(uint32_t i, size_t begin, Form form, CellDraft& draft) {
    const Shape shape = standard_shape(form, 0);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      FacetDraft facet(env_.scratch.memory());
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        facet.loop.push_back(vertex(i, begin + shape.dart_vertex(d)));
      }
      add_facet(i, draft, std::move(facet));
    }
  }

  void read_polygon(uint32_t i, size_t begin, size_t end, CellDraft& draft) {
    for (size_t at = begin; at < end; ++at) {
      FacetDraft side(env_.scratch.memory());
      for (const size_t corner : {at, at + 1 == end ? begin : at + 1}) side.loop.push_back(vertex(i, corner));
      draft.facets.push_back(std::move(side));
    }
    Array<uint32_t> order{env_.memory};
    if (draft.facets.size() < 3 || !order_sides(draft, 0, order)) {
      fail(DSW_STATUS_BAD_CELL, "new volume %u has fewer than three vertices, or one vertex twice", i);
    }
  }

  void read_stream(uint32_t i, size_t at, size_t end, CellDraft& draft) {
    const auto next = [&]() -> int64_t { return at < end ? connectivity_[at++] : 0; };
    for (int64_t faces = next(); faces > 0; --faces) {
      const int64_t corners = next();
      if (corners < 3 || static_cast<uint64_t>(corners) > end - at) {
        fail(DSW_STATUS_BAD_CELL, "the face stream of new volume %u is malformed", i);
      }
      FacetDraft facet(env_.scratch.memory());
      for (int64_t k = 0; k < corners; ++k) facet.loop.push_back(vertex(i, at++));
      add_facet(i, draft, std::move(facet));
    }
    if (at != end) fail(DSW_STATUS_BAD_CELL, "the face stream of new volume %u is malformed", i);
  }

  /** Facets with the same vertices, in the order of their cells: two of them face each other. */
  void join() {
    const auto by_vertices = [&](const Place& a, const Place& b) {
      if (keys_less(a, b)) return true;
      return !keys_less(b, a) && (a.cell != b.cell ? a.cell < b.cell : a.facet < b.facet);
    };
    for (uint32_t i = 0; i < in_.cell_count; ++i) {
      for (uint32_t f = 0; f < edit_.draft(i).facets.size(); ++f) places_.push_back({i, f});
    }
    dsw::sort(places_.begin(), places_.end(), by_vertices);
    for (size_t k = 0; k + 1 < places_.size(); ++k) {
      if (keys_less(places_[k], places_[k + 1])) continue;
      FacetDraft &a = facet(places_[k]), &b = facet(places_[k + 1]);
      if (k + 2 < places_.size() && !keys_less(places_[k + 1], places_[k + 2])) {
        fail(DSW_STATUS_SHARED_FACE, "new volumes %u and %u share a face with a third one", places_[k].cell,
             places_[k + 1].cell);
      }
      if (!face_each_other(a, b)) {
        fail(DSW_STATUS_DUPLICATE_CELL, "new volumes %u and %u lie on the same side of a face", places_[k].cell,
             places_[k + 1].cell);
      }
      a.pair = b.pair = static_cast<uint32_t>(k++);
    }
  }

  static Vertices key_of(Vertices loop) {
    dsw::sort(loop.begin(), loop.end());
    return loop;
  }
  bool keys_less(const Place& a, const Place& b) { return key_of(loop(a)) < key_of(loop(b)); }

  void sew_to(HalfFacet h, size_t i) {
    const Map<D>& map = env_.map;
    if (map.opposite(h).valid()) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "sew_to[%zu]: face %u of volume %u is not on the outer boundary", i,
           map.local_of(h, map.cell_of(h)), map.index(map.cell_of(h)));
    }
    const FacetDraft there = draft_of(env_, h);
    const Vertices key = key_of(there.loop);
    const auto less = [&](const Place& place, const Vertices& of) { return key_of(loop(place)) < of; };
    for (auto at = std::lower_bound(places_.begin(), places_.end(), key, less);
         at != places_.end() && key_of(loop(*at)) == key; ++at) {
      FacetDraft& here = facet(*at);
      if (here.pair != kNoPair || here.far.valid() || !face_each_other(here, there)) continue;
      here.far = h;
      here.marked = there.marked;
      cut_like(here, there);
      return;
    }
    fail(DSW_STATUS_NOT_FOUND, "sew_to[%zu]: no new volume has the vertices of this face on its other side", i);
  }

  /** Where the usual cut spoils a star another one is looked for, as at creation. What is sewn is cut like the other
   * side. */
  void cut() {
    for (size_t k = 0; k < places_.size(); ++k) {
      FacetDraft& here = facet(places_[k]);
      if (here.loop.size() == 3 || here.far.valid()) continue;
      const bool paired = here.pair == k;
      if (here.pair != kNoPair && !paired) continue;  // seen from the other side
      double apex[3], beyond[3];
      centre(env_, edit_.draft(places_[k].cell), apex);
      if (paired) centre(env_, edit_.draft(places_[k + 1].cell), beyond);
      if (is_cut_well(env_, here, apex, paired ? beyond : nullptr)) continue;
      FacetDraft anew = here;
      anew.triangles.clear();
      if (!cut_anew(env_, anew, anew.loop, apex, paired ? beyond : nullptr)) continue;  // the volume is found invalid
      here.triangles = anew.triangles;
      if (paired) cut_like(facet(places_[k + 1]), here);
    }
  }

  Edit<D>& edit_;
  const Environment<D>& env_;
  const NewCells& in_;
  Integers offsets_, connectivity_;
  Array<Place> places_{env_.memory};  // sorted by vertices
};

}  // namespace

template <int D>
void add_cells(Edit<D>& edit, const NewCells& input) {
  Addition<D>(edit, input).run();
}

DSW_INSTANTIATE(add_cells);

}  // namespace dsw
