from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import needs_shared

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import pose_message, twist_message
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import ROS2_PLUGINS, offer_gazebo_ros

BOX = """<sdf version="1.6"><model name="{name}"><link name="link">
  <inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
</link></model></sdf>"""
ARM = """<robot name="arm"><link name="world"/>
  <joint name="swing" type="revolute"><parent link="world"/><child link="bob"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="50" velocity="9"/></joint>
  <link name="bob"><inertial><mass value="1"/>
    <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link></robot>"""


class World:
    """A world with services, and a short way to call them."""

    def __init__(self, sim: Simulation) -> None:
        self.sim = sim

    def call(self, name: str, kind: str, /, **fields: Any) -> Any:
        service = service_type(kind if "/" in kind else f"gazebo_msgs/{kind}")
        name = name if name.startswith("/") else f"/gazebo/{name}"
        return self.sim.server.node.call(name, service.Request(**fields))  # type: ignore[attr-defined]


# What gazebo_ros of Gazebo 11 offers, but for the loggers that every node of roscpp has.
GAZEBO_ROS_SERVICES = [
    "apply_body_wrench",
    "apply_joint_effort",
    "clear_body_wrenches",
    "clear_joint_forces",
    "delete_light",
    "delete_model",
    "get_joint_properties",
    "get_light_properties",
    "get_link_properties",
    "get_link_state",
    "get_model_properties",
    "get_model_state",
    "get_physics_properties",
    "get_world_properties",
    "pause_physics",
    "reset_simulation",
    "reset_world",
    "set_joint_properties",
    "set_light_properties",
    "set_link_properties",
    "set_link_state",
    "set_model_configuration",
    "set_model_state",
    "set_parameters",
    "set_physics_properties",
    "spawn_sdf_model",
    "spawn_urdf_model",
    "unpause_physics",
]


@pytest.fixture
def world(load: Callable[..., Simulation]) -> World:
    sim = load(world="empty", services=True)
    sim.spawn(BOX.format(name="box"), pose=Pose((1.0, 0.0, 0.1)))
    return World(sim)


def state(cls: str, **fields: Any) -> Any:
    return message_type(f"gazebo_msgs/{cls}")(**fields)


def test_the_services_and_topics_are_those_of_gazebo_ros(world: World) -> None:
    offered = set(world.sim.server.node.services)  # type: ignore[attr-defined]
    assert offered >= {f"/gazebo/{name}" for name in GAZEBO_ROS_SERVICES}
    topics = world.sim.server.node.topics  # type: ignore[attr-defined]
    assert set(topics) >= {"/gazebo/link_states", "/gazebo/model_states"}
    assert {"/clock", "/gazebo/parameter_descriptions", "/gazebo/parameter_updates"} <= set(topics)


@needs_shared
def test_services_and_topics_are_those_that_gazebo_ros_showed(
    world: World, oracles_dir: Path
) -> None:
    lines = (oracles_dir / "gazebo_slambot" / "services.txt").read_text().splitlines()
    recorded = {line.split()[0] for line in lines if line.startswith("/gazebo/")}
    loggers = {"/gazebo/get_loggers", "/gazebo/set_logger_level"}
    assert recorded - loggers == {f"/gazebo/{name}" for name in GAZEBO_ROS_SERVICES}
    live = (oracles_dir / "gazebo_classic" / "gazebo_ros_live.txt").read_text().splitlines()
    published = {line for line in live if line.startswith("/gazebo/") and "state" in line}
    topics = world.sim.server.node.topics  # type: ignore[attr-defined]
    assert {"/gazebo/link_states", "/gazebo/model_states"} <= published & set(topics)


def test_physics_properties_are_gazebos_defaults(world: World) -> None:
    found = world.call("get_physics_properties", "GetPhysicsProperties")
    assert (found.time_step, found.max_update_rate, found.gravity.z) == (0.001, 1000.0, -9.8)
    config = found.ode_config
    assert (config.sor_pgs_iters, config.sor_pgs_w, config.erp) == (50, 1.3, 0.2)
    assert (config.contact_surface_layer, config.max_contacts) == (0.001, 20)
    assert found.status_message == "GetPhysicsProperties: got properties"


