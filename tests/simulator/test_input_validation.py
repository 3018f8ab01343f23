"""Numbers from outside: those that cannot be have no effect, and their senders hear why."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.errors import EngineError
from gazelle.geometry import Pose
from gazelle.graph.errors import ServiceRefusedError
from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Mode, Simulation
from gazelle.simulator.input_validation import Inputs, problem_of, refusal

BOX = """<sdf version="1.6"><model name="box"><link name="link">
  <inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
</link></model></sdf>"""
WHEEL = """<robot name="wheel"><link name="world"/>
  <joint name="spin" type="continuous"><parent link="world"/><child link="rim"/>
    <axis xyz="0 0 1"/></joint>
  <link name="rim"><inertial><mass value="1"/>
    <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link></robot>"""
BAD = [math.nan, math.inf, -math.inf, 1e300]


def _filled(message: Any, path: str, value: float) -> Any:
    *way, last = path.split(".")
    place = message
    for name in way:
        place = getattr(place, name)
    setattr(place, last, value)
    return message


@pytest.fixture
def world(load: Callable[..., Simulation]) -> Simulation:
    """A box on the ground and a wheel, with Gazebo's services."""
    sim = load(world="empty", services=True)
    sim.spawn(BOX, name="box", pose=Pose((0.0, 0.0, 0.1)))
    sim.spawn(WHEEL, name="wheel")
    sim.run(seconds=0.1)
    return sim


def _request(kind: str, **fields: Any) -> Any:
    return service_type(f"gazebo_msgs/{kind}").Request(**fields)


CALLS = [
    ("set_model_state", "SetModelState", "model_state.model_name", "box",
     ["model_state.pose.position.x", "model_state.pose.orientation.w",
      "model_state.twist.linear.z", "model_state.twist.angular.y"]),
    ("set_link_state", "SetLinkState", "link_state.link_name", "box::link",
     ["link_state.pose.position.z", "link_state.twist.linear.x"]),
    ("apply_body_wrench", "ApplyBodyWrench", "body_name", "box::link",
     ["wrench.force.x", "wrench.torque.z", "reference_point.y"]),
    ("apply_joint_effort", "ApplyJointEffort", "joint_name", "wheel::spin", ["effort"]),
    ("set_physics_properties", "SetPhysicsProperties", None, None,
     ["time_step", "max_update_rate", "gravity.z"]),
    ("set_link_properties", "SetLinkProperties", "link_name", "box::link", ["mass", "ixx"]),
    ("spawn_sdf_model", "SpawnModel", "model_name", "new",
     ["initial_pose.position.y", "initial_pose.orientation.x"]),
]  # fmt: skip


@pytest.mark.parametrize("value", BAD)
@pytest.mark.parametrize(
    ("service", "kind", "where", "who", "field"),
    [(*call[:4], field) for call in CALLS for field in call[4]],
)
def test_service_refuses_a_number_that_cannot_be(
    world: Simulation,
    service: str,
    kind: str,
    where: str | None,
    who: str | None,
    field: str,
    value: float,
) -> None:
    fields = {"model_xml": BOX} if kind == "SpawnModel" else {}
    request = _request(kind, **fields)
    if kind == "SetPhysicsProperties":
        request.time_step, request.max_update_rate, request.gravity.z = 0.001, 1000.0, -9.8
    if where is not None:
        _filled(request, where, who)
    before = world.server.engine.state_hash()
    response = world.server.node.call(f"/gazebo/{service}", _filled(request, field, value))
    assert not response.success
    assert f"field '{field}'" in response.status_message
    assert world.server.engine.state_hash() == before
    world.run(seconds=0.01)


@pytest.mark.parametrize("value", [0.0, -1.0, -0.001, 1e-12, 11.0, 1e6])
def test_step_that_cannot_be_is_refused(world: Simulation, value: float) -> None:
    request = _request("SetPhysicsProperties", time_step=value, max_update_rate=1000.0)
    response = world.server.node.call("/gazebo/set_physics_properties", request)
    assert not response.success
    assert response.status_message == (
        f"/gazebo/set_physics_properties: field 'time_step' is {value:g}, it has to be at least "
        "1e-09 and at most 10; nothing is changed"
    )
    assert world.server.engine.step_ns == 1_000_000


