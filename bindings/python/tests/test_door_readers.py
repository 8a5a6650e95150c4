"""Files of meshio, Gmsh, MFEM, MOAB and Abaqus: cells, sums of volumes, regions and patches, against what a second reader says."""

from __future__ import annotations

import pathlib
from collections.abc import Iterator
from typing import Any

import meshio
import numpy as np
import pytest

import dartsweep as ds
from volumes import CUBE, PRISM, TETRA, box, content, volume_of


def model(gmsh: Any, recombine: bool, order: int = 1) -> None:
    """A square pipe by extrusion, in two regions, with an inlet; one group holds both regions."""
    face = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    low = gmsh.model.occ.extrude([(2, face)], 0, 0, 1, numElements=[2], recombine=recombine)
    high = gmsh.model.occ.extrude([low[0]], 0, 0, 1, numElements=[1], recombine=recombine)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [low[1][1]], 7, "lumen")
    gmsh.model.addPhysicalGroup(3, [high[1][1]], 9, "tissue")
    gmsh.model.addPhysicalGroup(2, [face], 3, "inlet")
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.6)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)


def gmsh_or_skip() -> Any:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        pytest.skip(f"the module gmsh needs libraries of the screen: {error}")
    return gmsh


@pytest.fixture
def gmsh() -> Iterator[Any]:
    module = gmsh_or_skip()
    module.initialize(readConfigFiles=False)
    module.option.setNumber("General.Terminal", 0)
    module.model.add("test")
    yield module
    module.finalize()


@pytest.mark.parametrize("recombine", [False, True])
def test_formats_of_gmsh_keep_cells_regions_and_patches(gmsh: Any, tmp_path: pathlib.Path, recombine: bool) -> None:
    model(gmsh, recombine)
    models, tags = gmsh.model.list(), gmsh.model.mesh.getElements(3)[1]
    count, inlet = sum(map(len, tags)), sum(map(len, gmsh.model.mesh.getElements(2, 1)[1]))
    of_lumen = gmsh.model.getEntitiesForPhysicalGroup(3, 7)
    lumen = sum(len(own) for entity in of_lumen for own in gmsh.model.mesh.getElements(3, int(entity))[1])
    with ds.from_gmsh() as environment:
        assert environment.info.volume_count == count and volume_of(environment) == pytest.approx(2) and environment.notes == ()
        assert environment.region_names == {"lumen": 7, "tissue": 9} and len(environment.faces("inlet")) == inlet
    assert gmsh.model.getCurrent() == "test"
    files = [("msh", version, binary) for version in (2.2, 4.0, 4.1) for binary in (0, 1) if (version, binary) != (4.0, 1)] + [("unv", 4.1, 0), ("med", 4.1, 0), ("inp", 4.1, 0)]
    for ending, version, binary in files:
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        path = str(tmp_path / f"pipe{version}-{binary}.{ending}")
        gmsh.write(path)
        with ds.read(path) as environment:
            assert environment.info.volume_count == count and volume_of(environment) == pytest.approx(2), path
            assert environment.mark_region("lumen")[0] == lumen and len(environment.faces("inlet")) == inlet, path
            assert not any("inside out" in note for note in environment.notes), path
    assert gmsh.model.getCurrent() == "test" and gmsh.model.list() == models
    for ending, version in (("msh", 1), ("bdf", 4.1), ("cgns", 4.1), ("su2", 4.1), ("vtk", 4.1)):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", 0)
        gmsh.write(str(tmp_path / f"plain.{ending}"))
        with ds.read(tmp_path / f"plain.{ending}") as environment:
            assert environment.info.volume_count == count and volume_of(environment) == pytest.approx(2), ending


@pytest.mark.parametrize(("ending", "format", "options"), [("msh", "gmsh22", {"binary": False}), ("msh", "gmsh22", {"binary": True}), ("inp", "abaqus", {})])
def test_points_stay_in_the_order_of_the_file(ending: str, format: str, options: dict[str, bool], tmp_path: pathlib.Path) -> None:
    """Gmsh has them entity by entity, so the points of a surface would come first."""
    points, cells = box()
    sides = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    every = np.concatenate([cells[:, side] for side in sides])
    _, first, counts = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    outside = every[first[counts == 1]][::-1]
    data = {f"gmsh:{name}": [np.full(len(outside), 3), np.full(len(cells), 10)] for name in ("physical", "geometrical")} if ending == "msh" else {}
    meshio.write(tmp_path / f"box.{ending}", meshio.Mesh(points, [("quad", outside), ("hexahedron", cells)], cell_data=data), format, **options)
    with ds.read(tmp_path / f"box.{ending}") as environment:
        assert np.array_equal(environment.points(), points)
        assert np.all(environment.find_faces(np.arange(0, outside.size + 1, 4), outside.ravel())["generation"] != 0)