def test_words_of_ode_are_kept_and_said_to_change_nothing(world: World) -> None:
    found = world.call("get_physics_properties", "GetPhysicsProperties")
    found.ode_config.sor_pgs_iters = 200
    answer = world.call(
        "set_physics_properties",
        "SetPhysicsProperties",
        time_step=found.time_step,
        max_update_rate=found.max_update_rate,
        gravity=found.gravity,
        ode_config=found.ode_config,
    )
    assert answer.success
    assert answer.status_message.endswith("for ODE is not at work: sor_pgs_iters")
    kept = world.call("get_physics_properties", "GetPhysicsProperties")
    assert kept.ode_config.sor_pgs_iters == 200


def test_physics_properties_change_step_and_gravity(world: World) -> None:
    found = world.call("get_physics_properties", "GetPhysicsProperties")
    found.gravity.z = -1.6
    answer = world.call(
        "set_physics_properties",
        "SetPhysicsProperties",
        time_step=0.002,
        max_update_rate=500.0,
        gravity=found.gravity,
        ode_config=found.ode_config,
    )
    assert answer.status_message == "physics engine updated"
    assert world.sim.step_s == 0.002
    world.sim.model("box").pose = Pose((1.0, 0.0, 3.0))
    start = world.sim.time_s
    world.sim.run(seconds=1.0)
    fallen = 3.0 - world.sim.model("box").pose.position_m[2]
    assert world.sim.time_s - start == pytest.approx(1.0)
    assert fallen == pytest.approx(0.8, rel=0.01)
    assert world.sim.server.node.parameters.get("/gazebo/gravity_z") == -1.6


def test_dynamic_parameters_change_the_same_things(world: World) -> None:
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    value = message_type("dynamic_reconfigure/DoubleParameter")(name="gravity_z", value=0.0)
    request.config.doubles = [value]
    world.sim.server.node.call("/gazebo/set_parameters", request)  # type: ignore[attr-defined]
    found = world.call("get_physics_properties", "GetPhysicsProperties")
    assert found.gravity.z == 0.0


def test_world_properties_list_the_models(world: World) -> None:
    world.sim.run(seconds=0.5)
    found = world.call("get_world_properties", "GetWorldProperties")
    assert found.model_names == ["ground_plane", "box"]
    assert found.sim_time == pytest.approx(0.5)


def test_model_state_can_be_set_and_read_relative_to_another(world: World) -> None:
    world.sim.spawn(BOX.format(name="other"), pose=Pose.from_xyz_rpy((0, 2, 0.1), (0, 0, math.pi)))
    wanted = state(
        "ModelState",
        model_name="box",
        pose=pose_message(Pose((1.0, 0.0, 0.0))),
        twist=twist_message((0.5, 0.0, 0.0), (0.0, 0.0, 0.2)),
        reference_frame="other",
    )
    answer = world.call("set_model_state", "SetModelState", model_state=wanted)
    assert answer.status_message == "SetModelState: set model state done"
    found = world.call("get_model_state", "GetModelState", model_name="box")
    place = found.pose.position
    assert (place.x, place.y) == pytest.approx((-1.0, 2.0))
    assert found.twist.linear.x == pytest.approx(-0.5)
    near = world.call(
        "get_model_state", "GetModelState", model_name="box", relative_entity_name="other"
    )
    assert near.pose.position.x == pytest.approx(1.0)
    assert near.twist.linear.x == pytest.approx(0.5)
    assert near.header.frame_id == "other"


