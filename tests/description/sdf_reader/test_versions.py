""""""

from __future__ import annotations

import pytest

from gazelle.description.loader import load_world
from gazelle.description.model import Box
from gazelle.description.sdf_reader.versions import version_from, version_of
from gazelle.diagnostics import Diagnostics

OLDEST = """<gazebo version="1.0">
<world name="w">
  <physics type="ode" update_rate="500"><gravity xyz="0 0 -5"/></physics>
  <model name="m" static="true">
    <origin pose="1 2 3 0 0 0"/>
    <link name="l">
      <collision name="c">
        <origin pose="0 0 1 0 0 0"/>
        <geometry><box size="1 2 3"/></geometry>
      </collision>
    </link>
  </model>
</world>
</gazebo>"""


def _world(text: str):
    diagnostics = Diagnostics()
    return load_world(text, workspace=None, diagnostics=diagnostics), diagnostics


def test_a_world_of_sdf_1_0_keeps_its_attributes() -> None:
    world, diagnostics = _world(OLDEST)
    (model,) = world.models
    assert model.static
    assert model.T_world_model.position_m == (1.0, 2.0, 3.0)
    (collision,) = model.links[0].collisions
    assert collision.shape == Box((1.0, 2.0, 3.0))
    assert collision.T_link_collision.position_m == (0.0, 0.0, 1.0)
    assert world.gravity_m_s2 == (0.0, 0.0, -5.0)
    (found,) = diagnostics
    assert found.code == "sdf.version"
    assert "SDF 1.0 is older than 1.4; it is read as sdformat brings it to 1.4" in found.message


@pytest.mark.parametrize("root", ["gazebo version='1.2'", "sdf version='1.3'", "sdf version='1.2'"])
def test_both_roots_are_known_and_told_once(root: str) -> None:
    world, diagnostics = _world(
        f"<{root}><world name='w'><model name='m'><link name='l'/></model></world>"
        f"</{root.split(maxsplit=1)[0]}>"
    )
    assert [model.name for model in world.models] == ["m"]
    assert [item.code for item in diagnostics] == ["sdf.version"]


def test_findings_keep_the_line_they_are_about() -> None:
    _, diagnostics = _world(OLDEST.replace('size="1 2 3"', 'size="1 x 3"'))
    (found,) = diagnostics.by_code("xml.bad-number")
    assert found.span is not None
    assert found.span.line == 9


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1.4", (1, 4)), (" 1.10", (1, 10)), ("two", None), (None, None), ("", None)],
)
def test_texts(text, expected):
    assert version_from(text) == expected


@pytest.mark.parametrize(
    ("attribute", "version", "words"),
    [
        ("", (1, 6), "there is no version"),
        ("version='new'", (1, 6), "'new' is no version"),
        ("version='1.2'", (1, 4), "older than 1.4"),
        ("version='1.13'", (1, 13), "newer than 1.12"),
    ],
)
def test_odd_versions_are_told_of(tag, context, diagnostics, attribute, version, words):
    assert version_of(tag(f"<sdf {attribute}/>"), context) == version
    assert words in diagnostics.by_code("sdf.version")[0].message


@pytest.mark.parametrize("minor", range(4, 13))
def test_known_versions_are_not_mentioned(tag, context, diagnostics, minor):
    assert version_of(tag(f"<sdf version='1.{minor}'/>"), context) == (1, minor)
    assert not len(diagnostics)
