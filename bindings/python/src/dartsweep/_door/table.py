"""Which library reads a file: by its ending and its first bytes. The table of bindings/docs/meshes.md is this one."""

from __future__ import annotations

import dataclasses
import os
import re

_KNOWN_BY_BYTES = 4096


@dataclasses.dataclass(frozen=True)
class Reader:
    """One way to read a file."""

    library: str
    """A key of LIBRARIES."""
    format: str
    """What the reader calls the format."""


@dataclasses.dataclass(frozen=True)
class Dialect:
    """Files of one kind."""

    name: str
    endings: tuple[str, ...]
    readers: tuple[Reader, ...]
    """The one that loses least first; the next where that is not installed."""
    kept: str
    """What is kept besides cells."""
    begins: str = ""
    """A regular expression for the first bytes, where one ending has several kinds."""


LIBRARIES = {  # module to import, extra, title
    "vtk": ("vtkmodules", "vtk", "VTK"),
    "meshio": ("meshio", "mesh", "meshio"),
    "gmsh": ("gmsh", "gmsh", "Gmsh"),
    "mfem": ("mfem", "mfem", "PyMFEM"),
    **{name: ("h5py", name, "h5py") for name in ("med", "moab")},
    **{name: ("numpy", "", "NumPy") for name in ("abaqus", "ansys", "elmer", "exodus", "febio", "gambit", "gid", "kratos", "lsdyna", "netgen", "off", "su2", "ucd", "unv")},
    "surface": ("trimesh", "surfaces", "trimesh, TetGen"),
}

_XML = (".vtu", ".vtp", ".vts", ".vtr", ".vti", ".vtm", ".vtmb", ".pvtu", ".pvtp", ".pvts", ".pvtr", ".pvti")
_EXODUS = (".e", ".exo", ".ex2", ".exii", ".exd", ".g", ".gen", ".ncdf", ".nc")


def _dialect(name: str, endings: str | tuple[str, ...], readers: str, kept: str, begins: str = "") -> Dialect:
    ways = tuple(Reader(*way.split(":")) for way in readers.split())
    return Dialect(name, tuple(endings.split()) if isinstance(endings, str) else endings, ways, kept, begins)


