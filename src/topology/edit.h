#pragma once
// One change of the topology: some cells go, others take their place. It is written down, prepared (all that can fail:
// cells checked exactly, room made, records written where nothing leads to them yet), applied (the links of the cells
// around lead to the new cells; can be taken back), and finished. An edit that is not finished leaves everything as it
// was.
//
// Paper 5.2 names the operations; that cells are replaced instead of changed in place is ours: what was is still there
// when bodies are asked whether they stay free.

#include "base/key_table.h"
#include "map/records.h"
#include "topology/layout.h"

namespace dsw {

/** What became of a volume: ids by index and generation; index 0 with generation 0 is none. */
struct VolumeChange {
  SlotPool::Slot before, after;
};

template <int D>
class Edit {
 public:
  /** Makes the map ready to change. Throws std::bad_alloc, as all up to prepare(). */
  explicit Edit(Environment<D>& env);
  ~Edit();
  Edit(const Edit&) = delete;
  Edit& operator=(const Edit&) = delete;

  /** A cell goes. */
  void remove(Cell c);
  /** A cell goes and what takes its place is drafted, at first as it is. Returns the draft's number, each time. */
  size_t replace(Cell c);
  /** A further draft; returns its number. */
  size_t add(CellDraft&& draft);
  CellDraft& draft(size_t i) { return drafts_[i]; }
  /** The draft that takes a cell's place, or null. */
  CellDraft* find_draft(Cell c);
  /** A vertex with this position. Throws BORROWED where points are the host's without room for it. */
  uint32_t add_vertex(const double* position);
  /** Adds a vertex at `share` of the way along an edge from a to b; the edge's mark goes to both of its parts. Throws
   * BORROWED as above. */
  uint32_t add_vertex(uint32_t a, uint32_t b, double share);
  /** Links of cells that stay: the half-facet leads to another (which is told separately) or to the outside. */
  void set_link(HalfFacet h, HalfFacet to, bool marked);
  void set_mark(uint32_t a, uint32_t b, bool marked);
  void set_mark(uint32_t vertex, bool marked);
  /** After prepare(): of a cell that stays, or of what is drafted for a cell. Throws std::bad_alloc. */
  void set_mark(Cell c, bool marked);
  /** After prepare(). */
  void set_draft_mark(size_t i, bool marked) noexcept;

  /** Throws INVALID_CELL, BAD_CELL, BAD_TOPOLOGY, TOO_LARGE, std::bad_alloc. With `invalid`, drafts that would be the
   * reason for one of the first two are put there instead; if there are any, the edit is of no more use. */
  void prepare(Array<uint32_t>* invalid = nullptr);
  void apply() noexcept;
  /** Takes an applied edit back. */
  void revert() noexcept;
  void finish() noexcept;

  /** Calls visit(draft's number) for what comes of a cell, in the order of the drafts, until it returns false. */
  template <class Visit>
  void for_each_heir(Cell c, Visit visit) const {
    const uint32_t cell = ancestors_.find(c.unit);
    for (uint32_t i = cell == KeyTable::kNone ? kNoHeir : heirs_of_[cell].first; i != kNoHeir; i = heirs_[i].next) {
      if (!visit(size_t{heirs_[i].draft})) return;
    }
  }

  /** After prepare(): the cells that go, by unit, and those that come. */
  const Array<Cell>& removed() const { return removed_; }
  bool is_removed(Cell c) const { return c.unit - lowest_gone_ <= gone_span_ && gone_.find(c.unit) != KeyTable::kNone; }
  size_t cell_count() const { return made_.size(); }
  Cell cell(size_t i) const { return made_[i].cell; }
  /** Half-facet of a draft's facet. */
  HalfFacet half_facet(size_t i, uint32_t facet) const;
  /** Half-facets of cells that stay whose links change, by address. */
  size_t link_count() const { return links_.size(); }
  HalfFacet link(size_t i) const { return {links_[i].word}; }
  bool is_relinked(HalfFacet h) const {
    return !links_.empty() && h.word >= links_.front().word && h.word <= links_.back().word &&
           std::binary_search(links_.begin(), links_.end(), Link{h.word, 0, 0});
  }
  /** Calls visit(cell) for those that stay and become impassable. */
  template <class Visit>
  void for_each_marked(Visit visit) const {
    for (const CellMark& mark : cell_marks_) {
      if (mark.marked) visit(mark.cell);
    }
  }
  Environment<D>& environment() const { return env_; }

