"""What viewers hear of a world and what they may do to it."""

from __future__ import annotations

import json
import math
import threading
from collections.abc import Callable
from typing import Any

import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis import given

from gazelle.geometry import Pose
from gazelle.interfaces import service_type
from gazelle.simulator import Simulation
from gazelle.simulator.gui import offer_views

_TENSOR = '<inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/>'
_ARM = f"""<robot name="arm">
  <link name="base"><inertial><mass value="5"/>{_TENSOR}</inertial>
    <collision name="foot"><geometry><box size=".2 .2 .2"/></geometry></collision></link>
  <link name="tip"><inertial><mass value="1"/>{_TENSOR}</inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="10" velocity="5"/></joint>
</robot>"""
_WAIT_S = 30.0


class _Viewer:
    """A world with an arm in it, seen as a viewer sees it."""

    def __init__(self) -> None:
        self.sim = Simulation.load(_ARM, pose=Pose((0.0, 0.0, 0.1)))
        self.server = self.sim.server
        offer_views(self.server)

    def next(self, topic: str, wanted: Callable[[Any], bool] = lambda _: True) -> Any:
        """Return the first message of a topic that is as wanted."""
        got: list[Any] = []
        arrived = threading.Event()

        def take(message: Any) -> None:
            if wanted(message) and not got:
                got.append(message)
                arrived.set()

        listening = self.server.node.create_subscription(f"/_gazelle/{topic}", None, take)
        assert arrived.wait(_WAIT_S), topic
        listening.unregister()
        return got[0]

    def json(self, topic: str, wanted: Callable[[Any], bool] = lambda _: True) -> Any:
        return json.loads(self.next(topic, lambda message: wanted(json.loads(message.data))).data)

    def do(self, **request: Any) -> Any:
        """Send a request; returns its value, or the words of its error."""
        answer = self.answer(json.dumps(request))
        return answer["value"] if "value" in answer else answer["error"]["message"]

    def answer(self, text: str) -> Any:
        """Send any text as a request; returns the whole answer."""
        call = self.sim.server.node.call  # type: ignore[attr-defined]
        kind = service_type("gazelle_msgs/Do")
        return json.loads(call("/_gazelle/do", kind.Request(request=text)).response)

    def row(self, name: str, group: str = "", **of: str) -> Any:
        rows = self.do(op="properties", **of)
        return next(r["value"] for r in rows if r["name"] == name and group in ("", r["group"]))


@pytest.fixture
def viewer() -> Any:
    viewer = _Viewer()
    yield viewer
    viewer.server.close()


@pytest.fixture(scope="module")
def lasting_viewer() -> Any:
    """One for all that hypothesis tries: a new one costs more than many requests."""
    viewer = _Viewer()
    yield viewer
    viewer.server.close()


def test_scene_tells_bodies_in_the_order_of_poses(viewer: _Viewer) -> None:
    scene, poses = viewer.json("scene"), viewer.next("poses")
    names = [body["name"] for body in scene["bodies"]]
    assert names[-2:] == ["arm::base", "arm::tip"]
    assert scene["moving"] == ["arm::turn"]
    rows = poses.values.reshape(-1, poses.width)
    assert (poses.width, len(rows), poses.version) == (7, len(names), scene["version"])
    assert rows[-2][:3].tolist() == pytest.approx([0.0, 0.0, 0.1])


def test_scene_follows_what_is_deleted(viewer: _Viewer) -> None:
    first = viewer.json("scene")
    viewer.server.delete("arm")
    after = viewer.json("scene", lambda scene: scene["version"] > first["version"])
    assert [model["name"] for model in after["models"]] == ["ground_plane"]