@pytest.mark.parametrize(
    ("service", "kind", "who", "field", "limit"),
    [
        ("set_model_state", "SetModelState", ("model_state.model_name", "box"),
         "model_state.pose.position.x", "100000"),
        ("set_model_state", "SetModelState", ("model_state.model_name", "box"),
         "model_state.twist.linear.z", "10000"),
        ("set_model_state", "SetModelState", ("model_state.model_name", "box"),
         "model_state.twist.angular.y", "10000"),
        ("set_link_state", "SetLinkState", ("link_state.link_name", "box::link"),
         "link_state.pose.position.z", "100000"),
        ("set_link_state", "SetLinkState", ("link_state.link_name", "box::link"),
         "link_state.twist.linear.x", "10000"),
        ("spawn_sdf_model", "SpawnModel", ("model_name", "new"),
         "initial_pose.position.y", "100000"),
    ],
)  # fmt: skip
def test_million_is_refused_where_nothing_has_it(
    world: Simulation, service: str, kind: str, who: tuple[str, str], field: str, limit: str
) -> None:
    request = _filled(_filled(_request(kind), *who), field, 1e6)
    before = world.server.engine.state_hash()
    response = world.server.node.call(f"/gazebo/{service}", request)
    assert not response.success
    assert response.status_message == (
        f"/gazebo/{service}: field '{field}' is 1e+06, beyond the ±{limit}, which nothing in a "
        "world can have; nothing is changed"
    )
    assert world.server.engine.state_hash() == before


def test_gravity_of_a_million_is_refused(world: Simulation) -> None:
    request = _request("SetPhysicsProperties", time_step=0.001, max_update_rate=1000.0)
    request.gravity.z = -1e6
    response = world.server.node.call("/gazebo/set_physics_properties", request)
    assert response.status_message == (
        "/gazebo/set_physics_properties: field 'gravity_z' is -1e+06, it has to be at least -100 "
        "and at most 100; nothing is changed"
    )
    assert world.server.engine.gravity_m_s2[2] == -9.8


@pytest.mark.parametrize("field", ["wrench.force.x", "wrench.torque.z"])
def test_wrench_of_a_million_is_a_rockets_and_the_world_outlives_it(
    world: Simulation, field: str
) -> None:
    request = _filled(_request("ApplyBodyWrench", body_name="box::link"), field, 1e6)
    request.duration.sec = -1
    assert world.server.node.call("/gazebo/apply_body_wrench", request).success
    server = world.server
    server.mode = Mode.REAL_TIME
    running = threading.Thread(target=server.run)
    running.start()
    try:
        eventually(lambda: server.paused or server.time_ns > 1_000_000_000)
        call = server.node.call
        assert call("/gazebo/delete_model", _request("DeleteModel", model_name="box")).success
        server.unpause()
        at_ns = server.time_ns
        eventually(lambda: server.time_ns > at_ns + 20_000_000)
    finally:
        server.stop()
        running.join(stretched())


def test_link_that_no_world_can_be_built_with_is_refused_and_its_model_stays(
    world: Simulation,
) -> None:
    light = {"mass": 1e-300, "ixx": 0.1, "iyy": 0.1, "izz": 0.1}
    request = _request("SetLinkProperties", link_name="box::link", **light)
    before = world.server.engine.state_hash()
    response = world.server.node.call("/gazebo/set_link_properties", request)
    assert not response.success
    assert "MuJoCo cannot build the world" in response.status_message
    assert world.server.engine.state_hash() == before


def test_wrench_that_begins_when_its_model_has_gone_does_nothing(world: Simulation) -> None:
    request = _request("ApplyBodyWrench", body_name="box::link")
    request.wrench.force.x, request.start_time.sec, request.duration.sec = 1.0, 1, 1
    assert world.server.node.call("/gazebo/apply_body_wrench", request).success
    world.server.delete("box")
    world.run(seconds=1.1)