@pytest.mark.parametrize(
    ("service", "kind", "fields", "text"),
    [
        ("get_model_state", "GetModelState", {"model_name": "bx"},
         "GetModelState: model does not exist; did you mean 'box'"),
        ("get_model_state", "GetModelState",
         {"model_name": "box", "relative_entity_name": "nowhere"},
         "GetModelState: reference relative_entity_name not found, did you forget to scope"),
        ("get_link_state", "GetLinkState", {"link_name": "link"},
         "GetLinkState: link not found, did you forget to scope the link by model name?"),
        ("get_link_properties", "GetLinkProperties", {"link_name": "box::lnk"},
         "GetLinkProperties: link not found, did you forget to scope the link by model name?"),
        ("get_joint_properties", "GetJointProperties", {"joint_name": "swing"},
         "GetJointProperties: joint not found"),
        ("get_model_properties", "GetModelProperties", {"model_name": "bx"},
         "GetModelProperties: model does not exist"),
        ("apply_joint_effort", "ApplyJointEffort", {"joint_name": "j"},
         "ApplyJointEffort: joint not found"),
        ("apply_body_wrench", "ApplyBodyWrench", {"body_name": "b"},
         "ApplyBodyWrench: body does not exist"),
        ("delete_model", "DeleteModel", {"model_name": "bx"},
         "DeleteModel: model does not exist"),
        ("delete_light", "DeleteLight", {"light_name": "sum"},
         "DeleteLight: Requested light sum not found! did you mean 'sun'?"),
        ("get_light_properties", "GetLightProperties", {"light_name": "moon"},
         "getLightProperties: Requested light moon not found!"),
        ("set_model_configuration", "SetModelConfiguration", {"model_name": "bx"},
         "SetModelConfiguration: model does not exist"),
        ("set_link_properties", "SetLinkProperties", {"link_name": "b"},
         "SetLinkProperties: link not found"),
        ("set_joint_properties", "SetJointProperties", {"joint_name": "j"},
         "SetJointProperties: joint not found"),
        ("set_light_properties", "SetLightProperties", {"light_name": "moon"},
         "setLightProperties: Requested light moon not found!"),
    ],
)  # fmt: skip
def test_unknown_names_fail_with_gazebos_words(
    world: World, service: str, kind: str, fields: dict[str, Any], text: str
) -> None:
    answer = world.call(service, kind, **fields)
    assert not answer.success
    assert answer.status_message.startswith(text)


