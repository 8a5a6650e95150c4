"""Exact contacts of moving bodies with a convex subdivision of space.

An Environment is a volume mesh; a Scene holds particles and bodies that move in it; see the README for examples. Arrays of points are
float64 of shape (n, 3), or (n, 2) in the plane; ids, flights and contacts come in structured arrays whose types are in dartsweep.dtypes. Every call that
fails raises an exception of dartsweep.errors and changes nothing.
"""

from __future__ import annotations

from . import dtypes, errors, meshes
from ._core import (
    BodyEdgeId,
    BodyFaceId,
    BodyId,
    BodyVertexId,
    CastOptions,
    Cell,
    CoarsenOptions,
    DeformOptions,
    EdgeId,
    FaceId,
    Flight,
    MoveOptions,
    ParticleId,
    RigidMotion,
    SweepOptions,
    Validation,
    VertexId,
    VolumeId,
    cell_of,
)
from .body import Body
from .enums import (
    BodyFlag,
    CarveFlag,
    CastFlag,
    CellKind,
    CellType,
    ContactHistory,
    ContactKind,
    CutFlag,
    DeformMethod,
    DeformOutcome,
    EnvironmentFlag,
    Feature,
    InvalidResponse,
    Level,
    LogLevel,
    Mark,
    MarkFlag,
    NoCrossCheck,
    CrossCheckKind,
    Outcome,
    Location,
    RecordingFlag,
    Response,
    Search,
    Status,
    SweepFlag,
    WallResponse,
)
from .environment import Environment
from .errors import Closed, Error
from .meshes import from_meshio
from .options import options, version
from .scene import Scene
from .trace import Trace

__version__ = version()

__all__ = [
    "Body",
    "BodyEdgeId",
    "BodyFaceId",
    "BodyFlag",
    "BodyId",
    "BodyVertexId",
    "CarveFlag",
    "CastFlag",
    "CastOptions",
    "Cell",
    "CellKind",
    "CellType",
    "Closed",
    "CoarsenOptions",
    "ContactHistory",
    "ContactKind",
    "CutFlag",
    "DeformMethod",
    "DeformOptions",
    "DeformOutcome",
    "EdgeId",
    "Environment",
    "EnvironmentFlag",
    "Error",
    "FaceId",
    "Feature",
    "Flight",
    "InvalidResponse",
    "Level",
    "LogLevel",
    "Mark",
    "MarkFlag",
    "MoveOptions",
    "NoCrossCheck",
    "CrossCheckKind",
    "Outcome",
    "ParticleId",
    "Location",
    "Response",
    "RecordingFlag",
    "RigidMotion",
    "Scene",
    "Search",
    "Status",
    "SweepFlag",
    "SweepOptions",
    "Trace",
    "Validation",
    "VertexId",
    "VolumeId",
    "WallResponse",
    "cell_of",
    "dtypes",
    "errors",
    "from_meshio",
    "meshes",
    "options",
    "version",
]
