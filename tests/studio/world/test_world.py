"""Methods and streams of the world, over a graph."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.simulator.world_server import WorldServer
from gazelle.studio.world.insert import primitive_sdf
from gazelle.studio.world.models import thumbnail

_BOX = {"source": {"primitive": "box", "size": [1.0, 2.0, 3.0]}}


def _poses(frame: Any) -> np.ndarray:
    kind, count, _, payload = frame
    assert kind == 1
    return np.frombuffer(payload, "<f4").reshape(count, 7)


def test_inserted_primitive_appears_in_the_scene_and_falls_when_played(
    server: WorldServer, page: Any
) -> None:
    scene, poses = page.open("world.scene"), page.open("world.poses")
    assert page.call("world.insert", **_BOX, pose=[1.0, 2.0, 5.0]) == {"name": "unit_box"}
    value = page.wait(scene, lambda value: value and len(value["models"]) == 2)
    body = value["bodies"][-1]
    assert body["visuals"][0]["geometry"] == {"type": "box", "size": [1.0, 2.0, 3.0]}
    assert body["inertial"]["mass_kg"] == 1.0
    assert body["inertial"]["diagonal"] == pytest.approx([13 / 12, 10 / 12, 5 / 12])
    start = page.wait(poses, lambda frame: frame[1] == len(value["bodies"]))
    assert _poses(start)[-1][:3].tolist() == [1.0, 2.0, 5.0]
    page.call("world.play")
    page.wait(poses, lambda frame: _poses(frame)[-1][2] < 4.5)
    page.call("world.pause")
    assert server.paused


def test_second_model_of_a_name_gets_a_number(server: WorldServer, page: Any) -> None:
    names = [page.call("world.insert", **_BOX)["name"] for _ in range(3)]
    assert names == ["unit_box", "unit_box_0", "unit_box_1"]
    page.call("world.delete", model="unit_box_0")
    assert [model.name for model in server.engine.world.models] == [
        "ground_plane", "unit_box", "unit_box_1",
    ]  # fmt: skip


def test_steps_are_taken_while_paused_and_reset_goes_back(server: WorldServer, page: Any) -> None:
    stats = page.open("world.stats")
    page.call("world.step", count=25)
    seen = page.wait(stats, lambda stats: stats["iterations"] == 25)
    assert seen["paused"] is True and seen["sim_s"] == pytest.approx(0.025)
    page.call("world.reset", what="time")
    page.wait(stats, lambda stats: stats["iterations"] == 0)
    page.call("world.factor", wanted_rtf=2.0)
    page.wait(stats, lambda stats: stats["wanted_rtf"] == 2.0)


def test_force_moves_the_wheel_of_a_dropped_model(server: WorldServer, page: Any) -> None:
    text = """<sdf version="1.6"><model name="cart"><static>false</static>
      <link name="body"><pose>0 0 1 0 0 0</pose><inertial><mass>50</mass></inertial></link>
      <link name="wheel"><pose>0 0 1 0 0 0</pose></link>
      <joint name="hinge" type="revolute"><parent>body</parent><child>wheel</child>
        <axis><xyz>0 1 0</xyz></axis></joint></model></sdf>"""
    assert page.call("world.insert", source={"text": text}) == {"name": "cart"}
    page.wait(page.open("world.scene"), lambda value: value and len(value["models"]) == 2)
    joints = page.open("world.joints", model="cart")
    page.call("world.joint", model="cart", joint="hinge", force=0.1)
    page.call("world.step", count=100)
    row = page.wait(joints, lambda rows: rows and rows[0]["velocity"] > 0.005)[0]
    assert (row["name"], row["type"], row["lower"]) == ("hinge", "revolute", None)
    assert row["effort"] == pytest.approx(0.1)


def test_wrench_and_pose_move_a_model(server: WorldServer, page: Any) -> None:
    page.call("world.insert", **_BOX, pose=[0.0, 0.0, 9.0])
    page.call("world.wrench", body="unit_box::link", force=[10.0, 0.0, 0.0], seconds=0.1)
    page.call("world.step", count=200)
    linear, _ = server.engine.model_velocity("unit_box")
    assert linear[0] == pytest.approx(1.0, rel=0.02)
    page.call("world.set_pose", model="unit_box", pose=[4.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0])
    rows = page.call("world.properties", model="unit_box")
    assert {row["name"]: row["value"] for row in rows}["x"] == 4.0
    page.call("world.set_property", model="unit_box", link="link", name="mass", value=7.0)
    assert server.engine.link("unit_box::link").mass_kg == 7.0


@pytest.mark.parametrize(
    ("method", "params", "words"),
    [
        ("world.set_pose", {"pose": [1e300, 0, 0, 0, 0, 0, 1]}, "field 'pose[0]' is 1e+300"),
        ("world.set_pose", {"pose": [0, 1e6, 0]}, "field 'pose[1]' is 1e+06, beyond the ±100000"),
        ("world.set_pose", {"pose": [10**400, 0, 0]}, "'pose' is a list of numbers, not [1000"),
        ("world.set_pose", {"link": "link", "pose": [0, 0, 1e300]}, "pose.position.z' is 1e+300"),
        ("world.insert", {**_BOX, "pose": [1e300, 0, 0]}, "initial_pose.position.x' is 1e+300"),
        ("world.insert", {"source": {"primitive": "sphere", "size": [1e300]}}, "a sphere's sizes"),
        ("world.wrench", {"body": "unit_box::link", "force": [1e300, 0, 0]}, "wrench.force.x'"),
        ("world.factor", {"wanted_rtf": 1e300}, "wanted_rtf"),
        ("world.set_property", {"link": "link", "name": "mass", "value": 1e300}, "field 'mass' is"),
    ],
)
def test_number_that_nothing_has_is_refused_and_the_world_goes_on(
    server: WorldServer, page: Any, method: str, params: dict[str, Any], words: str
) -> None:
    page.call("world.insert", **_BOX, pose=[0.0, 0.0, 1.5])
    before = server.engine.state_hash()
    model = {} if method in ("world.insert", "world.factor") else {"model": "unit_box"}
    with pytest.raises(AssertionError) as refused:
        page.call(method, **model, **params)
    assert words in json.loads(str(refused.value))["message"]
    assert server.engine.state_hash() == before
    page.call("world.step", count=10)


# A body on a fork and a wheel of a few grams, as castors are.
_CASTOR = """<robot name="castor">
  <link name="body"><inertial><mass value="2"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>
    <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision></link>
  <link name="fork"><inertial><mass value="0.02"/>
    <inertia ixx="2e-6" ixy="0" ixz="0" iyy="2e-6" iyz="0" izz="2e-6"/></inertial></link>
  <link name="wheel"><inertial><mass value="0.02"/>
    <inertia ixx="2e-6" ixy="0" ixz="0" iyy="2e-6" iyz="0" izz="2e-6"/></inertial></link>
  <joint name="turn" type="continuous"><parent link="body"/><child link="fork"/>
    <origin xyz="0.1 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="roll" type="continuous"><parent link="fork"/><child link="wheel"/>
    <origin xyz="0.02 0 -0.02"/><axis xyz="0 1 0"/></joint>