def test_partitioned_and_overlapping_groups_of_gmsh(gmsh: Any, tmp_path: pathlib.Path) -> None:
    model(gmsh, False)
    gmsh.model.addPhysicalGroup(3, [tag for _, tag in gmsh.model.getEntities(3)], 1, "all")
    count = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
    gmsh.write(str(tmp_path / "overlap.msh"))
    gmsh.model.mesh.partition(3)
    gmsh.write(str(tmp_path / "parts.msh"))
    for name in ("overlap", "parts"):
        with ds.read(tmp_path / f"{name}.msh") as environment:
            assert environment.info.volume_count == count and environment.info.part_count == 1 and volume_of(environment) == pytest.approx(2)
            assert environment.mark_region("all")[0] == count and 0 < environment.mark_region("lumen", mark=False)[0] < count


def test_gmsh_runs_no_options_beside_a_file(gmsh: Any, tmp_path: pathlib.Path) -> None:
    model(gmsh, False)
    path = tmp_path / "pipe.msh"
    gmsh.write(str(path))
    (tmp_path / "pipe.msh.opt").write_text(f'SystemCall "touch {tmp_path / "ran"}";\n')
    with ds.read(path) as environment:
        assert environment.info.volume_count > 0
    assert not (tmp_path / "ran").exists()


