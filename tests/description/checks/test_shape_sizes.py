"""Units, scales and places of shapes."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.description.checks.pain import FIXTURES, examined, finding, place


def test_mesh_in_millimetres_gets_a_scale() -> None:
    item = finding("pain_20_optical/mesh_in_millimetres.urdf")
    assert item.code == "robot.mesh-unit"
    assert "link 'lid' is 200 m long by its mesh, other links are 0.4 m" in item.message
    assert "the mesh is in millimetres" in item.message
    assert place(item).startswith("<geometry><mesh filename=")
    assert 'write scale="0.001 0.001 0.001" into <mesh>' in item.fix


def test_mesh_that_is_scaled_twice_is_reported() -> None:
    item = finding("pain_20_optical/mesh_scaled_twice.urdf")
    assert item.code == "robot.mesh-unit"
    assert "is 0.2 mm long by its mesh: the file is in metres already" in item.message
    assert item.fix == "remove the mesh's scale"


def test_collision_beside_the_visual_is_reported() -> None:
    item = finding("pain_20_optical/collision_apart.urdf")
    assert item.code == "robot.collision-apart"
    assert "the collision of link 'arm' stands 0.45 m beside what is seen" in item.message
    assert place(item) == "<collision>"


def test_collision_of_another_size_is_reported() -> None:
    found = examined(FIXTURES / "pain_20_optical/broken/collision_ten_times.urdf")
    (item,) = found.by_code("robot.size-mismatch")
    assert "is 10 times larger than what is seen: 3 × 0.5 × 0.5 against" in item.message


@pytest.mark.parametrize(("edge", "is_told"), [("0.002", False), ("0.01", True)])
def test_box_of_a_millimetre_is_there_because_gazebo_wants_one(
    tmp_path: Path, edge: str, is_told: bool
) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="a"><visual><geometry><box size="0.3 0.3 0.3"/></geometry>'
        f'</visual><collision><geometry><box size="{edge} {edge} {edge}"/></geometry></collision>'
        "</link></robot>",
        encoding="utf-8",
    )
    assert bool(examined(path).by_code("robot.size-mismatch")) is is_told


@pytest.mark.parametrize(
    ("visual", "collision", "place_of_it"),
    [
        ('<cylinder radius="0.035" length="0.04"/>', '<cylinder radius="35" length="0.04"/>', "35"),
        ('<cylinder radius="35" length="0.04"/>', '<cylinder radius="0.035" length="0.04"/>', "35"),
        ("", '<cylinder radius="0.02" length="40"/>', "40"),
    ],
)
def test_length_in_millimetres_is_told_at_its_shape(
    tmp_path: Path, visual: str, collision: str, place_of_it: str
) -> None:
    seen = f"<visual><geometry>{visual}</geometry></visual>" if visual else ""
    other = (
        '<link name="b"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
    )
    path = tmp_path / "r.urdf"
    path.write_text(
        f'<robot name="r"><link name="a">{seen}<collision><geometry>{collision}</geometry>'
        f"</collision></link>{other}"
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>',
        encoding="utf-8",
    )
    (item,) = examined(path).by_code("robot.size-unit")
    assert f'="{place_of_it}"' in place(item)
    assert item.message.endswith("it is in millimetres, URDF and SDF take it as metres")
    assert item.fix in {'write radius="0.035"', 'write length="0.04"'}


def test_long_thing_among_long_things_is_in_metres(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    box = '<collision><geometry><box size="40 0.2 3"/></geometry></collision>'
    path.write_text(
        f'<robot name="r"><link name="a">{box}</link><link name="b">{box}</link>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>',
        encoding="utf-8",
    )
    assert not examined(path).by_code("robot.size-unit")