</robot>"""


def test_light_castors_that_a_person_pushes_without_end_stay_with_their_robot(
    server: WorldServer, page: Any
) -> None:
    page.call("world.insert", source={"text": _CASTOR}, pose=[0.0, 0.0, 0.05])
    for joint in ("turn", "roll"):
        page.call("world.joint", model="castor", joint=joint, force=0.5)
    page.call("world.step", count=3000)
    place = server.engine.model_pose("castor").position_m
    # A wheel beside its axle shakes the body along, some decimetres a second.
    assert math.dist(place, (0.0, 0.0, 0.05)) < 3.0 and place[2] < 0.5
    for joint in ("turn", "roll"):
        assert abs(server.engine.joint(f"castor::{joint}").velocity) < 5000.0


def test_contacts_are_frames_of_points(server: WorldServer, page: Any) -> None:
    page.call("world.insert", **_BOX, pose=[0.0, 0.0, 1.5])
    page.call("world.step", count=200)
    kind, count, _, payload = page.wait(page.open("world.contacts"), lambda frame: frame[1] >= 4)
    points = np.frombuffer(payload, "<f4").reshape(count, 7)
    assert kind == 3 and np.abs(points[:, 2]).max() < 0.01


def test_no_world_is_said_with_what_to_do(page: Any) -> None:
    assert page.wait(page.open("world.scene"), lambda value: value is None) is None
    with pytest.raises(AssertionError, match="no world is running on this graph"):
        page.call("world.play")


def test_scene_is_null_when_the_world_has_gone(server: WorldServer, page: Any) -> None:
    scene = page.open("world.scene")
    page.wait(scene, lambda value: value is not None)
    server.close()
    assert page.wait(scene, lambda value: value is None) is None


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ({"model": "no_such_thing"}, "there is no model 'no_such_thing' in the model paths"),
        ({"primitive": "bax"}, "there is no primitive 'bax'"),
        ({"primitive": "box", "size": [1, 1]}, "a box has 3 sizes above 0"),
        ({"text": "<robot name='x'"}, "dropped file"),
        ({"text": "<launch/>"}, "the file's <launch> holds no model"),
    ],
)
def test_bad_insert_is_told(server: WorldServer, page: Any, source: Any, words: str) -> None:
    with pytest.raises(AssertionError, match=words.split("'", maxsplit=1)[0]):
        page.call("world.insert", source=source)


def test_findings_in_a_dropped_file_name_the_file(server: WorldServer, page: Any) -> None:
    text = "<sdf version='1.6'>\n  <model name='ghost'/>\n</sdf>"
    with pytest.raises(AssertionError, match=r"ghost\.sdf:2:3: model 'ghost' has no link"):
        page.call("world.insert", source={"text": text, "file": "ghost.sdf"})


def test_models_of_the_paths_have_pictures(
    page: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "crate"
    folder.mkdir()
    (folder / "model.config").write_text(
        "<model><name>A crate</name><sdf version='1.6'>model.sdf</sdf>"
        "<description>Of   wood.</description></model>"
    )
    (folder / "model.sdf").write_text(primitive_sdf("box", [1.0, 1.0, 1.0]))
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path))
    crate = next(one for one in page.call("world.models") if one["name"] == "crate")
    assert (crate["title"], crate["description"]) == ("A crate", "Of wood.")
    picture = thumbnail(page.studio, "crate")
    assert picture is not None and picture.body.startswith(b"\x89PNG")
    assert thumbnail(page.studio, "../crate") is None
