from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from gazelle.description.checks.shape_volumes import shape_body, shape_points_m
from gazelle.description.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    MeshShape,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import box_mesh

PI = math.pi
SQUARE = (((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)),)
SHAPES = [
    (Box((1, 2, 3)), 6, (1, 2, 3)),
    (Sphere(1), 4 / 3 * PI, (2, 2, 2)),
    (Cylinder(1, 3), 3 * PI, (2, 2, 3)),
    (Cone(1, 3), PI, (2, 2, 3)),
    (Capsule(1, 3), 3 * PI + 4 / 3 * PI, (2, 2, 5)),
    (Ellipsoid((1, 2, 3)), 8 * PI, (2, 4, 6)),
    (Polyline(SQUARE, 2), 2, (1, 1, 2)),
]


@pytest.mark.parametrize(("shape", "volume", "extent"), SHAPES)
def test_volume_and_extent(shape, volume: float, extent) -> None:
    diagnostics = Diagnostics()
    body = shape_body(shape, 10.0, diagnostics)
    assert body is not None
    assert body.mass_kg == pytest.approx(10 * volume)
    assert np.ptp(shape_points_m(shape, diagnostics), axis=0) == pytest.approx(extent)


def test_planes_and_flat_boxes_have_no_volume() -> None:
    diagnostics = Diagnostics()
    assert shape_body(Plane(), 1.0, diagnostics) is None
    assert shape_body(Box((1, 1, 0)), 1.0, diagnostics) is None
    assert shape_points_m(Plane(), diagnostics).shape == (0, 3)


def test_mesh_is_scaled_and_a_broken_one_reported(stl, tmp_path: Path) -> None:
    part = box_mesh((1, 2, 3))
    file = stl("box.stl", part.vertices_m[part.faces])
    diagnostics = Diagnostics()
    body = shape_body(MeshShape("box.stl", file, (0.1, 0.1, 0.1)), 1000.0, diagnostics)
    assert body is not None
    assert body.mass_kg == pytest.approx(6.0)
    (tmp_path / "empty.stl").write_bytes(b"")
    broken = MeshShape("empty.stl", tmp_path / "empty.stl")
    assert shape_body(broken, 1.0, diagnostics) is None
    assert [item.code for item in diagnostics] == ["mesh.unreadable"]
