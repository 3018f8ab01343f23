"""Mass properties of shapes by numbers, and that no place forgets a shape."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest

import gazelle
from gazelle.description.model import Box, Capsule, Cone, Cylinder, Ellipsoid, Shape, Sphere
from gazelle.description.solids import Solid, solid_body

ROOT = Path(gazelle.__file__).parent
NAMES = {kind.__name__ for kind in get_args(Shape)}


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
    assert solid_body(shape, 3.0).mass_kg == pytest.approx(3.0 * volume_m3)


def _named(case: ast.match_case) -> set[str]:
    return {one.cls.id for one in ast.walk(case.pattern)
            if isinstance(one, ast.MatchClass) and isinstance(one.cls, ast.Name)}  # fmt: skip


def _matches() -> Iterator[tuple[str, ast.Match, set[str]]]:
    for file in sorted(ROOT.rglob("*.py")):
        text = file.read_text(encoding="utf-8")
        if "match " in text and "Cylinder" in text:
            for one in ast.walk(ast.parse(text)):
                if isinstance(one, ast.Match):
                    names = set().union(*(_named(case) for case in one.cases))
                    yield f"{file.relative_to(ROOT)}:{one.lineno}", one, names


def test_every_match_on_shapes_lets_mypy_find_a_forgotten_one() -> None:
    found = [(place, one) for place, one, names in _matches() if len(names & NAMES) > 2]
    assert len(found) > 10
    for place, one in found:
        assert ast.unparse(one.cases[-1].body[0]).startswith("assert_never("), place