def test_poses_move_with_the_world_also_when_a_person_drags(viewer: _Viewer) -> None:
    viewer.do(op="set_pose", model="arm", pose=[3, 0, 1, 0, 0, 0, 2])
    moved = viewer.next("poses", lambda message: message.values.reshape(-1, 7)[-2][0] == 3.0)
    assert moved.values.reshape(-1, 7)[-2].tolist() == [3, 0, 1, 0, 0, 0, 1]
    assert "7 numbers" in viewer.do(op="set_pose", model="arm", pose=[1, 2, 3])


def test_contacts_are_points_normals_and_depths(viewer: _Viewer) -> None:
    viewer.sim.run(seconds=0.5)
    rows = viewer.next("contacts").values.reshape(-1, 7)
    assert len(rows) >= 4
    assert np.abs(rows[:, 2]).max() < 2e-3 and np.allclose(np.abs(rows[:, 5]), 1.0)


def test_statistics_tell_time_and_step(viewer: _Viewer) -> None:
    viewer.server.step(250)
    stats = viewer.json("stats")
    assert stats["sim_s"] == pytest.approx(0.25)
    assert (stats["step_s"], stats["iterations"], stats["paused"]) == (0.001, 250, False)


def test_force_position_and_velocity_move_a_joint_until_it_is_freed(viewer: _Viewer) -> None:
    joint = viewer.sim.joint("turn")
    viewer.do(op="joint", model="arm", joint="turn", force=0.1)
    viewer.server.step(100)
    # The tip's 0.1 kg·m² against the base's, which turns the other way a little or not at all.
    assert joint.velocity >= 0.099
    viewer.do(op="joint", model="arm", joint="turn", position=1.0, p=20.0, i=0.0, d=4.0)
    viewer.server.step(4000)
    assert joint.position == pytest.approx(1.0, abs=0.01)
    row = viewer.next("joints").values.reshape(-1, 3)[0]
    assert row[0] == pytest.approx(joint.position, abs=1e-6)
    viewer.do(op="joint", model="arm", joint="turn", velocity=-0.5, p=5.0, i=0.0, d=0.0)
    viewer.server.step(1000)
    assert joint.velocity == pytest.approx(-0.5, abs=0.02)
    viewer.do(op="joint", model="arm", joint="turn")
    assert joint.effort == 0.0


def test_controlled_joint_of_a_deleted_model_stops_no_world(viewer: _Viewer) -> None:
    viewer.do(op="joint", model="arm", joint="turn", position=1.0)
    viewer.server.delete("arm")
    viewer.server.step(10)
    assert viewer.server.time_ns == 10_000_000


def test_properties_change_and_state_stays(viewer: _Viewer) -> None:
    viewer.server.engine.joint("arm::turn").set_state(position=0.5)
    viewer.do(op="set_property", model="arm", link="tip", name="mass", value=3.0)
    assert viewer.row("mass", model="arm", link="tip") == 3.0
    assert viewer.sim.joint("turn").position == pytest.approx(0.5)
    viewer.do(op="set_property", model="arm", link="base", name="collision/foot/mu1", value=0.2)
    assert viewer.row("mu1", model="arm", link="base") == 0.2
    viewer.do(op="set_property", model="arm", joint="turn", name="upper", value=None)
    assert viewer.row("upper", "axis", model="arm", joint="turn") is None
    assert viewer.do(op="set_property", model="arm", name="static", value=True) == {}
    assert viewer.row("static", model="arm") is True


