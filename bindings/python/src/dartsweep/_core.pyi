"""Structs of the C interface. Other names of this module belong to the package; its classes are in the files beside this one."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

def __getattr__(name: str) -> Any: ...

class VertexId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class VolumeId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class FaceId:
    def __init__(self, volume: int, generation: int, local: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    volume: int
    generation: int
    local: int

class EdgeId:
    def __init__(self, volume: int, generation: int, local: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    volume: int
    generation: int
    local: int

class ParticleId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class BodyId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class BodyVertexId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class BodyEdgeId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class BodyFaceId:
    def __init__(self, index: int, generation: int) -> None: ...
    def is_null(self) -> bool: ...
    def __hash__(self) -> int: ...
    index: int
    generation: int

class Flight:
    position: NDArray[np.float64]
    time: float
    contact: Contact
    volume: VolumeId
    outcome: int
    volumes_visited: int

class Crossing:
    volume: VolumeId
    face: FaceId
    time: float

class Sweep:
    position: NDArray[np.float64]
    time: float
    point: NDArray[np.float64]
    edge_parameter: float
    contact: Contact
    volume: VolumeId
    outcome: int
    volumes_visited: int

class BodyContact:
    from_: NDArray[np.float64]
    to: NDArray[np.float64]
    fixed: NDArray[np.float64]
    position: NDArray[np.float64]
    time: float
    point: NDArray[np.float64]
    edge_parameter: float
    distance_left: float
    contact: Contact
    vertex: BodyVertexId
    edge: BodyEdgeId
    face: BodyFaceId
    history: int

class ContactPartner:
    body: BodyId
    vertex: BodyVertexId
    edge: BodyEdgeId
    face: BodyFaceId

class PreviousContact:
    point: NDArray[np.float64]
    normal: NDArray[np.float64]
    obstacle: Cell
    body: BodyId
    since: int
    moves: int
    touching: int

class BodyEdit:
    vertex: BodyVertexId
    ends: NDArray[np.void]
    edge: BodyEdgeId
    rest: BodyEdgeId
    edge_parameter: float
    inserted: int

class MoveReport:
    fraction: float
    vertices_moved: int
    vertices_stopped: int
    contact_count: int
    edit_count: int
    edges_swept: int
    edges_skipped: int
    vertices_limited: int

class NearRow:
    point: NDArray[np.float64]
    obstacle_point: NDArray[np.float64]
    normal: NDArray[np.float64]
    distance: float
    gap: float
    weights: NDArray[np.float64]
    obstacle_weights: NDArray[np.float64]
    vertices: NDArray[np.uint32]
    obstacle_vertices: NDArray[np.uint32]
    obstacle: Cell
    wall: FaceId
    tag: int
    body: BodyId
    key: NDArray[np.uint32]
    previous: int

class PairTouch:
    time: float
    touches: int
    rank: int

class WallContact:
    from_: NDArray[np.float64]
    to: NDArray[np.float64]
    time: float
    point: NDArray[np.float64]
    edge_parameter: float
    contact: Contact
    moving: VertexId
    others: NDArray[np.void]
    particle: ParticleId
    body: BodyId
    vertex: BodyVertexId
    edge: BodyEdgeId
    face: BodyFaceId
    response: int

class VolumeChange:
    before: VolumeId
    after: VolumeId

class VertexOrigin:
    vertex: VertexId
    from_: NDArray[np.void]
    weights: NDArray[np.float64]

class CutFace:
    front: FaceId
    back: FaceId

class FaceOrigin:
    face: FaceId
    volume: VolumeId

class Vec3:
    x: float
    y: float
    z: float

class Cell:
    kind: int
    index: int
    generation: int
    local: int

class Contact:
    normal: NDArray[np.float64]
    obstacle: Cell
    wall: FaceId
    front: VolumeId
    behind: VolumeId
    kind: int
    marked_kind: int
    tag: int

class Nearest:
    distance: float
    point: NDArray[np.float64]
    normal: NDArray[np.float64]
    cell: Cell
    tag: int
    volumes_visited: int

class SegmentNearest:
    nearest: Nearest
    segment_parameter: float
    segment_point: NDArray[np.float64]

class CrossCheck:
    normal: NDArray[np.float64]
    depth: float
    pushed_in: float
    angle_rad: float
    kind: int
    reason: int

class BuildReport:
    status: int
    offender_count: int
    offenders: NDArray[np.uint32]
    reoriented_count: int
    part_count: int
    unused_point_count: int
    boundary_face_count: int
    convex_volume_count: int
    reoriented_face_count: int
    merged_point_count: int
    changed_count: int
    changed: NDArray[np.uint32]
    touching_face_count: int
    touching_face: FaceId
    touched_face: FaceId

class EnvironmentInfo:
    dimension: int
    vertex_count: int
    volume_count: int
    face_count: int
    boundary_face_count: int
    part_count: int
    scene_count: int
    memory_bytes: int
    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    volume_index_count: int
    vertex_index_count: int

class Statistics:
    casts: int
    volumes_visited: int
    orientation_tests: int
    exact_fallbacks: int
    ties: int
    forecast_hits: int
    contacts: int
    candidates: int
    occupants_tested: int

class BodyCounts:
    vertex_count: int
    edge_count: int
    face_count: int
    vertex_slots: int
    edge_slots: int
    face_slots: int

class RigidMotion:
    rotation: NDArray[np.float64]
    centre: NDArray[np.float64]
    translation: NDArray[np.float64]

class DeformReport:
    fraction: float
    outcome: int
    steps: int
    near_count: int
    held_count: int
    contact_count: int
    invalid_count: int
    pushed_count: int
    remeshed_count: int

class Change:
    is_closed: int
    distance: float
    smallest_width: float
    largest_width: float
    volumes_visited: int
    volumes_crossed: int
    volumes_split: int
    volumes_changed: int
    vertices_parted: int
    vertices_shortened: int
    faces_sewn: int
    faces_unsewn: int
    volumes_invalid: int
    volumes_removed: int
    volumes_added: int
    patch_count: int
    most_faces: int
    volumes: NDArray[np.void]
    vertices: NDArray[np.void]
    faces: NDArray[np.void]
    whole: NDArray[np.void]
    carved: NDArray[np.void]
    unrepaired: NDArray[np.void]
    detached: NDArray[np.void]
    body_vertices: NDArray[np.void]
    body_faces: NDArray[np.void]

class Validation:
    is_right: int
    places: int
    lost: int
    edges: int
    crossing: int
    faces: int
    pierced: int
    ways: int
    missed: int
    contacts: int
    wrong: int
    not_validated: int
    text: str

class EnvironmentDesc:
    dimension: int
    flags: int
    uniform_cell_type: int
    merge_distance: float

class SceneDesc:
    features: int

class BodyDesc:
    flags: int
    level: int
    motion_share: float
    category: int
    mask: int
    radius: float

class VolumesDesc:
    uniform_cell_type: int

class CutDesc:
    flags: int
    start: VolumeId
    snap: float

class OpenCrackDesc:
    flags: int
    width: float
    region: int
    tag: int

class CarveDesc:
    flags: int
    start: VolumeId
    snap: float

class TieDesc:
    flags: int
    start: VolumeId
    snap: float

class DetachDesc:
    flags: int
    level: int
    category: int
    mask: int
    halvings: int
    motion_share: float
    gap: float
    volume: VolumeId
    max_volumes: int

class RemeshDesc:
    flags: int
    radius: int
    max_faces: int

class CastOptions:
    flags: int
    max_volumes: int

class SweepOptions:
    flags: int
    level: int
    max_volumes: int

class MoveOptions:
    flags: int
    vertex_response: int
    edge_response: int
    search: int
    bisection_depth: int
    max_volumes: int
    passes: int
    min_part: float
    min_length: float
    stand_off: float
    noise_share: float

class TogetherOptions:
    flags: int
    stop: int
    max_rounds: int
    max_work: int

class NearOptions:
    flags: int
    margin: float
    radius: float

class DeformOptions:
    flags: int
    method: int
    response: int
    invalid: int
    most_halvings: int
    min_part: float
    point_room: int
    remesh_radius: int
    remesh_max_faces: int
    max_holds: int

class CoarsenOptions:
    max_faces: int
    max_trials: int

class Located:
    volume: VolumeId
    location: int

class VolumeCounts:
    type: int
    vertices: int
    edges: int
    faces: int

class FaceVolumes:
    near_side: VolumeId
    far_side: VolumeId

class Neighbour:
    volume: VolumeId
    impassable: bool

class Marked:
    marked: int
    skipped: int

class VolumeSplit:
    left: VolumeId
    right: VolumeId
    face: FaceId

class FaceSplit:
    left: FaceId
    right: FaceId
    edge: EdgeId

class EdgeSplit:
    vertex: VertexId
    first: EdgeId
    second: EdgeId

class Particle:
    position: NDArray[np.float64]
    volume: VolumeId

class BodyFilter:
    category: int
    mask: int
