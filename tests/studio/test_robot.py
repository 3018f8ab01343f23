"""``robot.get``: descriptions, meshes and textures as the page loads them."""

from __future__ import annotations

import io
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.studio.conftest import Talk
from tests.studio.page import Page, RefusedError
from tests.studio.test_security import get

from gazelle.graph import Graph
from gazelle.studio import Server

_ROBOT = """
<robot name="arm">
  <link name="base">
    <visual><geometry><mesh filename="file://{mesh}" scale="2 2 2"/></geometry></visual>
    <visual><geometry><mesh filename="file://{mesh}.missing"/></geometry></visual>
    <collision><geometry><box size="1 2 3"/></geometry></collision>
    <inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tip"/>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="3" velocity="4"/>
  </joint>
</robot>
"""


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    """A textured triangle."""
    Image.new("RGB", (4, 4), (1, 2, 3)).save(tmp_path / "skin.bmp")
    (tmp_path / "tri.mtl").write_text("newmtl skin\nKd 1 0 0\nmap_Kd skin.bmp\n")
    path = tmp_path / "tri.obj"
    path.write_text(
        "mtllib tri.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
        "f 1/1 2/2 3/3\n"
    )
    return path


def test_a_robot_comes_with_meshes_by_key(
    page: Page, graph: Graph, server: Server, mesh: Path
) -> None:
    graph.parameters.set("/robot_description", _ROBOT.format(mesh=mesh))
    value = page.call("robot.get", tf_prefix="/left")
    assert (value["kind"], value["name"]) == ("robot", "arm")
    base, tip = value["bodies"]
    assert (base["name"], base["frame"], tip["frame"]) == ("base", "left/base", "left/tip")
    assert tip["pose"] == [0, 0, 1, 0, 0, 0, 1]
    assert base["collisions"][0]["geometry"] == {"type": "box", "size": [1, 2, 3]}
    assert base["inertial"]["mass_kg"] == 2.0
    (joint,) = value["joints"]
    assert (joint["name"], joint["parent"], joint["child"]) == ("elbow", 0, 1)
    assert (joint["axis"], joint["lower"], joint["effort"]) == ([0, 1, 0], -1, 3)
    geometry = base["visuals"][0]["geometry"]
    assert geometry["scale"] == [2, 2, 2]
    (part,) = geometry["parts"]
    assert part["material"]["diffuse"][:3] == [1, 0, 0]
    _check_mesh(get(server, f"/mesh/{part['key']}"))
    picture = get(server, f"/texture/{part['material']['texture']}")
    assert picture.headers["Content-Type"] == "image/png"
    assert Image.open(io.BytesIO(picture.body)).getpixel((0, 0)) == (1, 2, 3, 255)


def _check_mesh(answer: Any) -> None:
    assert answer.status == 200
    assert "immutable" in answer.headers["Cache-Control"]
    vertices, corners, flags, zero = struct.unpack_from("<4I", answer.body)
    assert (vertices, corners, flags, zero) == (3, 3, 1, 0)
    floats = np.frombuffer(answer.body, "<f4", 3 * 8, 16)
    places = np.frombuffer(answer.body, "<u4", 3, 16 + 24 * 4)
    assert floats[:9].reshape(3, 3)[places].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert floats[9:18].reshape(3, 3).tolist() == [[0, 0, 1]] * 3
    assert floats[18:].reshape(3, 2)[places].tolist() == [[0, 0], [1, 0], [0, 1]]
    assert len(answer.body) == 16 + 24 * 4 + 12


def test_a_mesh_that_is_missing_says_why(page: Page, graph: Graph, mesh: Path) -> None:
    graph.parameters.set("/robot_description", _ROBOT.format(mesh=mesh))
    value = page.call("robot.get")
    geometry = value["bodies"][0]["visuals"][1]["geometry"]
    assert geometry["type"] == "missing"
    assert geometry["uri"] == f"file://{mesh}.missing"
    assert geometry["reason"] == "the file was not found"
    assert any("missing" in item["text"] for item in value["findings"])


def test_a_robot_of_a_latched_topic(page: Page, talk: Talk, mesh: Path) -> None:
    text = _ROBOT.format(mesh=mesh)
    talk("/left/robot_description", "std_msgs/String", data=text, latch=True)
    for params in (
        {"topic": "/left/robot_description"},
        {"parameter": "/left/robot_description"},
    ):
        assert page.call("robot.get", **params)["name"] == "arm"


def test_descriptions_that_cannot_be_had_are_told(page: Page, graph: Graph) -> None:
    with pytest.raises(RefusedError) as caught:
        page.call("robot.get", parameter="/robot_descriptoin")
    assert str(caught.value) == "there is no parameter or topic '/robot_descriptoin'"
    graph.parameters.set("/broken", "<robot name='x'><link></robot>")
    with pytest.raises(RefusedError, match="the robot description cannot be read") as caught:
        page.call("robot.get", parameter="/broken")
    assert caught.value.error["hint"]
    graph.parameters.set("/number", 3)
    with pytest.raises(RefusedError, match="parameter '/number' is no text but a int"):
        page.call("robot.get", parameter="/number")
    graph.parameters.set("/file", "<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><robot/>")
    with pytest.raises(RefusedError, match="the robot description cannot be read"):
        page.call("robot.get", parameter="/file")