def test_light_changes_are_seen_in_the_scene(viewer: _Viewer) -> None:
    first = viewer.json("scene")
    viewer.do(op="light", name="sun", diffuse=[1, 0, 0, 1], direction=[0, 0, -1])
    seen = viewer.json("scene", lambda scene: scene["lights"] != first["lights"])
    assert seen["lights"][0]["diffuse"] == [1, 0, 0, 1]


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        ({"op": "jont"}, "unknown request 'jont'; did you mean 'joint'"),
        ({"op": "properties", "model": "arn"}, "did you mean 'arm'"),
        ({"op": "joint", "model": "arm", "joint": "trun", "force": 1}, "did you mean"),
        ({"op": "set_property", "model": "arm", "link": "tip", "name": "mas", "value": 1},
         "no editable property 'mas'; did you mean 'mass'"),
        ({"op": "set_property", "model": "arm", "link": "tip", "name": "mass", "value": -1},
         "field 'mass' is -1; it has to be above 0"),
        ({"op": "light", "name": "moon", "diffuse": [1, 1, 1, 1]}, "moon"),
        ({"op": "factor", "wanted_rtf": 2}, "lock-step"),
        ({"op": "set_pose", "model": "arm"}, "field 'pose' is missing"),
        ({"op": ["joint"]}, "field 'op' is a text, not a list"),
        ({"op": "factor", "wanted_rtf": "2"}, "field 'wanted_rtf' is a number, not \"2\""),
        ({"op": "light", "name": "sun", "direction": [0, 0]}, "'direction' has 3 numbers, not 2"),
        ({"op": "light", "name": "sun", "direction": [0, 0, 0]}, "'direction' is of no length"),
        ({"op": "light", "name": "sun", "cast_shadows": "no"},
         "field 'cast_shadows' is true or false, not \"no\""),
        ({"op": "set_property", "model": "arm", "name": "static", "value": 1},
         "field 'static' is true or false, not 1"),
        ({"op": "set_property", "model": "arm", "joint": "turn", "name": "damping"},
         "field 'damping' is a number, not null"),
    ],
)  # fmt: skip
def test_bad_requests_are_answered_with_words(
    viewer: _Viewer, request_: dict[str, Any], words: str
) -> None:
    assert words in viewer.do(**request_)


_BAD = [math.nan, math.inf, -math.inf, 1e300, pytest.param(10**400, id="10**400")]
_ARM_JOINT = {"op": "joint", "model": "arm", "joint": "turn"}
_ARM_TIP = {"op": "set_property", "model": "arm", "link": "tip"}


@pytest.mark.parametrize("value", _BAD)
@pytest.mark.parametrize(
    ("request_", "field"),
    [
        *(({"op": "set_pose", "model": "arm", "pose": 1}, f"pose[{place}]")
          for place in (0, 2, 6)),
        *((_ARM_JOINT, field) for field in ("force", "position", "velocity")),
        *(({**_ARM_JOINT, "position": 1.0}, field) for field in "pid"),
        *(({**_ARM_TIP, "name": name}, name) for name in ("mass", "ixy")),
        ({**_ARM_TIP, "link": "base", "name": "collision/foot/mu1"}, "mu1"),
        ({"op": "set_property", "model": "arm", "joint": "turn", "name": "damping"}, "damping"),
        ({"op": "light", "name": "sun", "pose": 1}, "pose[1]"),
        ({"op": "light", "name": "sun", "direction": 1}, "direction[1]"),
        ({"op": "light", "name": "sun", "diffuse": 1}, "diffuse[1]"),
        ({"op": "light", "name": "sun"}, "range_m"),
        ({"op": "factor"}, "wanted_rtf"),
    ],
)  # fmt: skip
def test_request_with_a_number_that_cannot_be_changes_nothing(
    viewer: _Viewer, request_: dict[str, Any], field: str, value: float
) -> None:
    """The limits are those of topics and services."""
    name, is_listed, place = field.partition("[")
    if is_listed:
        numbers = {"pose": [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], "direction": [0.0, 0.0, -1.0]}
        values = [*numbers.get(name, [1.0, 1.0, 1.0])]
        values[int(place[:-1])] = value
        filled = {**request_, name: values}
    else:
        filled = {**request_, ("value" if request_["op"] == "set_property" else name): value}
    engine, lights = viewer.server.engine, viewer.server.sensors.lights
    before = engine.state_hash()
    assert f"field '{field}' is " in viewer.do(**filled)
    assert engine.state_hash() == before
    assert viewer.server.sensors.lights == lights
    viewer.server.step(10)


