/** @file contact.h
 * Reports of casts, sweeps and moves. Members of a contact are 0 without a contact. The structs are
 * frozen: new data comes with a new getter. More: bindings/docs/contacts.md.
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
  DSW_OUTCOME_REACHED = 1,    /**< At the target. */
  DSW_OUTCOME_CONTACT = 2,    /**< At the first impassable face. */
  DSW_OUTCOME_WORK_LIMIT = 3, /**< Free, at the work limit. */
  DSW_OUTCOME_OUTSIDE = 4,    /**< Not begun: the start lies in no volume. */
  /** Not begun: the start, or the swept edge there, is not free. */
  DSW_OUTCOME_IMPASSABLE = 5,
  DSW_OUTCOME_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_outcome;

/** What part of the obstacle was touched. */
typedef enum dsw_contact_kind {
  DSW_CONTACT_NONE = 0,                     /**< None. */
  DSW_CONTACT_PLANE = 1,                    /**< The inside of a face. */
  DSW_CONTACT_EDGE = 2,                     /**< An edge. */
  DSW_CONTACT_VERTEX = 3,                   /**< A vertex. */
  DSW_CONTACT_KIND_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_contact_kind;

/** Report of a cast or a particle's move. */
typedef struct dsw_flight {
  /** End of the flight; verified to be free for a particle, rounded for a cast. */
  double position[3];
  /** Fraction of the move. At a contact: the largest double not later than the exact time. */
  double time;
  double normal[3];      /**< Unit normal of the boundary triangle, out of the obstacle. */
  dsw_volume_id volume;  /**< Volume at the end of the flight. */
  dsw_face_id face;      /**< Face that was hit, canonical. */
  dsw_volume_id behind;  /**< Volume behind it; null at the outer boundary. */
  dsw_outcome outcome;   /**< How the flight ended. */
  dsw_contact_kind kind; /**< DSW_CONTACT_PLANE. */
  /** DSW_CELL_FACE, or DSW_CELL_VOLUME if only the volume behind is marked. */
  dsw_cell_kind obstacle;
  uint32_t tag;           /**< Host tag behind the face; at the outer boundary, in front. */
  uint32_t cells_visited; /**< Volumes entered. */
  uint32_t reserved[2];   /**< 0. */
} dsw_flight;

/** One volume of a flight. */
typedef struct dsw_crossing {
  dsw_volume_id volume; /**< The volume. */
  dsw_face_id face;     /**< Its face of entry, canonical; null for the first. */
  double time;          /**< Time of entry, rounded down. */
} dsw_crossing;

/** Report of one swept edge. */
typedef struct dsw_sweep {
  double position[3]; /**< Moving end at `time`, rounded. */
  /** As in dsw_flight; 0 if the edge could not start or met the work limit. */
  double time;
  double point[3];  /**< Where the edge touches, rounded. */
  double along;     /**< Place on the edge: 0 moving end, 1 fixed end. */
  double normal[3]; /**< Unit normal, out of the obstacle. */
  /** Volume of the moving end; at its start unless REACHED. */
  dsw_volume_id volume;
  dsw_volume_id front;    /**< Passable volume at `face` or at the marked edge. */
  dsw_face_id face;       /**< Impassable face, canonical; null for a marked edge. */
  dsw_edge_id edge;       /**< DSW_CONTACT_EDGE: edge of the obstacle, canonical. */
  dsw_outcome outcome;    /**< How the sweep ended. */
  dsw_contact_kind kind;  /**< What part of the obstacle was touched. */
  dsw_cell_kind obstacle; /**< As in dsw_flight; DSW_CELL_EDGE for a marked edge. */
  uint32_t tag;           /**< As in dsw_flight; 0 for a marked edge. */
  uint32_t cells_visited; /**< Volumes looked at. */
  uint32_t reserved;      /**< 0. */
} dsw_sweep;

/** Whether the same obstacle stopped the vertex in the body's previous move. */
typedef enum dsw_contact_history {
  DSW_HISTORY_NONE = 0,                /**< No contact. */
  DSW_HISTORY_NEW = 1,                 /**< No. */
  DSW_HISTORY_LASTING = 2,             /**< Yes. */
  DSW_HISTORY_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_contact_history;

/** A contact of a body: a moving vertex, or one of its edges or faces, touched something. */
typedef struct dsw_contact {
  double from[3]; /**< Start of the moving vertex. */
  double to[3];   /**< Its target. */
  /** Other ends of the touching edge or face; else 0. */
  double fixed[2][3];
  double time;                 /**< As in dsw_sweep. By bisection: the body is free then. */
  double position[3];          /**< Moving vertex at `time`, rounded. */
  double point[3];             /**< Where the body touches, rounded. */
  double normal[3];            /**< Unit normal, out of the obstacle. */
  double along;                /**< Place on the edge: 0 moving vertex, 1 other end. */
  double distance_left;        /**< Length of the way not made. */
  dsw_body_vertex_id vertex;   /**< The moving vertex. */
  dsw_body_edge_id edge;       /**< The touching edge, or null. */
  dsw_body_face_id face;       /**< The touching face, or null. */
  dsw_cell obstacle;           /**< Touched face, edge or vertex, canonical. */
  dsw_face_id wall;            /**< Impassable face there; null for a marked edge or vertex. */
  dsw_volume_id front;         /**< Passable volume at `obstacle`. */
  dsw_contact_kind kind;       /**< What part of the obstacle was touched. */
  dsw_cell_kind cause;         /**< Kind of the marked cell; FACE at the outer boundary. */
  uint32_t tag;                /**< Host tag behind `wall`, or in front at the outer boundary. */
  dsw_contact_history history; /**< Whether the contact is new. */
} dsw_contact;

/** The previous contact of a vertex. The vertex rests or slides if `since` is 1, and bounces above
 * 1. */
typedef struct dsw_contact_past {
  /** Where this obstacle, or else anything, stopped the vertex before. */
  double point[3];
  double normal[3];  /**< Normal there. */
  dsw_cell obstacle; /**< Cell touched there; null for a body. */
  dsw_body_id body;  /**< Body touched there; null for the environment. */
  uint32_t since;    /**< Moves ago: 1 the move before, 0 never. */
  uint32_t moves;    /**< Moves in a row that this obstacle stopped. */
  uint32_t touching; /**< Moves in a row that anything stopped. */
  uint32_t reserved; /**< 0. */
} dsw_contact_past;

/** The touched body of a contact, or null. `obstacle`, `wall`, `cause` and `tag` of dsw_contact are
 * then 0, and `front` is where the vertex started. */
typedef struct dsw_contact_partner {
  dsw_body_id body;          /**< The body; maybe the moving one. */
  dsw_body_vertex_id vertex; /**< Its touched vertex, or null. */
  dsw_body_edge_id edge;     /**< Its touched edge, or null. */
  dsw_body_face_id face;     /**< Its touched face, or null. */
} dsw_contact_partner;

#ifdef __cplusplus
}
#endif

#endif
