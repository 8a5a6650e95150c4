/** @file contact.h
 * What a move, a cast or a sweep reports. The structs here are frozen: new data means a new getter. In the plane third coordinates are 0,
 * and an edge that moves meets vertices where one in space meets edges: what is said of wires holds for marked vertices there.
 */
#ifndef DARTSWEEP_CONTACT_H
#define DARTSWEEP_CONTACT_H

#include "dartsweep/base.h"
#include "dartsweep/ids.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a flight ended. */
typedef enum dsw_outcome {
  DSW_OUTCOME_NONE = 0,       /**< There was no flight. */
  DSW_OUTCOME_REACHED = 1,    /**< The target was reached; nothing impassable was met. */
  DSW_OUTCOME_CONTACT = 2,    /**< Stopped at the first impassable face. */
  DSW_OUTCOME_WORK_LIMIT = 3, /**< Stopped early, free: the work limit was reached. */
  DSW_OUTCOME_OUTSIDE = 4,    /**< The start lies in no cell: nothing was done (free casts only). */
  DSW_OUTCOME_IMPASSABLE = 5, /**< The start lies in an impassable volume: nothing was done (free casts only). */
  DSW_OUTCOME_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_outcome;

/** What of the environment was touched. */
typedef enum dsw_contact_kind {
  DSW_CONTACT_NONE = 0,                     /**< Nothing. */
  DSW_CONTACT_PLANE = 1,                    /**< The inside of a face. A particle meets nothing else. */
  DSW_CONTACT_EDGE = 2,                     /**< An edge. */
  DSW_CONTACT_VERTEX = 3,                   /**< A vertex. */
  DSW_CONTACT_KIND_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_contact_kind;

/** Report of one flight from p towards its target. Without a contact the members from `normal` on are zero or null,
 * but for `volume`. */
typedef struct dsw_flight {
  /** Where it ended. For a particle: the verified position, free and on this side of the wall. For a free cast: p +
   * time * (target - p), rounded. */
  double position[3];
  /** Fraction of the move: 1 when the target was reached. At a contact the largest double that is not later than the
   * true first time (exact arithmetic decides); at a work limit, not later than the last face crossed. */
  double time;
  /** Unit normal of the boundary triangle that was hit, pointing out of the obstacle, towards p. */
  double normal[3];
  dsw_volume_id volume;   /**< The volume it ended in. */
  dsw_face_id face;       /**< Canonical id of the face that was hit. */
  dsw_volume_id behind;   /**< The volume behind that face; null at the outer boundary. */
  dsw_outcome outcome;    /**< How it ended. */
  dsw_contact_kind kind;  /**< What was touched: DSW_CONTACT_PLANE. */
  dsw_cell_kind obstacle; /**< What makes it impassable: DSW_CELL_FACE (its own mark, or the outer boundary), or
                               DSW_CELL_VOLUME (the volume behind is marked and the face is not). */
  uint32_t tag;           /**< Host tag of the volume behind; at the outer boundary of the volume in front. */
  uint32_t cells_visited; /**< Volumes entered, the first included; the verification of a stop is not counted. */
  uint32_t reserved[2];   /**< 0; no byte of a report is left undefined. */
} dsw_flight;

/** One cell of a flight, in order. */
typedef struct dsw_crossing {
  dsw_volume_id volume; /**< The volume entered. */
  dsw_face_id face;     /**< Canonical id of the face it was entered through; null for the first. */
  double time;          /**< When, a fraction of the move, rounded down; 0 for the first. */
} dsw_crossing;

/** Report of one swept edge: its end p moves to p', its end q stays. Without a contact `point`, `along`, `normal` and
 * the members from `front` to `edge`, `kind`, `obstacle` and `tag` are zero or null. */
typedef struct dsw_sweep {
  /** Where the moving end is at `time`: p + time * (p' - p), rounded. */
  double position[3];
  /** Fraction of the move: 1 when the edge came through; 0 when it stopped early or could not start. At a contact the
   * largest double that is not later than the true first time; where the shift alone decides, then its limit. */
  double time;
  double point[3]; /**< Where the edge touches, rounded. */
  double along;    /**< Where along the edge: 0 the moving end, 1 the fixed one. */
  /** Unit, out of the obstacle. DSW_CONTACT_PLANE of the moving end: of the boundary triangle. DSW_CONTACT_EDGE, and PLANE on a
   * diagonal: across the edge and the obstacle's edge or the diagonal, against the motion; where those two are parallel, of a boundary triangle at the obstacle's edge,
   * and of a wire against the motion. In the plane DSW_CONTACT_VERTEX: that of the swept edge, to the side that this comes from. */
  double normal[3];
  dsw_volume_id volume; /**< Of the moving end: at its target when the edge came through, else at its start. */
  /** Contact: a passable volume at the reported face, or at the wire; null without. Of several faces at a rim one that p
   * looks at counts, then the lowest canonical id. At a vertex of the plane: of those that the sweep meets there the one with the lowest index, which
   * need not be at `face`; that has the lowest canonical id there. */
  dsw_volume_id front;
  dsw_face_id face; /**< Canonical id of the impassable face; null for a wire. */
  /** DSW_CONTACT_EDGE: canonical id of the obstacle's edge. In the plane DSW_CONTACT_VERTEX: the obstacle's vertex, `volume` is its index,
   * `generation` its generation. */
  dsw_edge_id edge;
  /** REACHED, CONTACT, WORK_LIMIT, OUTSIDE (p lies in no volume), IMPASSABLE (p lies in an impassable one, or p q is not
   * free where it starts). */
  dsw_outcome outcome;
  /** PLANE: the moving end on a face, or the edge on the diagonal of a warped one; EDGE, in the plane VERTEX. */
  dsw_contact_kind kind;
  dsw_cell_kind obstacle; /**< As in dsw_flight; DSW_CELL_EDGE for a wire, in the plane DSW_CELL_VERTEX. */
  uint32_t tag;           /**< As in dsw_flight; 0 for a wire. At a vertex of the plane as in dsw_contact. */
  uint32_t cells_visited; /**< Volumes looked at, all casts included. */
  uint32_t reserved;      /**< 0. */
} dsw_sweep;

/** Whether a body vertex was already stopped by this obstacle in the body's move before;
 * dsw_contact_past says more. */
typedef enum dsw_contact_history {
  DSW_HISTORY_NONE = 0,                /**< No contact. */
  DSW_HISTORY_NEW = 1,                 /**< It was not. */
  DSW_HISTORY_LASTING = 2,             /**< It was. */
  DSW_HISTORY_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_contact_history;

/** A contact of a body: one vertex was moved from `from` towards `to`, and the vertex itself, one of its edges or one of its
 * faces touched something impassable at `time`. */
typedef struct dsw_contact {
  double from[3]; /**< Where the moving vertex started. */
  double to[3];   /**< Where it was to go. */
  /** Where the other ends of the touching edge (one) or face (two) were; the rest is zero. With `from` and `to` this is all it takes to
   * sweep it again. */
  double fixed[2][3];
  /** Fraction of that flight. With exact time the largest double not later than the true first time (its limit where the
   * shift decides). By bisection a time at which the body is free: then `point`, `along` and `normal` are those of the last place that
   * was tried and is not free, see dsw_search. */
  double time;
  double position[3]; /**< The moving vertex at `time`: from + time * (to - from), rounded. */
  double point[3];    /**< Where it touches, rounded. */
  /** Unit, out of the obstacle; see dsw_sweep. Of a face on a vertex: that of the face, against the motion; in the plane of an edge on a vertex
   * that of the edge. */
  double normal[3];
  double along;              /**< Touching edge: 0 at the moving vertex, 1 at the other end; else 0. */
  double distance_left;      /**< Length of the part of the flight that was not made, scene units. */
  dsw_body_vertex_id vertex; /**< The vertex that moved. */
  dsw_body_edge_id edge;     /**< The edge that touched; null if it was the vertex or a face. */
  dsw_body_face_id face;     /**< The face that touched; null if it was the vertex or an edge. */
  dsw_cell
      obstacle; /**< What was touched, canonical: a face, an edge (DSW_CONTACT_EDGE) or a vertex (DSW_CONTACT_VERTEX). */
  dsw_face_id wall; /**< An impassable face that the obstacle is or belongs to; null for a wire and a marked vertex. */
  dsw_volume_id front;   /**< A passable volume at the obstacle. */
  dsw_contact_kind kind; /**< What of the obstacle was touched. */
  dsw_cell_kind cause;   /**< What was marked: DSW_CELL_FACE (or the outer boundary), VOLUME, EDGE, VERTEX. */
  /** Host tag of the volume behind `wall`, at the outer boundary of the one in front; else 0. A vertex can have a `front` that is not at
   * `wall`: behind is where the normal does not look to. */
  uint32_t tag;
  dsw_contact_history history; /**< New, or lasting. */
} dsw_contact;

/** What the vertex of a contact touched before. Moves of the body are counted, of any of its
 * vertices and by any function of move.h; deformations and edits do not count. With this a host
 * tells how the vertex touches:
 * - resting: `since` is 1, and `point` is where the contact touches now, within a distance that
 *   the host chooses;
 * - sliding: `since` is 1, and `point` is farther away, on the same obstacle (`moves` above 1)
 *   or on the one before. A vertex that begins to slide does so after its contact: that of the
 *   next move tells;
 * - bouncing: `since` is above 1: the body made `since` - 1 moves in between in which this vertex
 *   had no contact, also because it was not to move. `since` 0: its first contact ever. */
typedef struct dsw_contact_past {
  /** Where the vertex was stopped last before this move: of the contact with the same obstacle in
   * the move before, or if there is none, of the vertex's last contact in its last move that had
   * any. This and all down to `since` is 0 if there was none. */
  double point[3];
  double normal[3];  /**< Its normal, see dsw_contact. */
  dsw_cell obstacle; /**< What was touched there, by the id of that time; null where it was a body. */
  dsw_body_id body;  /**< The body that was touched there; null where it was the environment. */
  uint32_t since;    /**< How many moves ago that was: 1 in the move before; 0 never. */
  uint32_t
      moves; /**< For how many moves in a row this obstacle has stopped the vertex, this one included. 1: it is new. */
  uint32_t touching; /**< For how many moves in a row anything has stopped the vertex, this one included. */
  uint32_t reserved; /**< 0. */
} dsw_contact_past;

/** The other body of a contact, and its part that was touched: one of vertex, edge and face; the rest is null. All is null in a
 * contact with the environment. In a contact of bodies `obstacle`, `wall`, `cause` and `tag` of dsw_contact are null, `front` is the
 * volume that the moving vertex started in, and `kind` is that of the part: DSW_CONTACT_VERTEX, EDGE or (a face) PLANE. In the plane a
 * vertex touches edges and an edge vertices, and `normal` is that of the edge, against the motion; of a vertex on a lone vertex, and of a
 * vertex that moves in the line of the edge, it is the motion turned round. */
typedef struct dsw_contact_partner {
  dsw_body_id body;          /**< The body itself where it touches itself. */
  dsw_body_vertex_id vertex; /**< Its vertex, */
  dsw_body_edge_id edge;     /**< edge */
  dsw_body_face_id face;     /**< or face that was touched. */
} dsw_contact_partner;

#ifdef __cplusplus
}
#endif

#endif