def test_elements_that_gmsh_leaves_out_are_told(tmp_path: pathlib.Path) -> None:
    gmsh_or_skip()
    nodes = "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate([*TETRA, (0, 0, -1)], 1))
    path = tmp_path / "same.msh"
    path.write_text(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n{nodes}$EndNodes\n$Elements\n2\n4 4 2 0 1 1 2 3 4\n4 4 2 0 1 1 3 2 5\n$EndElements\n")
    with ds.read(path) as environment:
        assert environment.info.volume_count == 2 and "meshio read it, after: Gmsh keeps 1 of 2 elements" in environment.notes[0]


def test_wedges_of_medit_that_gmsh_leaves_out_are_told(tmp_path: pathlib.Path) -> None:
    gmsh_or_skip()
    from dartsweep._door import gmsh_reader

    meshio.write(tmp_path / "two.mesh", meshio.Mesh(np.array([*PRISM, (0, 0, -1.0)]), [("tetra", [[0, 2, 1, 6]]), ("wedge", [list(range(6))])]), "medit")
    with pytest.raises(ds.MeshError, match="Gmsh leaves out its prisms, without a word"):
        gmsh_reader.read(str(tmp_path / "two.mesh"), "the file", "mesh")
    with ds.read(tmp_path / "two.mesh") as environment:
        assert environment.info.volume_count == 2


def test_what_meshio_would_leave_out_is_not_lost(tmp_path: pathlib.Path) -> None:
    import pyvista

    voxel = pyvista.UnstructuredGrid(np.array([8, *range(8), 8, *range(8, 16)]), [11, 12], np.concatenate([CUBE[[0, 1, 3, 2, 4, 5, 7, 6]], CUBE + (1, 0, 0)]))
    voxel.save(tmp_path / "both.vtu")
    with ds.read(tmp_path / "both.vtu", merge_points=0.0) as environment:
        assert environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(2)
        assert environment.info.part_count == 1
    from dartsweep._door import meshio_reader

    with pytest.raises(ds.MeshError, match="meshio would leave out a part"):
        meshio_reader.read(str(tmp_path / "both.vtu"), "the file", "vtu")


def test_polyhedra_of_meshio() -> None:
    faces = [[0, 1, 5, 4], [1, 2, 6, 5], [7, 6, 2, 3], [3, 0, 4, 7], [0, 1, 2, 3], [4, 5, 6, 7]]  # turned both ways
    with ds.from_meshio(meshio.Mesh(CUBE, [("polyhedron8", [[np.array(face) for face in faces]])])) as environment:
        assert environment.volume_counts(environment.volume_id(0)).type == ds.CellType.POLYHEDRON and volume_of(environment) == pytest.approx(1)
        assert "faces of 1 polyhedra were turned" in environment.notes[0]


def test_sets_that_name_cells_that_are_not_there_are_errors() -> None:
    both = meshio.Mesh(TETRA, [("triangle", [[0, 1, 2]]), ("tetra", [[0, 1, 2, 3]])], cell_sets={"default": [np.array([0, 1]), np.array([0])]})
    with pytest.raises(ds.MeshError, match="the set 'default' names cell 1 of a block of 1 cells"):
        ds.from_meshio(both)


ABAQUS = """*HEADING
two cells
*NODE
{nodes}
*ELEMENT, TYPE=C3D8R
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, type=C3D6, ELSET=tissue
2, 2, 9, 3,
6, 10, 7
*ELSET, ELSET=all, GENERATE
1, 2, 1
*ELSET, ELSET=both
all, tissue
*SURFACE, NAME=inlet, TYPE=ELEMENT
1, S1
tissue, S1
** the end
"""


def test_sets_and_surfaces_of_abaqus(tmp_path: pathlib.Path) -> None:
    nodes = "\n".join(f"{i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate([*CUBE, (2, 0, 0), (2, 0, 1)], 1))
    (tmp_path / "two.inp").write_text(ABAQUS.format(nodes=nodes))
    with ds.read(tmp_path / "two.inp") as environment:
        assert volume_of(environment) == pytest.approx(1.5) and environment.notes == ()
        wedge = environment.volume_id(1)
        assert environment.volume_counts(wedge).type == ds.CellType.WEDGE
        assert environment.mark_region("tissue")[0] == 1 and environment.is_impassable(wedge)
        assert environment.mark_region("both")[0] == 2 and len(environment.faces("inlet")) == 2


MFEM = """MFEM mesh v1.3

dimension
3

elements
2
1 6 0 1 2 3 4 5
2 4 0 2 1 6

attribute_sets
1
"tip" 1 2

boundary
1
5 2 3 4 5

bdr_attribute_sets
1
"outlet" 1 5

vertices
7
3
{nodes}

mfem_mesh_end
"""


def test_attributes_and_curves_of_mfem(tmp_path: pathlib.Path) -> None:
    mfem = pytest.importorskip("mfem.ser")
    path = tmp_path / "two.mesh"
    path.write_text(MFEM.format(nodes="\n".join("%g %g %g" % tuple(point) for point in [*PRISM, (0, 0, -1)])))
    with ds.read(path) as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.regions() == [1, 2] and environment.notes == ()
        assert environment.mark_region("tip")[0] == 1 and len(environment.faces("outlet")) == 1
    second = mfem.Mesh(str(path), 1, 0)
    assert sum(second.GetElementVolume(i) for i in range(second.GetNE())) == pytest.approx(0.5 + 1 / 6)
    curved = mfem.Mesh.MakeCartesian2D(3, 3, mfem.Element.QUADRILATERAL, True, 3.0, 3.0)
    curved.SetCurvature(2)
    curved.Print(str(tmp_path / "curved.mesh"))
    for quadratic, count in (("corners", 9), ("split", 36)):
        with ds.read(tmp_path / "curved.mesh", quadratic=quadratic) as environment:
            assert environment.info.volume_count == count and volume_of(environment) == pytest.approx(9)
            assert ("degree 2" in "".join(environment.notes)) == (quadratic == "corners")


def test_cells_of_mfem_that_were_refined_beside_others(tmp_path: pathlib.Path) -> None:
    """Faces between large and small cells are split, and sides with hanging points stay on their surfaces."""
    mfem = pytest.importorskip("mfem.ser")
    mesh = mfem.Mesh.MakeCartesian3D(2, 1, 1, mfem.Element.HEXAHEDRON)
    mesh.EnsureNCMesh(True)
    mesh.GeneralRefinement(mfem.intArray([0]), 1)
    path = tmp_path / "refined.mesh"
    mesh.Print(str(path))
    sides = [mesh.GetBdrAttribute(i) for i in range(mesh.GetNBE())]
    with ds.read(path) as environment:
        assert environment.info.volume_count == mesh.GetNE() == 9 and environment.info.part_count == 1 and volume_of(environment) == pytest.approx(1)
        assert [note.partition(":")[0] for note in environment.notes] == ["cells were refined beside others"]
        assert {name: len(environment.faces(name)) for name in environment.surface_names} == {str(side): sides.count(side) for side in set(sides)}
        assert environment.cast((0.1, 0.2, 0.2), (0.9, 0.3, 0.4)).outcome == ds.Outcome.REACHED
        environment.check()
    with ds.read(path, inner_walls=True) as loose:
        assert loose.info.part_count == 2


ASSEMBLY = """*HEADING
*PART, NAME=block
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=all
1, 1, 2, 3, 4, 5, 6, 7, 8
*SURFACE, NAME=top
all, S2
*END PART
*PART, NAME=tip
*NODE
11, 0, 0, 0
12, 1, 0, 0
13, 0, 1, 0
14, 0, 0, 1
*ELEMENT, TYPE=C3D4
3, 11, 12, 13, 14
*END PART
*ASSEMBLY, NAME=both
*INSTANCE, NAME=left, PART=block
*END INSTANCE
*INSTANCE, NAME=right, PART=block
{placed}*END INSTANCE
*INSTANCE, NAME=point, PART=tip
0, 0, 5
*END INSTANCE
*NODE
1, 9, 9, 9
*ELSET, ELSET=chosen, INSTANCE=right
1
*ELSET, ELSET=chosen, INSTANCE=point, GENERATE
3, 3, 1
*ELSET, ELSET=_outlet_S1, INTERNAL, INSTANCE=left
1
*SURFACE, NAME=outlet
_outlet_S1, S1
*END ASSEMBLY
"""


def test_parts_of_abaqus_that_are_placed_several_times(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "assembly.inp"
    path.write_text(ASSEMBLY.format(placed="3, 0, 0\n3, 0, 0, 3, 0, 1, 90\n"))  # moved by 3, then turned about its edge upwards
    with ds.read(path) as environment:
        assert environment.info.volume_count == 3 and volume_of(environment) == pytest.approx(2 + 1 / 6) and environment.notes == ()
        assert environment.locate((2.5, 0.5, 0.5))[0].index == 1 and environment.locate((3.5, 0.5, 0.5))[1] == ds.Location.OUTSIDE
        assert environment.mark_region("left", mark=False)[0] == environment.mark_region("point", mark=False)[0] == 1
        assert environment.mark_region("chosen", mark=False)[0] == 2 and set(environment.region_groups) == {"left", "right", "point", "left.all", "right.all", "chosen"}
        assert environment.surface_names.keys() == {"left.top", "right.top", "outlet"} and environment.centre(environment.volume_id(1)).tolist() == pytest.approx([2.5, 0.5, 0.5])
        assert [int(environment.faces(name)[0]["volume"]) for name in ("left.top", "right.top", "outlet")] == [0, 1, 0]
    path.write_text(ASSEMBLY.format(placed="").replace("PART=tip", "PART=tail"))
    with pytest.raises(ds.MeshError, match="it places a part 'TAIL' that it does not have"):
        ds.read(path)
    path.write_text(ASSEMBLY.format(placed=""))
    with pytest.raises(ds.MeshError, match="12 faces of the boundary lie on faces"):
        ds.read(path)


def test_sets_of_moab(tmp_path: pathlib.Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "two.h5m", "w") as file:

        def put(name: str, data: Any, **attributes: Any) -> None:
            file["tstt/" + name] = np.asarray(data)
            file["tstt/" + name].attrs.update(attributes)

        put("nodes/coordinates", [*PRISM, (0.0, 0.0, -1.0)], start_id=1)
        put("elements/Prism6/connectivity", [[1, 2, 3, 4, 5, 6]], start_id=8)
        put("elements/Tet4/connectivity", [[1, 3, 2, 7]], start_id=9)
        put("elements/Tri3/connectivity", [[4, 5, 6]], start_id=10)
        put("sets/list", [[1, -1, -1, 8], [2, -1, -1, 0], [3, -1, -1, 0]], start_id=11)
        put("sets/contents", [8, 1, 9, 10])
        put("tags/MATERIAL_SET/id_list", [11, 12])
        put("tags/MATERIAL_SET/values", [4, 6])
        put("tags/NEUMANN_SET/id_list", [13])
        put("tags/NEUMANN_SET/values", [2])
        put("tags/NAME/id_list", [12])
        put("tags/NAME/values", np.array([b"tip"], "S32"))
    with ds.read(tmp_path / "two.h5m") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
        assert environment.regions() == [4, 6] and environment.mark_region("tip")[0] == 1 and len(environment.faces("2")) == 1


def test_polygons_of_moab(tmp_path: pathlib.Path) -> None:
    h5py = pytest.importorskip("h5py")
    corners = [(0, 0), (2, 0), (3, 1), (2, 2), (0, 2), (0, 3), (2, 3)]
    with h5py.File(tmp_path / "plane.h5m", "w") as file:
        for name, data, first in (
            ("nodes/coordinates", [(x, y, 0.0) for x, y in corners], 1),
            ("elements/Polygon5/connectivity", [[1, 2, 3, 4, 5]], 8),
            ("elements/Polygon4/connectivity", [[5, 4, 7, 6]], 9),
        ):
            file["tstt/" + name] = np.asarray(data)
            file["tstt/" + name].attrs["start_id"] = first
    with ds.read(tmp_path / "plane.h5m") as environment:
        assert environment.info.dimension == 2 and environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(7)
        assert environment.volume_counts(environment.volume_id(0)).vertices == 5


def test_volumes_of_moab_that_triangles_bound_are_told(tmp_path: pathlib.Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "pin.h5m", "w") as file:
        for name, data, start in (("nodes/coordinates", np.array(TETRA, float), 1), ("elements/Tri3/connectivity", [[1, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]], 5)):
            file["tstt/" + name] = data
            file["tstt/" + name].attrs["start_id"] = start
        file["tstt/tags/GEOM_DIMENSION/id_list"], file["tstt/tags/GEOM_DIMENSION/values"] = [9, 10], [3, 3]
    with pytest.raises(ds.MeshError, match="its triangles bound 2 volumes of a geometry, which have no cells"):
        ds.read(tmp_path / "pin.h5m")


def test_cells_of_meshio_with_gmsh_vtk_and_mfem_are_one_environment(tmp_path: pathlib.Path) -> None:
    """A box of wedges, written by meshio and read by all."""
    points, cells = box()
    wedges = np.concatenate([cells[:, [0, 1, 2, 4, 5, 6]], cells[:, [0, 2, 3, 4, 6, 7]]])
    mesh = meshio.Mesh(points, [("wedge", wedges)])
    with ds.from_meshio(mesh) as direct:
        for ending, options in (("vtu", {}), ("vtk", {}), ("xdmf", {"data_format": "XML"}), ("msh", {"file_format": "gmsh"})):
            mesh.write(tmp_path / f"box.{ending}", **options)
            with ds.read(tmp_path / f"box.{ending}") as environment:
                assert content(environment) == content(direct), ending


NETGEN = """# Generated by NETGEN

mesh3d
dimension
3
geomtype
0

# surfnr    domin  domout  tlosurf  bcprop
facedescriptors
1
0 1 0 0 1

surfaceelements
2
 1 2 1 0 3 1 3 2
 1 1 1 0 3 4 5 6

volumeelements
2
1 6 1 3 2 4 6 5
2 4 1 2 3 7

points
7
{nodes}

materials
2
1 lumen
2 tip

bcnames
2
1 outlet
2 inner wall

endmesh
"""


def test_materials_and_boundary_conditions_of_netgen(tmp_path: pathlib.Path) -> None:
    (tmp_path / "two.vol").write_text(NETGEN.format(nodes="\n".join("%g %g %g" % tuple(point) for point in [*PRISM, (0, 0, -1)])))
    with ds.read(tmp_path / "two.vol") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
        assert environment.region_names == {"lumen": 1, "tip": 2} and environment.regions() == [1, 2]
        assert len(environment.faces("outlet")) == len(environment.faces("inner wall")) == 1


def test_points_that_ascend_in_each_cell_say_nothing_of_how_it_is_turned() -> None:
    """So DOLFIN numbers tetrahedra and triangles."""
    points, cells = box()
    ways = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
    rows = np.sort(np.concatenate([cells[:, way] for way in ways]), axis=1)
    with ds.from_meshio(meshio.Mesh(points, [("tetra", rows)])) as environment:
        assert volume_of(environment) == pytest.approx(6) and "cells of type tetra have been turned" in environment.notes[0]