def test_engine_refuses_places_that_no_state_can_have(world: Simulation) -> None:
    """Squares of them are no numbers: a world could neither go on from there nor go back."""
    engine, far = world.server.engine, Pose((0.0, 1e300, 0.0))
    before = engine.state_hash()
    link = engine.description_of_link("box::link")
    model = replace(engine.world.models[1], links=(replace(link, T_model_link=far),))
    for attempt in (
        lambda: engine.set_model_pose("box", far),
        lambda: engine.link("box::link").set_pose(far),
        lambda: engine.joint("wheel::spin").set_state(position=1e300),
        lambda: engine.spawn(model, name="x"),
    ):
        with pytest.raises(EngineError, match=r"given 1e\+300: nothing is farther away than"):
            attempt()
    assert engine.state_hash() == before


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("pose.position.x", math.nan, "is nan"),
        ("pose.position.x", -math.inf, "is -inf"),
        ("pose.position.x", 1e300, "is 1e+300, beyond the ±100000"),
        ("pose.position.x", 1e6, "is 1e+06, beyond the ±100000"),
        ("twist.linear.z", math.inf, "is inf"),
        ("twist.linear.z", 1e6, "is 1e+06, beyond the ±10000"),
        ("twist.angular.x", 1e300, "is 1e+300, beyond the ±10000"),
    ],
)
def test_topic_leaves_a_number_out_that_cannot_be_and_tells_once(
    world: Simulation, caplog: pytest.LogCaptureFixture, field: str, value: float, words: str
) -> None:
    good = message_type("gazebo_msgs/ModelState")(model_name="box")
    state = _filled(message_type("gazebo_msgs/ModelState")(model_name="box"), field, value)
    publisher = world.server.node.create_publisher("/gazebo/set_model_state", type(state))
    before = world.server.engine.state_hash()
    publisher.publish(state)
    publisher.publish(state)
    assert world.server.engine.state_hash() == before
    assert [record.message for record in caplog.records] == [
        f"[/gazebo/set_model_state] field '{field}' {words}, which nothing in a world can have; "
        "the message is left out"
    ]
    good.pose.position.x = 1.0
    publisher.publish(good)
    assert world.server.engine.model_pose("box").position_m[0] == 1.0


def test_a_response_without_room_for_a_reason_fails_the_call() -> None:
    response = service_type("std_srvs/Empty").Response()
    with pytest.raises(ServiceRefusedError, match="no"):
        refusal(response, "no")


def test_limits_belong_to_what_a_number_means() -> None:
    twist = message_type("geometry_msgs/Twist")()
    twist.linear.x = 2e4
    assert problem_of(twist) == (
        "field 'linear.x' is 20000, beyond the ±10000, which nothing in a world can have"
    )
    pose, wrench = message_type("geometry_msgs/Pose")(), message_type("geometry_msgs/Wrench")()
    pose.position.y, wrench.force.z = -1e5, 1e7
    assert (problem_of(pose), problem_of(wrench)) == ("", "")
    pose.position.y, wrench.force.z = -1.001e5, 1.001e7
    assert "field 'position.y' is -100100, beyond the ±100000" in problem_of(pose)
    assert "field 'force.z' is 1.001e+07, beyond the ±1e+07" in problem_of(wrench)
    array = message_type("std_msgs/Float64MultiArray")(data=[0.0, 2e4, math.inf])
    assert problem_of(array) == "field 'data[2]' is inf, which nothing in a world can have"
    path = message_type("tf2_msgs/TFMessage")(
        transforms=[message_type("geometry_msgs/TransformStamped")() for _ in range(3)]
    )
    assert problem_of(path) == ""
    path.transforms[1].transform.translation.y = math.nan
    assert "field 'transforms[1].transform.translation.y' is nan" in problem_of(path)


def test_recent_inputs_are_those_of_the_last_second_latest_first() -> None:
    inputs = Inputs()
    inputs.note("/old", 0)
    inputs.note("/a", 1_500_000_000, "/caller")
    inputs.note("/b", 1_600_000_000)
    inputs.note("/gone", 1_600_000_000)
    inputs.forget("/gone")
    assert inputs.recent(2_000_000_000) == (
        ("/b", "", 1_600_000_000), ("/a", "/caller", 1_500_000_000),
    )  # fmt: skip


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_engine_takes_no_number_that_is_none(world: Simulation, value: float) -> None:
    engine = world.server.engine
    link, joint = engine.link("box::link"), engine.joint("wheel::spin")
    bad = (value, 0.0, 0.0)
    for attempt in (
        lambda: engine.set_model_pose("box", Pose(bad)),
        lambda: link.set_pose(Pose(bad)),
        lambda: engine.set_model_velocity("box", bad, (0.0, 0.0, 0.0)),
        lambda: link.apply_wrench(bad),
        lambda: engine.set_gravity(bad),
        lambda: joint.set_effort(value),
        lambda: joint.set_velocity_target(value),
        lambda: engine.spawn(engine.world.models[0], name="x", T_world_model=Pose(bad)),
    ):
        with pytest.raises(EngineError, match="a finite number is needed"):
            attempt()
    world.run(seconds=0.01)
