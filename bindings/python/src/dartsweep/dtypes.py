"""NumPy's types of arrays of ids, reports and contacts: laid out as the structs of the C interface, so that neither side converts."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core

F8, U4, I4 = np.dtype(np.float64), np.dtype(np.uint32), np.dtype(np.int32)


def _struct(*fields: tuple[Any, ...]) -> np.dtype[np.void]:
    return np.dtype(list(fields), align=True)


def _id(kind: str, *names: str) -> np.dtype[np.void]:
    """Kinds of ids have the same layout: the metadata tell them apart, also where an id is a field of a result."""
    return np.dtype([(name, U4) for name in names], align=True, metadata={"id": kind})


VERTEX_ID = _id("VertexId", "index", "generation")
VOLUME_ID = _id("VolumeId", "index", "generation")
FACE_ID = _id("FaceId", "volume", "generation", "local")
EDGE_ID = _id("EdgeId", "volume", "generation", "local")
PARTICLE_ID = _id("ParticleId", "index", "generation")
BODY_ID = _id("BodyId", "index", "generation")
BODY_VERTEX_ID = _id("BodyVertexId", "index", "generation")
BODY_EDGE_ID = _id("BodyEdgeId", "index", "generation")
BODY_FACE_ID = _id("BodyFaceId", "index", "generation")
CELL = _struct(("kind", I4), ("index", U4), ("generation", U4), ("local", U4))
CONTACT = _struct(
    ("normal", F8, 3),
    ("obstacle", CELL),
    ("wall", FACE_ID),
    ("front", VOLUME_ID),
    ("behind", VOLUME_ID),
    ("kind", I4),
    ("marked_kind", I4),
    ("tag", U4),
)
FLIGHT = _struct(
    ("position", F8, 3),
    ("time", F8),
    ("contact", CONTACT),
    ("volume", VOLUME_ID),
    ("outcome", I4),
    ("volumes_visited", U4),
)
CROSSING = _struct(("volume", VOLUME_ID), ("face", FACE_ID), ("time", F8))
SWEEP = _struct(
    ("position", F8, 3),
    ("time", F8),
    ("point", F8, 3),
    ("edge_parameter", F8),
    ("contact", CONTACT),
    ("volume", VOLUME_ID),
    ("outcome", I4),
    ("volumes_visited", U4),
)
NEAREST = _struct(
    ("distance", F8),
    ("point", F8, 3),
    ("normal", F8, 3),
    ("cell", CELL),
    ("tag", U4),
    ("volumes_visited", U4),
)
SEGMENT_NEAREST = _struct(("nearest", NEAREST), ("segment_parameter", F8), ("segment_point", F8, 3))
BODY_CONTACT = _struct(
    ("from", F8, 3),
    ("to", F8, 3),
    ("fixed", F8, (2, 3)),
    ("position", F8, 3),
    ("time", F8),
    ("point", F8, 3),
    ("edge_parameter", F8),
    ("distance_left", F8),
    ("contact", CONTACT),
    ("vertex", BODY_VERTEX_ID),
    ("edge", BODY_EDGE_ID),
    ("face", BODY_FACE_ID),
    ("history", I4),
    ("reserved", U4),
)
CONTACT_PARTNER = _struct(("body", BODY_ID), ("vertex", BODY_VERTEX_ID), ("edge", BODY_EDGE_ID), ("face", BODY_FACE_ID))
PREVIOUS_CONTACT = _struct(
    ("point", F8, 3),
    ("normal", F8, 3),
    ("obstacle", CELL),
    ("body", BODY_ID),
    ("since", U4),
    ("moves", U4),
    ("touching", U4),
    ("reserved", U4),
)
BODY_EDIT = _struct(
    ("vertex", BODY_VERTEX_ID),
    ("ends", BODY_VERTEX_ID, 2),
    ("edge", BODY_EDGE_ID),
    ("rest", BODY_EDGE_ID),
    ("edge_parameter", F8),
    ("inserted", U4),
    ("reserved", U4),
)
MOVE_REPORT = _struct(
    ("fraction", F8),
    ("vertices_moved", U4),
    ("vertices_stopped", U4),
    ("contact_count", U4),
    ("edit_count", U4),
    ("edges_swept", U4),
    ("edges_skipped", U4),
    ("vertices_limited", U4),
    ("reserved", U4),
)
NEAR_ROW = _struct(
    ("point", F8, 3),
    ("obstacle_point", F8, 3),
    ("normal", F8, 3),
    ("distance", F8),
    ("gap", F8),
    ("weights", F8, 3),
    ("obstacle_weights", F8, 3),
    ("vertices", U4, 3),
    ("obstacle_vertices", U4, 3),
    ("obstacle", CELL),
    ("wall", FACE_ID),
    ("tag", U4),
    ("body", BODY_ID),
    ("key", U4, 4),
    ("previous", U4),
    ("reserved", U4),
)
PAIR_TOUCH = _struct(("time", F8), ("touches", U4), ("rank", U4))
WALL_CONTACT = _struct(
    ("from", F8, 3),
    ("to", F8, 3),
    ("time", F8),
    ("point", F8, 3),
    ("edge_parameter", F8),
    ("contact", CONTACT),
    ("moving", VERTEX_ID),
    ("others", VERTEX_ID, 2),
    ("particle", PARTICLE_ID),
    ("body", BODY_ID),
    ("vertex", BODY_VERTEX_ID),
    ("edge", BODY_EDGE_ID),
    ("face", BODY_FACE_ID),
    ("response", I4),
    ("reserved", U4),
)
VOLUME_CHANGE = _struct(("before", VOLUME_ID), ("after", VOLUME_ID))
VERTEX_ORIGIN = _struct(("vertex", VERTEX_ID), ("from", VERTEX_ID, 2), ("weights", F8, 2))
CUT_FACE = _struct(("front", FACE_ID), ("back", FACE_ID))
FACE_ORIGIN = _struct(("face", FACE_ID), ("volume", VOLUME_ID))


def surface(length: int) -> np.dtype[np.void]:
    """The type of what Environment.surfaces_of tells: a tag and a name of at most this length."""
    return np.dtype([("tag", np.int64), ("name", f"U{length}")])


_core.set_dtype_Cell(CELL)
_core.set_dtype_VertexId(VERTEX_ID)
_core.set_dtype_VolumeId(VOLUME_ID)
_core.set_dtype_FaceId(FACE_ID)
_core.set_dtype_EdgeId(EDGE_ID)
_core.set_dtype_ParticleId(PARTICLE_ID)
_core.set_dtype_BodyId(BODY_ID)
_core.set_dtype_BodyVertexId(BODY_VERTEX_ID)
_core.set_dtype_BodyEdgeId(BODY_EDGE_ID)
_core.set_dtype_BodyFaceId(BODY_FACE_ID)
_core.set_dtype_Flight(FLIGHT)
_core.set_dtype_Crossing(CROSSING)
_core.set_dtype_Sweep(SWEEP)
_core.set_dtype_Nearest(NEAREST)
_core.set_dtype_SegmentNearest(SEGMENT_NEAREST)
_core.set_dtype_BodyContact(BODY_CONTACT)
_core.set_dtype_ContactPartner(CONTACT_PARTNER)
_core.set_dtype_PreviousContact(PREVIOUS_CONTACT)
_core.set_dtype_BodyEdit(BODY_EDIT)
_core.set_dtype_MoveReport(MOVE_REPORT)
_core.set_dtype_NearRow(NEAR_ROW)
_core.set_dtype_PairTouch(PAIR_TOUCH)
_core.set_dtype_WallContact(WALL_CONTACT)
_core.set_dtype_VolumeChange(VOLUME_CHANGE)
_core.set_dtype_VertexOrigin(VERTEX_ORIGIN)
_core.set_dtype_CutFace(CUT_FACE)
_core.set_dtype_FaceOrigin(FACE_ORIGIN)
