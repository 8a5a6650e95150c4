"""XDMF files of several times or grids, which meshio refuses: VTK reads them."""

from __future__ import annotations

import os
import pathlib

import numpy as np
import pytest

import dartsweep as ds
from volumes import PRISM, TETRA, volume_of

meshio = pytest.importorskip("meshio")
pytest.importorskip("vtkmodules")


def _grid(name: str, points: str, corners: str) -> str:
    topology = f'<Topology TopologyType="Tetrahedron" NumberOfElements="1"><DataItem Dimensions="1 4" NumberType="Int">{corners}</DataItem></Topology>'
    geometry = f'<Geometry GeometryType="XYZ"><DataItem Dimensions="4 3" NumberType="Float" Precision="8">{points}</DataItem></Geometry>'
    return f'<Grid Name="{name}" GridType="Uniform">{topology}{geometry}<Time Value="{len(name)}"/></Grid>'


def _collection(kind: str, grids: list[str]) -> str:
    return f'<Xdmf Version="3.0"><Domain><Grid GridType="Collection" CollectionType="{kind}" Name="all">{"".join(grids)}</Grid></Domain></Xdmf>'


def test_the_mesh_of_a_series_of_times(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # meshio writes the .h5 beside
    with meshio.xdmf.TimeSeriesWriter("series.xdmf") as series:
        series.write_points_cells(PRISM, [("wedge", np.arange(6)[None])])
        for time in (0.0, 1.0):
            series.write_data(time, cell_data={"heat": [np.array([time])]})
    assert os.path.exists("series.h5")
    with ds.read("series.xdmf") as made:
        assert made.info.volume_count == 1 and made.info.part_count == 1 and volume_of(made) == pytest.approx(0.5)
        assert made.region_names == {} and any("VTK read it" in note for note in made.notes) and not any("inside out" in note for note in made.notes)


def test_of_several_times_the_first_is_taken(tmp_path: pathlib.Path) -> None:
    texts = [" ".join(str(x) for x in np.ravel(scale * TETRA)) for scale in (1, 2)]
    path = tmp_path / "times.xdmf"
    path.write_text(_collection("Temporal", [_grid("a", texts[0], "0 1 2 3"), _grid("bb", texts[1], "0 1 2 3")]))
    with ds.read(path) as made:
        assert made.info.volume_count == 1 and volume_of(made) == pytest.approx(1 / 6)


def test_grids_that_lie_side_by_side_are_all_kept(tmp_path: pathlib.Path) -> None:
    texts = [" ".join(str(x) for x in np.ravel(TETRA + shift)) for shift in (0, 5)]
    path = tmp_path / "places.xdmf"
    path.write_text(_collection("Spatial", [_grid("one", texts[0], "0 1 2 3"), _grid("two", texts[1], "0 1 2 3")]))
    with ds.read(path) as made:
        assert made.info.volume_count == 2 and volume_of(made) == pytest.approx(1 / 3)
        assert sorted(made.region_names) == ["one", "two"]


@pytest.mark.parametrize(("said", "rows"), [('BaseOffset="1"', "1 2 4 3 5 6 8 7"), ('Order="0 1 3 2 4 5 7 6"', "0 1 2 3 4 5 6 7"), ('BaseOffset="0"', "0 1 3 2 4 5 7 6")])
def test_numbers_of_points_that_meshio_would_take_as_they_stand(said: str, rows: str, tmp_path: pathlib.Path) -> None:
    """A cube whose points go line by line; one more point would be taken for one of its corners."""
    points = " ".join(f"{x} {y} {z}" for z in (0, 1) for y in (0, 1) for x in (0, 1)) + " 9 9 9"
    grid = f'<Topology TopologyType="Hexahedron" NumberOfElements="1" {said}><DataItem Dimensions="1 8" NumberType="Int" Format="XML">{rows}</DataItem></Topology>'
    place = f'<Geometry GeometryType="XYZ"><DataItem Dimensions="9 3" Format="XML">{points}</DataItem></Geometry>'
    (tmp_path / "cube.xdmf").write_text(f'<Xdmf Version="3.0"><Domain><Grid GridType="Uniform">{grid}{place}</Grid></Domain></Xdmf>')
    with ds.read(tmp_path / "cube.xdmf") as environment:
        assert volume_of(environment) == pytest.approx(1)
