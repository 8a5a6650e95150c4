#pragma once
// A whole body moved: its vertices go to their targets one after the other.

#include "base/points.h"
#include "flood/sequence.h"
#include "response/settings.h"

namespace dsw {

/** Which vertices move, and in which order. */
struct MoveOrder {
  const uint32_t* vertices = nullptr;  // null: all living ones by index
  size_t count = 0;
};

/** Where a vertex that was at `from` is at a fraction of a motion of the whole body. */
using PlaceFn = void (*)(const void* user, uint32_t vertex, const double* from, double fraction, double* to);

/** Moves bodies; one for each thread. */
template <int D>
class BodyMove {
 public:
  explicit BodyMove(const Environment<D>& env);

  /** Moves a body. Throws std::bad_alloc with the body as it was; the record is cleared first. */
  void move(Body<D>& body, PointArray targets, MoveOrder order, const MoveSettings& settings, MoveRecord& record);

  /** Moves all vertices of a body to where(user, from, fraction), as far as nothing is touched: with the first contact the body is put
   * back and the fraction halved, up to 52 times. Throws as move does. */
  void move_together(Body<D>& body, PlaceFn where, const void* user, MoveOrder order, MoveRecord& record);

  void set_counters(CastCounters* counters) { sweeps_.counters = counters; }
  /** What a body can meet besides the environment; null: nothing. */
  void set_partners(const Partners<D>* partners) { sweeps_.partners = partners; }

 private:
  static constexpr uint32_t kChunk = 64;

  /** Whether all of the cell is seen from the target, if it is not convex. */
  enum class Sight : uint8_t { kUnknown, kWhole, kPart };

  /** What sweeps of edges ask of their ends: small, since edges ask in no order. */
  struct Moving {
    uint32_t rank = kNone;  // place in the order; kNone: stays
    Cell from, arrival;     // contains the target, or the vertex that stays; invalid if something is on the path
    bool doubtful = false;  // something is, or may be, met on the way
    Sight sight = Sight::kUnknown;
    bool inwards = false;  // against the normals of all faces at it
  };
  static_assert(sizeof(Moving) == 16);

  bool try_together(Body<D>& body, PlaceFn where, const void* user, double fraction, MoveOrder order,
                    MoveRecord& record);
  void record_first(const Body<D>& body, uint32_t v, const double* to, MoveRecord& record);
  void start(const Body<D>& body, MoveOrder order, PointArray targets);
  bool run(Body<D>& body, PointArray targets, const MoveSettings& settings, MoveRecord& record, bool may_skip);
  void measure_clearances(Body<D>& body, PointArray targets);
  void cast_paths(const Body<D>& body, PointArray targets);
  void sweep_all(Body<D>& body, PointArray targets, bool may_skip);
  void sweep_edges(Body<D>& body, PointArray targets, bool may_skip);
  uint32_t gather_edges(const Body<D>& body, PointArray targets, uint32_t& next);
  template <class Drops>
  uint32_t drop(const Body<D>& body, uint32_t count, Drops drops);
  uint32_t drop_inside(const Body<D>& body, PointArray targets, uint32_t count);
  bool sees_all_of_cell(PointArray targets, uint32_t v);
  uint32_t drop_clear(Body<D>& body, uint32_t count);
  template <class Skips>
  uint32_t drop_and_cast(Body<D>& body, PointArray targets, uint32_t count, Skips skips);
  uint32_t drop_similar(Body<D>& body, PointArray targets, uint32_t count);
  void find_inwards(const Body<D>& body, PointArray targets);
  uint32_t drop_back(Body<D>& body, PointArray targets, uint32_t count);
  void cast_places(Body<D>& body, PointArray targets, uint32_t e, bool skips_back);
  void sweep_edge(Body<D>& body, PointArray targets, uint32_t e, uint32_t v, uint32_t other, bool boxed);
  struct EdgeEnd {
    Cell cell;
    const double* position;
  };
  void cast_edge(Body<D>& body, uint32_t e, uint32_t v, const EdgeEnd& from, const EdgeEnd& to);
  void run_edges(Body<D>& body);
  void include_way(const Body<D>& body, PointArray targets, uint32_t v, Bounds<D>& box) const;
  bool is_edge_boxed(const Body<D>& body, PointArray targets, uint32_t e);
  bool is_face_boxed(const Body<D>& body, PointArray targets, uint32_t f);
  void sweep_faces(const Body<D>& body, PointArray targets);
  void find_sides(const Body<D>& body);
  bool shares_strip(const Body<D>& body, uint32_t f) const;
  void run_packet(const Body<D>& body);
  void arrive(Body<D>& body, PointArray targets, uint32_t v) const;
  bool finish(Body<D>& body, PointArray targets, const MoveSettings& settings, MoveRecord& record, bool may_skip);
  void disturb(const Body<D>& body, uint32_t v);
  bool is_star_free(const Body<D>& body, uint32_t v);
  void remove_noise(Body<D>& body, double share, MoveRecord& record);
  const double* place(const Body<D>& body, PointArray targets, uint32_t v, uint32_t rank) const;
  Cell cell_at(uint32_t v, uint32_t rank) const;

  const Environment<D>& env_;
  StarSweep<D> sweeps_;
  Packet<D> packet_;
  uint32_t packet_vertices_[kPacket] = {};  // kNone: of both ends of the edge
  uint32_t packet_edges_[kPacket] = {};
  Array<SequenceWriter<D>> writers_{env_.memory};  // of the packet, if sequences are kept
  uint32_t chunk_[kChunk] = {};                    // edges that are looked at
  Array<uint32_t> order_{env_.memory};
  Array<Moving> moving_{env_.memory};         // by vertex
  Array<PathFacets> crossed_{env_.memory};    // by vertex, if sequences are kept: on its path
  Array<uint32_t> strays_{env_.memory};       // vertices that are not where their neighbours took them to be
  Array<bool> keeps_;                         // by edge, at FACES: it keeps to one sequence all through the move
  Array<uint32_t> sides_{env_.memory};        // by face, at FACES: its edges, that opposite of corner k in place k
  Array<BodyVertex<D>> before_{env_.memory};  // to go back to
  Array<double> places_{env_.memory};         // of all vertices, when they move together
  Array<double> rooms_{env_.memory};          // by vertex, if balls are kept: see room_squared
};

}  // namespace dsw