def test_a_model_that_is_fixed_to_the_world_is_not_given_a_velocity(world: World) -> None:
    world.sim.spawn(ARM)
    wanted = state(
        "ModelState", model_name="arm", twist=twist_message((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    )
    answer = world.call("set_model_state", "SetModelState", model_state=wanted)
    assert not answer.success
    assert "is fixed to the world and cannot be pushed" in answer.status_message


def test_states_can_be_set_through_topics(world: World) -> None:
    pose = pose_message(Pose((4.0, 0.0, 0.1)))
    world.sim.publish("/gazebo/set_model_state", state("ModelState", model_name="box", pose=pose))
    assert world.sim.model("box").pose.position_m[0] == pytest.approx(4.0)
    pose = pose_message(Pose((5.0, 0.0, 0.1)))
    link_state = state("LinkState", link_name="box::link", pose=pose)
    world.sim.publish("/gazebo/set_link_state", link_state)
    assert world.sim.model("box").pose.position_m[0] == pytest.approx(5.0)


def test_states_are_published_while_somebody_listens(
    world: World, listen: Callable[..., list[Any]]
) -> None:
    links, models = (
        listen(world.sim, "/gazebo/link_states"),
        listen(world.sim, "/gazebo/model_states"),
    )
    world.sim.run(seconds=0.05)
    assert len(links) == len(models) == 50
    assert models[-1].name == ["ground_plane", "box"]
    assert "box::link" in links[-1].name
    place = models[-1].pose[1].position
    assert place.x == pytest.approx(1.0)


def test_the_clock_frequency_is_a_parameter(load: Callable[..., Simulation], listen: Any) -> None:
    from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros

    sim = load(world=None)
    sim.server.node.parameters.set("/gazebo/pub_clock_frequency", 100)
    offer_gazebo_ros(sim.server)
    clock = listen(sim, "/clock")
    sim.run(seconds=0.5)
    assert len(clock) == 50
    assert sim.server.node.parameters.get("/use_sim_time") is True


def test_link_properties_are_read_and_changed(world: World) -> None:
    found = world.call("get_link_properties", "GetLinkProperties", link_name="box::link")
    assert (found.mass, found.ixx, found.gravity_mode) == (2.0, 0.1, True)
    world.sim.model("box").pose = Pose((3.0, 0.0, 2.0))
    answer = world.call(
        "set_link_properties",
        "SetLinkProperties",
        link_name="box::link",
        com=found.com,
        gravity_mode=False,
        mass=5.0,
        ixx=0.2,
        iyy=0.2,
        izz=0.2,
    )
    assert answer.status_message == "SetLinkProperties: properties set"
    assert world.sim.model("box").pose.position_m == pytest.approx((3.0, 0.0, 2.0))
    world.sim.run(seconds=0.5)
    assert world.sim.model("box").pose.position_m[2] == pytest.approx(2.0)
    changed = world.call("get_link_properties", "GetLinkProperties", link_name="box::link")
    assert changed.mass == 5.0


def test_a_wrench_acts_for_its_duration(world: World) -> None:
    world.sim.model("box").pose = Pose((0.0, 0.0, 5.0))
    wrench = message_type("geometry_msgs/Wrench")()
    wrench.force.x = 4.0
    wrench.force.z = 2 * 9.8
    duration = message_type("builtin_interfaces/Duration")(sec=0, nanosec=500_000_000)
    answer = world.call(
        "apply_body_wrench", "ApplyBodyWrench", body_name="box::link", wrench=wrench,
        duration=duration,
    )  # fmt: skip
    assert answer.success
    world.sim.run(seconds=0.5)
    linear = world.sim.link("box::link").linear_velocity_m_s
    assert linear == pytest.approx((1.0, 0.0, 0.0), abs=1e-2)


def test_wrenches_for_ever_are_cleared(world: World) -> None:
    wrench = message_type("geometry_msgs/Wrench")()
    wrench.force.z = 100.0
    duration = message_type("builtin_interfaces/Duration")(sec=-1, nanosec=0)
    world.call(
        "apply_body_wrench", "ApplyBodyWrench", body_name="box::link", wrench=wrench,
        duration=duration,
    )  # fmt: skip
    world.sim.run(seconds=0.1)
    rising = world.sim.link("box::link").linear_velocity_m_s[2]
    world.call("clear_body_wrenches", "BodyRequest", body_name="box::link")
    world.sim.run(seconds=0.1)
    falling = world.sim.link("box::link").linear_velocity_m_s[2]
    assert rising == pytest.approx((100 / 2 - 9.8) * 0.1, rel=0.02)
    assert falling == pytest.approx(rising - 0.98, rel=0.02)


def test_a_joint_effort_starts_and_ends_in_time(world: World) -> None:
    world.sim.spawn(ARM)
    time = message_type("builtin_interfaces/Time")
    duration = message_type("builtin_interfaces/Duration")
    answer = world.call(
        "apply_joint_effort", "ApplyJointEffort", joint_name="swing", effort=1.0,
        start_time=time(sec=0, nanosec=100_000_000), duration=duration(sec=0, nanosec=250_000_000),
    )  # fmt: skip
    assert answer.status_message == "ApplyJointEffort: effort set"
    world.sim.run(seconds=0.1)
    assert world.sim.joint("swing").velocity == 0.0
    world.sim.run(seconds=0.9)
    # 1 N·m on 0.5 kg·m² for 0.25 s.
    assert world.sim.joint("swing").velocity == pytest.approx(0.5, rel=0.01)


def test_efforts_for_ever_are_cleared(world: World) -> None:
    world.sim.spawn(ARM)
    duration = message_type("builtin_interfaces/Duration")(sec=-1, nanosec=0)
    world.call("apply_joint_effort", "ApplyJointEffort", joint_name="swing", effort=1.0,
               duration=duration)  # fmt: skip
    world.sim.run(seconds=0.25)
    world.call("clear_joint_forces", "JointRequest", joint_name="swing")
    world.sim.run(seconds=0.25)
    assert world.sim.joint("swing").velocity == pytest.approx(0.5, rel=0.01)


def test_joint_properties_are_read_and_changed(world: World) -> None:
    world.sim.spawn(ARM)
    world.call(
        "set_model_configuration", "SetModelConfiguration", model_name="arm",
        joint_names=["swing"], joint_positions=[0.7],
    )  # fmt: skip
    found = world.call("get_joint_properties", "GetJointProperties", joint_name="swing")
    assert found.position == pytest.approx([0.7])
    config = state("ODEJointProperties", damping=[2.0], hi_stop=[0.9])
    world.call("set_joint_properties", "SetJointProperties", joint_name="swing",
               ode_joint_config=config)  # fmt: skip
    changed = world.call("get_joint_properties", "GetJointProperties", joint_name="swing")
    assert changed.damping == pytest.approx([2.0])
    assert changed.position == pytest.approx([0.7])
    assert world.sim.joint("swing").handle.upper == 0.9


def test_configuration_needs_as_many_positions_and_says_what_it_leaves_out(world: World) -> None:
    world.sim.spawn(ARM)
    answer = world.call("set_model_configuration", "SetModelConfiguration", model_name="arm",
                        joint_names=["swing"], joint_positions=[])  # fmt: skip
    assert "have different lengths" in answer.status_message
    answer = world.call("set_model_configuration", "SetModelConfiguration", model_name="arm",
                        joint_names=["swng", "swing"], joint_positions=[1.0, 40.0])  # fmt: skip
    assert answer.success
    limit = world.sim.joint("swing").handle.upper
    assert answer.status_message == (
        "SetModelConfiguration: success, but there is no joint 'swng'; 40 is beyond the limit of "
        f"joint 'swing', {limit:g} is set"
    )
    assert world.sim.joint("swing").position == limit


def test_lights_are_read_changed_and_deleted(world: World) -> None:
    found = world.call("get_light_properties", "GetLightProperties", light_name="sun")
    assert found.success
    found.diffuse.r = 0.25
    world.call("set_light_properties", "SetLightProperties", light_name="sun",
               diffuse=found.diffuse, attenuation_constant=1.0)  # fmt: skip
    again = world.call("get_light_properties", "GetLightProperties", light_name="sun")
    assert again.diffuse.r == pytest.approx(0.25)
    assert world.sim.server.sensors.view().world.lights[0].diffuse[0] == 0.25
    answer = world.call("delete_light", "DeleteLight", light_name="sun")
    assert answer.status_message == "DeleteLight: sun successfully deleted"
    assert world.sim.server.sensors.view().world.lights == ()


def test_spawning_and_deleting_answer_with_gazebos_words(world: World) -> None:
    fields = {"model_name": "two", "model_xml": BOX.format(name="x")}
    answer = world.call("spawn_sdf_model", "SpawnModel", **fields)
    assert answer.status_message == "SpawnModel: Successfully spawned entity"
    assert world.sim.model("two").links == ("link",)
    answer = world.call("spawn_sdf_model", "SpawnModel", **fields)
    assert answer.status_message == "SpawnModel: Failure - entity already exists."
    answer = world.call("spawn_urdf_model", "SpawnModel", model_name="x", model_xml="<sdf/>")
    assert answer.status_message == "SpawnModel: Failure - entity format is invalid."
    answer = world.call("spawn_sdf_model", "SpawnModel", model_name="x", model_xml="<sdf><model")
    assert answer.status_message.startswith("SpawnModel: Failure - ")
    answer = world.call("delete_model", "DeleteModel", model_name="two")
    assert answer.status_message == "DeleteModel: successfully deleted model"


def test_spawning_uses_pose_frame_and_namespace(
    world: World, cart_urdf: Callable[..., str]
) -> None:
    world.call(
        "spawn_urdf_model",
        "SpawnModel",
        model_name="cart",
        model_xml=cart_urdf(),
        robot_namespace="/r2",
        initial_pose=pose_message(Pose((2.0, 0.0, 0.0))),
        reference_frame="box",
    )
    assert world.sim.model("cart").pose.position_m[0] == pytest.approx(3.0)
    assert "/r2/scan" in world.sim.server.node.topics  # type: ignore[attr-defined]
    answer = world.call("spawn_urdf_model", "SpawnModel", model_name="c", model_xml=cart_urdf(),
                        reference_frame="nowhere")  # fmt: skip
    assert "reference reference_frame not found" in answer.status_message


def test_ros_2_names_do_the_same(world: World) -> None:
    answer = world.call("/spawn_entity", "SpawnEntity", name="two", xml=BOX.format(name="x"))
    assert answer.status_message == "SpawnEntity: Successfully spawned entity [two]"
    answer = world.call("/spawn_entity", "SpawnEntity", name="two", xml=BOX.format(name="x"))
    assert answer.status_message == "Entity [two] already exists."
    assert world.call("/get_model_list", "GetModelList").model_names[-1] == "two"
    wanted = state("EntityState", name="two", pose=pose_message(Pose((0.0, 3.0, 0.1))))
    assert world.call("/set_entity_state", "SetEntityState", state=wanted).success
    found = world.call("/get_entity_state", "GetEntityState", name="two::link")
    assert found.state.pose.position.y == pytest.approx(3.0)
    assert not world.call("/get_entity_state", "GetEntityState", name="three").success
    wanted = state("EntityState", name="two::link", pose=pose_message(Pose((0.0, 4.0, 0.1))))
    assert world.call("/set_entity_state", "SetEntityState", state=wanted).success
    wrench = message_type("geometry_msgs/Wrench")()
    wrench.force.x = 1.0
    answer = world.call("/apply_link_wrench", "ApplyLinkWrench", link_name="two::link",
                        wrench=wrench)  # fmt: skip
    assert answer.success
    world.call("/clear_link_wrenches", "LinkRequest", link_name="two::link")
    answer = world.call("/delete_entity", "DeleteEntity", name="two")
    assert answer.status_message == "DeleteEntity: successfully deleted model"


def test_resets_put_models_back_and_time_too(world: World) -> None:
    empty = "std_srvs/Empty"
    world.sim.model("box").pose = Pose((9.0, 0.0, 0.1))
    world.sim.run(seconds=0.1)
    world.call("reset_world", empty)
    assert world.sim.model("box").pose.position_m[0] == pytest.approx(1.0)
    assert world.sim.time_ns == 100_000_000
    world.call("reset_simulation", empty)
    assert world.sim.time_ns == 0


def test_model_properties_list_parts(world: World) -> None:
    found = world.call("get_model_properties", "GetModelProperties", model_name="box")
    assert (found.body_names, found.geom_names) == (["link"], ["c"])
    assert not found.is_static
    found = world.call("get_model_properties", "GetModelProperties", model_name="ground_plane")
    assert found.is_static


def test_faster_than_real_time_the_clock_shows_500_times_a_real_second(
    load: Callable[..., Simulation], listen: Any
) -> None:
    sim = load(world=None, services=True)
    clock = listen(sim, "/clock")
    sim.server.pace.factor = 3.0
    sim.run(seconds=0.6)
    assert len(clock) == 100
    sim.server.paused = True
    sim.server.step(5)
    assert len(clock) == 105


@pytest.mark.parametrize(("version", "has_them"), [(1, True), (2, False)])
def test_only_a_world_for_ros1_has_its_dynamic_parameters(
    free_port: int, version: int, has_them: bool
) -> None:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        sim = Simulation.load(world="empty", node=graph.create_node("gazebo"))
        sim.server.ros_version = version
        offer_gazebo_ros(sim.server, ros2=ROS2_PLUGINS if version == 2 else ())
        topics = dict(graph.topic_names_and_types())
        services = {one.name for one in graph.services()}
        for name in ("parameter_descriptions", "parameter_updates", "set_model_state"):
            assert (f"/gazebo/{name}" in topics) is has_them
        assert ("/gazebo/set_parameters" in services) is has_them
        sim.close()