  /** How long changes() can be; the rest after finish(). */
  size_t most_changes() const { return drafts_.size() + heirs_.size() + removed_.size(); }
  Array<VolumeChange>& changes() { return changes_; }

 private:
  /** A record that has been written. */
  struct Made {
    Cell cell;
    uint32_t units = 0, shape = kNoCell, index = 0;
    size_t first_word = 0;  // of the draft's facets, in words_
  };
  struct Link {
    uint32_t word, before, after;
    bool operator<(const Link& o) const { return word < o.word; }
  };
  struct MarkChange {
    uint32_t a, b;  // b is kNoCell: of vertex a
    bool marked, done;
  };
  struct CellMark {
    Cell cell;
    bool marked, done;
  };
  /** A draft's facet, and the next one that comes from the same half-facet. */
  struct Origin {
    uint32_t draft, facet, next;
  };
  /** All of them, by what they come from: a half-facet, or a pair. */
  struct Origins {
    KeyTable keys;
    Array<uint32_t> first;  // by key
    Array<Origin> list;
    explicit Origins(const Memory* memory) : keys(memory), first(memory), list(memory) {}
  };

  /** A draft in the list of those that come of one cell. */
  struct Heir {
    uint32_t draft, next;
  };
  /** Ends of that list. */
  struct Heirs {
    uint32_t first, last;
  };
  static constexpr uint32_t kNoHeir = 0xffffffffu, kNoOrigin = 0xffffffffu;

  double* room_for(uint32_t v);
  void note_heir(Cell c, uint32_t draft);
  bool write_record(size_t i);
  void write_general(const Layout& layout, Made& made);
  void collect_links();
  static uint32_t origin_of(const FacetDraft& facet);
  void connect();
  void connect(size_t i, uint32_t facet, const Origins& origins);
  void check_cells(Array<uint32_t>* invalid);
  void choose_indices();
  void drop_marks();
  bool is_edge_left(Dart d, const KeyTable& drafted) const;
  void reserve();
  void reserve_labels();
  void collect_exits();
  void move_exits() noexcept;
  void count(uint32_t link, int sign) noexcept;
  void count_all() noexcept;
  void set_marks(bool back) noexcept;
  void forget_cells() noexcept;
  void move_uses() noexcept;
  void log_changes() noexcept;
  Link* find_link(uint32_t word);
  uint32_t word_of(size_t i, uint32_t facet) const { return words_[made_[i].first_word + facet]; }

  Environment<D>& env_;
  Map<D>& map_;
  Room room_;  // before
  size_t point_doubles_, vertex_mark_words_;
  uint64_t version_ = 0;  // of obstacles, before it was applied
  bool applied_ = false, finished_ = false, made_regions_ = false, made_tags_ = false;
  Array<float> local_points_{env_.memory};  // of the environment, to be put back
  KeyTable gone_{env_.memory};              // units of removed_, in the order in which they were named
  Array<Cell> removed_{env_.memory};
  // Lowest unit of these, and from there to the highest, once they are sorted: most other cells lie outside.
  uint32_t lowest_gone_ = 0, gone_span_ = 0xffffffffu;
  Array<CellDraft> drafts_{env_.memory};
  KeyTable ancestors_{env_.memory};     // units of the cells that drafts come of
  Array<Heirs> heirs_of_{env_.memory};  // by number in ancestors_
  Array<Heir> heirs_{env_.memory};
  Array<Made> made_{env_.memory};
  Array<uint32_t> words_{env_.memory};  // half-facets of all drafts
  Layout layout_{env_.scratch.memory()};
  Array<Link> links_{env_.memory};
  Array<MarkChange> marks_{env_.memory};
  Array<CellMark> cell_marks_{env_.memory};
  Array<Exit> exits_{env_.memory};            // of the cells that come
  Array<uint32_t> vertices_{env_.memory};     // new ones
  Array<double> points_before_{env_.memory};  // in their places
  Array<VolumeChange> changes_{env_.memory};
  uint32_t fresh_ = 0;  // cells that get an index of their own
  int64_t sides_ = 0, boundary_ = 0, marked_ = 0,
          cells_ = 0;  // by how much counts change; facets counted from both sides
};

}  // namespace dsw