@pytest.mark.parametrize(
    ("request_", "limit"),
    [
        ({"op": "set_pose", "model": "arm", "pose": [0, -1e6, 1, 0, 0, 0, 1]}, "±100000"),
        ({**_ARM_JOINT, "force": 2e7}, "±1e+07"),
        ({**_ARM_JOINT, "position": 2e6}, "±1e+06"),
        ({**_ARM_JOINT, "velocity": 1e6}, "±10000"),
        ({**_ARM_TIP, "name": "mass", "value": 2e9}, "±1e+09"),
    ],
)
def test_limits_of_requests_are_those_of_what_a_number_means(
    viewer: _Viewer, request_: dict[str, Any], limit: str
) -> None:
    assert f"beyond the {limit}, which nothing in a world can have" in viewer.do(**request_)


def test_million_newtons_on_a_joint_are_taken_and_the_world_goes_on(viewer: _Viewer) -> None:
    """It is within what machines have; the joint's own limit of 10 N·m holds."""
    assert viewer.do(**_ARM_JOINT, force=1e6) == {}
    viewer.server.step(1000)
    assert viewer.sim.joint("turn").effort == 10.0


def test_property_that_no_world_can_be_built_with_leaves_the_model_as_it_was(
    viewer: _Viewer,
) -> None:
    viewer.do(**_ARM_JOINT, force=0.1)
    viewer.server.step(10)
    engine = viewer.server.engine
    before = engine.state_hash()
    assert "MuJoCo cannot build the world" in viewer.do(**_ARM_TIP, name="mass", value=1e-300)
    assert engine.state_hash() == before
    assert viewer.row("mass", model="arm", link="tip") == 1.0
    viewer.server.step(10)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "this is no request, nor JSON"),
        ("[]", "a request is a JSON object, not a list"),
        ("null", "a request is a JSON object, not null"),
        ('"joint"', 'a request is a JSON object, not "joint"'),
        ("[" * 100_000, "nested too deeply"),
        ('{"op": "factor", "wanted_rtf": 1' + "0" * 400 + "}", "is a number of 401 digits"),
        ('{"op": "factor", "wanted_rtf": 1' + "0" * 5000 + "}", "this is no request, nor JSON"),
        ('{"op": "factor", "wanted_rtf": 1e999}', "field 'wanted_rtf' is inf"),
    ],
)
def test_text_that_is_no_request_is_answered_with_words(
    viewer: _Viewer, text: str, words: str
) -> None:
    assert words in viewer.answer(text)["error"]["message"]


_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8)
    | st.sampled_from([10**400, -(10**400), 1e300, "arm", "turn", "tip", "sun", "mass"]),
    lambda inner: st.lists(inner, max_size=7) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=8,
)  # fmt: skip
_OPS = ["factor", "joint", "light", "properties", "set_pose", "set_property"]
_NAMES = {"model": "arm", "joint": "turn", "link": "tip", "name": "sun"}
_REQUESTS = st.fixed_dictionaries(
    {"op": st.sampled_from(_OPS)},
    optional={
        **{key: st.just(name) | _JSON for key, name in _NAMES.items()},
        "pose": st.lists(_JSON, min_size=7, max_size=7) | _JSON,
        **dict.fromkeys(("force", "velocity", "position", "p", "value", "wanted_rtf"), _JSON),
        **dict.fromkeys(("direction", "diffuse", "range_m", "cast_shadows"), _JSON),
    },
)


@given(value=_JSON | _REQUESTS)
def test_every_json_value_has_an_answer_and_the_world_goes_on(
    lasting_viewer: _Viewer, value: Any
) -> None:
    viewer = lasting_viewer
    answer = viewer.answer(json.dumps(value))
    assert set(answer) <= {"value", "error"}
    assert "error" not in answer or answer["error"]["message"]
    viewer.server.step(1)
