"""Numbers from outside: those that cannot be have no effect, and their senders hear why."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.errors import EngineError
from gazelle.geometry import Pose
from gazelle.graph.errors import ServiceRefusedError
from gazelle.simulator import Simulation
from gazelle.simulator.inputs import Inputs, problem_of, refusal
from gazelle.simulator.messages import message_class, service_class

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
    return service_class(f"gazebo_msgs/{kind}").Request(**fields)


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


@pytest.mark.parametrize("value", [0.0, -1.0, -0.001, 11.0])
def test_step_that_cannot_be_is_refused(world: Simulation, value: float) -> None:
    request = _request("SetPhysicsProperties", time_step=value, max_update_rate=1000.0)
    response = world.server.node.call("/gazebo/set_physics_properties", request)
    assert not response.success
    assert response.status_message == (
        f"SetPhysicsProperties: 'time_step' is {value:g}, it has to be more than 0 and at most 10; "
        "nothing is changed"
    )
    assert world.server.engine.step_ns == 1_000_000


def test_topic_leaves_a_number_out_that_cannot_be_and_tells_once(
    world: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    state = message_class("gazebo_msgs/ModelState")(model_name="box")
    state.pose.position.x = math.nan
    publisher = world.server.node.create_publisher("/gazebo/set_model_state", type(state))
    before = world.server.engine.state_hash()
    publisher.publish(state)
    publisher.publish(state)
    assert world.server.engine.state_hash() == before
    assert [record.message for record in caplog.records] == [
        "[/gazebo/set_model_state] field 'pose.position.x' is nan, which nothing in a world can "
        "have; the message is left out"
    ]
    state.pose.position.x = 1.0
    publisher.publish(state)
    assert world.server.engine.model_pose("box").position_m[0] == 1.0


def test_a_response_without_room_for_a_reason_fails_the_call() -> None:
    response = service_class("std_srvs/Empty").Response()
    with pytest.raises(ServiceRefusedError, match="no"):
        refusal(response, "no")


def test_limits_belong_to_what_a_number_means() -> None:
    twist = message_class("geometry_msgs/Twist")()
    twist.linear.x = 2e4
    assert problem_of(twist) == (
        "field 'linear.x' is 20000, beyond the ±10000, which nothing in a world can have"
    )
    array = message_class("std_msgs/Float64MultiArray")(data=[0.0, 2e4, math.inf])
    assert problem_of(array) == "field 'data[2]' is inf, which nothing in a world can have"
    path = message_class("tf2_msgs/TFMessage")(
        transforms=[message_class("geometry_msgs/TransformStamped")() for _ in range(3)]
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
