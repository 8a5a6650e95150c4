/** @file contact.h
 * Reports of casts, sweeps and moves, in frozen structs: new data comes with a new getter.
 * More: bindings/docs/contacts.md.
 */
#ifndef DARTSWEEP_CONTACT_H
#define DARTSWEEP_CONTACT_H

#include "dartsweep/ids.h"

/** How a flight ended. */
typedef enum dsw_outcome {
  DSW_OUTCOME_NONE = 0,       /**< There was no flight. */
  DSW_OUTCOME_REACHED = 1,    /**< At the target. */
  DSW_OUTCOME_CONTACT = 2,    /**< At the first contact. */
  DSW_OUTCOME_WORK_LIMIT = 3, /**< Free, at the work limit. */
  DSW_OUTCOME_OUTSIDE = 4,    /**< Not begun: the start lies in no volume. */
  /** Not begun: the start, or the edge there, is not free. */
  DSW_OUTCOME_IMPASSABLE = 5,
  /** A particle's move: at an exit (dsw_environment_mark_exits). @since 2.1 */
  DSW_OUTCOME_EXIT = 6,
  DSW_OUTCOME_FORCE_INT32 = 0x7fffffff
} dsw_outcome;

/** What part of the obstacle was touched. */
typedef enum dsw_contact_kind {
  DSW_CONTACT_NONE = 0,   /**< None. */
  DSW_CONTACT_PLANE = 1,  /**< The inside of a face, also its diagonals. */
  DSW_CONTACT_EDGE = 2,   /**< An edge. */
  DSW_CONTACT_VERTEX = 3, /**< A vertex. */
  DSW_CONTACT_KIND_FORCE_INT32 = 0x7fffffff
} dsw_contact_kind;

/** What was touched, and what `kind` of part. All members are 0 without a contact; at a body all
 * but `normal`, `front` and `kind`. */
typedef struct dsw_contact {
  double normal[3];     /**< Unit normal, out of the obstacle. */
  dsw_cell obstacle;    /**< Touched face, edge or vertex, canonical. */
  dsw_face_id wall;     /**< A wall there, canonical; null at a marked edge or vertex. */
  dsw_volume_id front;  /**< Passable volume at `obstacle`; at a body, that of the vertex. */
  dsw_volume_id behind; /**< Volume beyond `wall`; null at the outer boundary. */
  dsw_contact_kind kind;
  /** Kind of the marked cell: VOLUME if only `behind` is marked, FACE also at the boundary. */
  dsw_cell_kind marked_kind;
  uint32_t tag; /**< Tag of `behind`; at the outer boundary, of the volume there. */
} dsw_contact;

/** Report of a cast or a particle's move. It ended in `volume`, with an `outcome` and perhaps a
 * `contact`, after `volumes_visited`. */
typedef struct dsw_flight {
  /** End: for a particle verified to be free, for a cast rounded. */
  double position[3];
  /** Fraction of the move; at a contact the largest double not later than the exact time. */
  double time;
  dsw_contact contact;
  dsw_volume_id volume;
  dsw_outcome outcome;
  uint32_t volumes_visited;
} dsw_flight;

/** One `volume` of a flight. */
typedef struct dsw_crossing {
  dsw_volume_id volume;
  dsw_face_id face; /**< Its face of entry, canonical; at first null. */
  double time;      /**< Time of entry, rounded down. */
} dsw_crossing;

/** Report of one swept edge; `contact`, `outcome` and `volumes_visited` as in dsw_flight. */
typedef struct dsw_sweep {
  double position[3]; /**< Moving end at `time`, rounded. */
  /** That of dsw_flight; 0 if the edge could not start, or at the work limit. */
  double time;
  double point[3];       /**< Where the edge touches, rounded. */
  double edge_parameter; /**< Place of `point`: 0 moving end, 1 fixed end. */
  dsw_contact contact;
  dsw_volume_id volume; /**< Volume of the moving end; without REACHED, of its start. */
  dsw_outcome outcome;
  uint32_t volumes_visited;
} dsw_sweep;

/** Whether the same cell stopped the vertex in the body's previous move. The next face of a wall is
 * another cell; see `touching` of dsw_previous_contact. */
typedef enum dsw_contact_history {
  DSW_HISTORY_NONE = 0,    /**< No contact. */
  DSW_HISTORY_NEW = 1,     /**< No. */
  DSW_HISTORY_LASTING = 2, /**< Yes. */
  DSW_HISTORY_FORCE_INT32 = 0x7fffffff
} dsw_contact_history;

/** A contact of a body: a moving `vertex`, or an `edge` or `face` at it (else null), touched
 * something. */
typedef struct dsw_body_contact {
  double from[3];        /**< Start of the vertex, or of its slide. */
  double to[3];          /**< End of that way, unstopped. */
  double fixed[2][3];    /**< Other ends of the touching edge or face, or 0. */
  double position[3];    /**< Moving vertex at `time`, rounded. */
  double time;           /**< Fraction of that way; by bisection, when the body is free. */
  double point[3];       /**< Where the body touches, rounded. */
  double edge_parameter; /**< Place of `point`: 0 `vertex`, 1 other end. */
  double distance_left;  /**< From where it stopped to the target of the call. */
  dsw_contact contact;   /**< What the body touched. */
  dsw_body_vertex_id vertex;
  dsw_body_edge_id edge;
  dsw_body_face_id face;
  dsw_contact_history history; /**< Whether the contact is new. */
  uint32_t reserved;
} dsw_body_contact;

/** The previous contact of a vertex. It rests or slides if `since` is 1, and bounces above 1. */
typedef struct dsw_previous_contact {
  /** Where this obstacle, or else anything, stopped it before. */
  double point[3];
  double normal[3];  /**< Normal there. */
  dsw_cell obstacle; /**< Touched cell; null for a body. */
  dsw_body_id body;  /**< Touched body, or null. */
  uint32_t since;    /**< Moves ago: 1 the last, 0 never. */
  uint32_t moves;    /**< Moves in a row that this stopped. */
  uint32_t touching; /**< Moves in a row that anything stopped. */
  uint32_t reserved;
} dsw_previous_contact;

/** What left through an exit: a particle, or a vertex of a body. @since 2.1 */
typedef struct dsw_exit {
  double point[3];  /**< Where it came to the exit, rounded. */
  double time;      /**< Fraction of its way, the largest double not later than the exact time. */
  dsw_face_id face; /**< The face of the exit. */
  uint32_t patch;   /**< The number of the exit. */
  dsw_particle_id particle;  /**< Null for a vertex of a body. */
  dsw_body_vertex_id vertex; /**< Null for a particle. */
} dsw_exit;

/** The `body` that a contact touched, and its `vertex`, `edge` or `face`; null where there is
 * none. */
typedef struct dsw_contact_partner {
  dsw_body_id body;
  dsw_body_vertex_id vertex;
  dsw_body_edge_id edge;
  dsw_body_face_id face;
} dsw_contact_partner;

/** What a penetrating body crosses. @since 2.1 */
typedef struct dsw_penetration {
  double point[3];          /**< A common point of both, rounded; without one, a point of `part`. */
  dsw_contact_partner part; /**< The body, and its vertex, edge or face. */
  dsw_contact_partner other; /**< The body, perhaps the same one, that is crossed, or null. */
  /** The first wall that is crossed, canonical. Null at a body, at a marked edge, for a part that is
   * too near to something, and for a part that lies outside or in impassable volumes as a whole. */
  dsw_face_id wall;
  uint32_t reserved;
} dsw_penetration;

#endif
