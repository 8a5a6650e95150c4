#pragma once
// How bodies lie in the arrays of a scene's snapshot: what writes them and what reads them has this in common.

#include <cstring>

#include "snapshot/scene_image.h"

namespace dsw {

/** Numbers of a body. */
enum BodyNumber {
  kLevel,
  kFlags,
  kMotionShare,  // the bits of the double
  kCredit,
  kVertices,
  kFreeVertices,
  kEdges,
  kFreeEdges,
  kFaces,
  kFreeFaces,
  kInserted,
  kSequences,
  kBalls,
  kContacts,
  kPartners,  // as many as contacts, or none: whether bodies meet each other
  kCategory,
  kMask,
  kMoves,    // from version 3 on: that have been followed,
  kTouches,  // and touches before the last one;
  kRest,     // numbers of its rest places
  kTouched,  // from version 4 on: ends of edges for which there is what they have touched
  kRadius,   // from version 5 on: the bits of the double,
  kLengths,  // and edges for which there is their length
  kNumbers
};
constexpr size_t numbers_of(uint32_t format) {
  return format < kHistoryFormat   ? kMoves
         : format < kTouchedFormat ? kTouched
         : format < kRadiusFormat  ? kRadius
                                   : kNumbers;
}

constexpr uint64_t kSequencesFlag = 1, kEnvironmentFlag = 2, kClearanceFlag = 4, kSimilarMotionFlag = 8, kSelfFlag = 16,
                   kBackEdgesFlag = 32, kRigidFlag = 64, kNoSequencesFlag = 128, kLeaveFlag = 256,
                   kPenetratingFlag = 512, kAllFlags = 1023;

template <class To, class From>
To bits_as(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

/** The doubles of a contact, as pairs of a place and a count. */
template <class Contact, class Visit>
void for_each_place(Contact& c, Visit visit) {
  visit(c.from, 3), visit(c.to, 3), visit(c.fixed[0], 3), visit(c.fixed[1], 3), visit(&c.time, 1);
  visit(c.position, 3), visit(c.point, 3), visit(c.contact.normal, 3), visit(&c.edge_parameter, 1),
      visit(&c.distance_left, 1);
}
constexpr size_t kContactPlaces = 24;

/** Its integers. */
template <class Contact, class Visit>
void for_each_word(Contact& c, Visit visit) {
  visit(c.vertex.index), visit(c.vertex.generation), visit(c.edge.index), visit(c.edge.generation);
  visit(c.face.index), visit(c.face.generation);
  visit(c.contact.obstacle.kind), visit(c.contact.obstacle.index), visit(c.contact.obstacle.generation),
      visit(c.contact.obstacle.local);
  visit(c.contact.wall.volume), visit(c.contact.wall.generation), visit(c.contact.wall.local),
      visit(c.contact.front.index), visit(c.contact.front.generation);
  visit(c.contact.kind), visit(c.contact.marked_kind), visit(c.contact.tag), visit(c.history);
}
constexpr size_t kContactWords = 19, kAtObstacleKind = 6, kAtKind = 15;  // then cause, tag, history

constexpr size_t kPartnerWords = 8;

constexpr size_t kTouchPlaces = 6, kPreviousWords = 9, kTouchWords = 10;

constexpr uint32_t kUnknownSequence = 0xffffffffu;  // instead of a sequence's count

/** Whether each facet leads to the cell of the next. One that has lost its other side since it was passed makes what is
 * known worthless. */
template <int D>
bool is_whole(const Map<D>& map, const Array<uint32_t>& facets) {
  for (size_t i = 0; i < facets.size(); ++i) {
    const HalfFacet beyond = map.opposite({facets[i]});
    if (!beyond.valid()) return false;
    if (i + 1 < facets.size() && map.cell_of(beyond) != map.cell_of({facets[i + 1]})) return false;
  }
  return true;
}

}  // namespace dsw