DIALECTS = (
    _dialect("VTK, legacy", ".vtk", "vtk:legacy meshio:vtk", "cell data; polyhedra", r"\s*# vtk DataFile"),
    _dialect("VTK, XML", _XML, "vtk:xml", "cell data; polyhedra; blocks as groups; pieces are sewn, their ghost cells left out"),
    _dialect("VTK, collection", ".pvd", "vtk:pvd", "the first time; parts as groups"),
    _dialect("VTK HDF", ".vtkhdf .hdf .hdf5 .h5", "vtk:hdf", "cell data; polyhedra; blocks as groups", r"\x89HDF(?s:.*)VTKHDF"),
    _dialect("Exodus II", _EXODUS, "exodus:exodus vtk:exodus", "blocks as regions; side sets; sets of elements; all with names"),
    _dialect("CGNS", ".cgns", "vtk:cgns", "zones as regions; boundary conditions by name; sections of faces"),
    _dialect("EnSight", ".case .encas", "vtk:ensight", "parts as regions and patches"),
    _dialect("OpenFOAM", ".foam", "vtk:foam", "patches; polyhedra"),
    _dialect("AVS UCD", ".ucd .inp .avs", "ucd:ucd vtk:ucd", "materials", r"(?:\s*#[^\n]*\n)*\s*\d+[ \t]+\d+[ \t]+\d+[ \t]+\d+[ \t]+\d+|\x07"),
    _dialect("Tecplot", ".tec .dat .plt", "meshio:tecplot vtk:tecplot", "cell data", r"(?is)(?:\s*#[^\n]*\n)*\s*(?:TITLE|VARIABLES|ZONE)"),
    _dialect("Gmsh", ".msh .msh2 .msh4 .mesh", "gmsh:msh meshio:gmsh", "physical groups, also overlapping ones; partitions", r"\s*\$(?!.*DOLFIN)"),
    _dialect("ANSYS Fluent", ".msh .cas", "vtk:fluent meshio:ansys", "zones of cells as regions; zones of faces; polyhedra", r"\s*\("),
    _dialect("I-deas", ".unv", "unv:unv", "groups; properties as regions", r"\s*-1\s"),
    _dialect("MED", ".med", "med:med gmsh:med meshio:med", "groups; polyhedra; several meshes as regions", r"\x89HDF"),
    _dialect("Nastran", ".bdf .nas .fem", "gmsh:bdf meshio:nastran", "properties as regions; coordinate systems"),
    _dialect("Gambit, neutral", ".neu", "gambit:neu", "groups as regions; boundary conditions", r"\s*CONTROL INFO"),
    _dialect("Abaqus", ".inp .msh", "abaqus:inp", "sets of elements; surfaces; coordinate systems; rows in files of their own", r"\s*\*"),
    _dialect("Ansys, blocks", ".cdb .dat", "ansys:cdb", "materials as regions; components of elements", r"(?i)\s*(?:[/!]|[ne]block|c\*\*\*)"),
    _dialect("LS-DYNA", ".k .key .dyn", "lsdyna:k", "parts as regions; sets of elements, parts and segments; files that it includes"),
    _dialect("Diffpack", ".diff", "gmsh:diff", "materials"),
    _dialect("MFEM", ".mesh .mfem", "mfem:mfem", "attributes as regions and surfaces, with names; curves", r"\s*MFEM "),
    _dialect("Netgen, neutral", ".mesh", "mfem:netgen", "sub-domains", r"\s*(?:NETGEN|areamesh2|curved_areamesh2)"),
    _dialect("Medit", ".mesh .meshb", "meshio:medit gmsh:mesh", "references as regions and surfaces", r"(?:\s*#[^\n]*\n)*\s*MeshVersionFormatted|\x01\0\0\0|\0\0\0\x01"),
    _dialect("MOAB", ".h5m", "moab:h5m", "material sets as regions; Neumann sets; sets by name", r"\x89HDF"),
    _dialect("XDMF", ".xdmf .xmf", "meshio:xdmf vtk:xdmf", "cell data; of several times the first", r"\s*<"),
    _dialect("Netgen", ".vol", "netgen:vol", "materials as regions; boundary conditions; both with names", r"\s*(?:#[^\n]*\n\s*)*mesh3d"),
    _dialect("TetGen", ".ele .node", "meshio:tetgen", "attributes"),
    _dialect("SU2", ".su2", "su2:su2", "markers by name; zones as regions"),
    _dialect("DOLFIN", ".xml", "meshio:dolfin-xml", "cell data", r"(?s)\s*<(?:.*<)?dolfin"),
    _dialect("FLAC3D", ".f3grid", "meshio:flac3d", "groups"),
    _dialect("Kratos", ".mdpa", "kratos:mdpa", "properties as regions; sub-model parts"),
    _dialect("FEBio", ".feb", "febio:feb", "parts, or materials in version 1, as regions; surfaces; sets of elements; lists of parts", r"\s*<"),
    _dialect("Elmer", ".header", "elmer:elmer", "bodies as regions; boundaries; both with names"),
    _dialect("GiD", ".msh", "gid:gid", "meshes and materials as regions", r"(?is)\s*(?:#[^\n]*\n\s*)*(?:GROUP\b[^\n]*\n\s*)?MESH\b[^\n]*\bELEMTYPE\b"),
    _dialect("PERMAS", ".post .dato", "meshio:permas", "cells only"),
    _dialect("AFLR", ".ugrid", "meshio:ugrid", "references"),
    _dialect("H5M of meshio", ".hmf", "meshio:hmf", "cell data"),
    _dialect("OFF", ".off", "off:off", "triangles, quads and polygons"),
    _dialect("Surfaces", ".stl .obj .ply", "surface:surface", "the wall; the inside is filled with tetrahedra"),
)

STRANGERS = (  # first bytes of files that nothing here reads, what they are, and a way on
    (r"#usda|PXR-USDC", "it is a stage of USD", "dartsweep.Environment takes the points and tetVertexIndices of a TetMesh"),
    (r"#!TDV", "it is Tecplot's binary", "Tecplot and ParaView can write it as text or as VTK's"),
    (r"(?s).*GID_MESHSET", "it is a project of GiD", "GiD can export its mesh, such as for Abaqus or Nastran"),
)


def stranger(path: str) -> tuple[str, str] | None:
    """What a file is that has the ending of others, and a way on."""
    head = _head(path)
    return next(((what, way_on) for begins, what, way_on in STRANGERS if re.match(begins, head)), None)


def dialects_of(path: str) -> list[Dialect]:
    """Kinds of files that a file may be, by its ending and by its first bytes."""
    ending = os.path.splitext(path)[1].lower()
    head = _head(path)
    return [dialect for dialect in DIALECTS if ending in dialect.endings and re.match(dialect.begins, head)]


def _head(path: str) -> str:
    with open(path, "rb") as file:
        return file.read(_KNOWN_BY_BYTES).decode("latin-1")


def is_surface(path: str | os.PathLike[str]) -> bool:
    """Whether a file holds a surface by its ending."""
    return os.path.splitext(os.fspath(path))[1].lower() in DIALECTS[-1].endings


def endings() -> list[str]:
    """All endings that are known."""
    return sorted({ending for dialect in DIALECTS for ending in dialect.endings})
