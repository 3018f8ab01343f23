"""What every solid says of itself holds, and no place forgets a shape."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

import gazelle
from gazelle.description.model import (
    SOLIDS,
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Shape,
    Solid,
    Sphere,
)
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.shapes import read_shape
from gazelle.description.writers.geometry_elements import add_sdf_geometry
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.xml_markup import Markup
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Mesh, mesh_mass_properties

ROOT = Path(gazelle.__file__).parent
NAMES = {kind.__name__ for kind in (*get_args(Shape), *SOLIDS)}


def _usual(kind: type[Solid]) -> Solid:
    return kind.of_lengths(tuple(row.usual for row in kind.lengths()))


@pytest.mark.parametrize(
    ("shape", "volume_m3"),
    [
        (Box((1.0, 2.0, 3.0)), 6.0),
        (Sphere(0.5), math.pi / 6),
        (Cylinder(0.5, 2.0), math.pi / 2),
        (Cone(0.5, 3.0), math.pi / 4),
        (Capsule(0.5, 2.0), math.pi / 2 + math.pi / 6),
        (Ellipsoid((0.5, 1.0, 1.5)), math.pi),
    ],
)
def test_mass_is_density_times_volume(shape: Solid, volume_m3: float) -> None:
    assert shape.body(3.0).mass_kg == pytest.approx(3.0 * volume_m3)


@pytest.mark.parametrize("kind", SOLIDS, ids=lambda kind: kind.word)
def test_the_triangles_of_a_solid_are_as_heavy_as_it(kind: type[Solid]) -> None:
    solid = _usual(kind)
    body, triangles = solid.body(1.0), mesh_mass_properties(Mesh((solid.mesh(),)), density_kg_m3=1)
    assert triangles.mass_kg == pytest.approx(body.mass_kg, rel=0.03)
    assert triangles.center_m == pytest.approx(body.center_m, abs=0.01)
    assert np.allclose(triangles.inertia_kg_m2, body.inertia_kg_m2, rtol=0.05, atol=1e-9)


@pytest.mark.parametrize("kind", SOLIDS, ids=lambda kind: kind.word)
def test_a_solid_that_is_written_as_sdf_is_read_again(kind: type[Solid], tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    context = ReadContext(None, diagnostics, "a.sdf", tmp_path)
    lengths = tuple(
        tuple(0.1 * place for place in (1, 2, 3)) if isinstance(row.usual, tuple) else 0.4
        for row in kind.lengths()
    )
    visual = Markup("visual")
    add_sdf_geometry(visual, kind.of_lengths(lengths), OutputFiles())
    owner = parse_xml(visual.to_text(), "a.sdf", diagnostics)
    assert owner is not None
    assert read_shape(owner.find("geometry"), context, owner=owner) == kind.of_lengths(lengths)
    bare = parse_xml(f"<visual><geometry><{kind.word}/></geometry></visual>", "b", diagnostics)
    assert bare is not None
    assert read_shape(bare.find("geometry"), context, owner=bare) == _usual(kind)
    assert not list(diagnostics)


def test_no_two_solids_have_one_word() -> None:
    assert len({kind.word for kind in SOLIDS}) == len(SOLIDS)


def _named(case: ast.match_case) -> set[str]:
    return {one.cls.id for one in ast.walk(case.pattern)
            if isinstance(one, ast.MatchClass) and isinstance(one.cls, ast.Name)}  # fmt: skip


def _matches() -> Iterator[tuple[str, ast.Match, set[str]]]:
    for file in sorted(ROOT.rglob("*.py")):
        text = file.read_text(encoding="utf-8")
        if "match " in text and ("Solid" in text or "Cylinder" in text):
            for one in ast.walk(ast.parse(text)):
                if isinstance(one, ast.Match):
                    names = set().union(*(_named(case) for case in one.cases))
                    yield f"{file.relative_to(ROOT)}:{one.lineno}", one, names


def test_every_match_on_shapes_lets_mypy_find_a_forgotten_one() -> None:
    found = [(place, one) for place, one, names in _matches() if len(names & NAMES) > 2]
    assert len(found) > 10
    for place, one in found:
        assert ast.unparse(one.cases[-1].body[0]).startswith("assert_never("), place
