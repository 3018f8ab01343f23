"""What controllers say and hear, on a world without a graph."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.controller_node_interface import LiveParameter
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.resource_manager import Robot
from gazelle.description.model import Model, World
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.interfaces import message_type, ros1_service_type, service_type
from gazelle.simulator.controller_node import ControllerPorts, make_ports, offer_manager
from gazelle.simulator.plugins.context import Resources
from gazelle.simulator.world_server import WorldServer

FLOAT = message_type("std_msgs/Float64")
TWIST = message_type("geometry_msgs/Twist")
STAMPED = message_type("geometry_msgs/TwistStamped")


@pytest.fixture
def server() -> Iterator[WorldServer]:
    """An empty world."""
    made = WorldServer(World())
    yield made
    made.close()


def _ports(server: WorldServer, ros_version: int = 1, **options: Any) -> ControllerPorts:
    return make_ports(server, Resources(server), "mira", "roll", ros_version, **options)


def test_names_are_the_controllers_the_managers_or_global(server):
    ports = _ports(server)
    ports.publisher("~/state", "std_msgs/Float64")
    ports.publisher("joint_states", "std_msgs/Float64")
    ports.publisher("/tf", "std_msgs/Float64")
    assert set(server.node.topics) >= {"/mira/roll/state", "/mira/joint_states", "/tf"}


@pytest.mark.parametrize(
    "rule",
    [
        ("/mira/roll/cmd", "/cmd_vel"),
        ("roll/cmd", "/cmd_vel"),
        ("~/cmd", "/cmd_vel"),
    ],
)
def test_remapping_rules_of_the_plugin_apply(server, rule):
    ports = _ports(server, 2, remappings=(rule,))
    ports.publisher("~/cmd", "std_msgs/Float64")
    assert "/cmd_vel" in server.node.topics
    assert "/mira/roll/cmd" not in server.node.topics


def test_several_types_are_taken_and_others_are_refused_once(server, caplog):
    ports = _ports(server)
    got: list[Any] = []
    ports.subscription("~/cmd", ("geometry_msgs/Twist", "geometry_msgs/TwistStamped"), got.append)
    for message in (TWIST(), STAMPED(), FLOAT(), FLOAT()):
        server.node.create_publisher("/mira/roll/cmd", type(message)).publish(message)
    assert [type(one) for one in got] == [TWIST, STAMPED]
    refused = [line for line in caplog.messages if "std_msgs/msg/Float64 are not taken" in line]
    assert len(refused) == 1


def test_a_closed_controller_hears_and_offers_nothing(server):
    ports = _ports(server)
    got: list[Any] = []
    ports.subscription("~/cmd", "std_msgs/Float64", got.append)
    ports.publisher("~/state", "std_msgs/Float64")
    ports.service("~/query", "std_srvs/Empty", lambda request, response: None)
    ports.close()
    ports.close()
    server.node.create_publisher("/mira/roll/cmd", FLOAT).publish(FLOAT())
    assert got == []
    assert "/mira/roll/state" not in server.node.topics
    assert "/mira/roll/query" not in server.node.services


def test_live_parameters_of_ros1_are_dynamic_reconfigure(server):
    ports, changes = _ports(server), []
    rows = [LiveParameter("p", "double", 1.0), LiveParameter("antiwindup", "bool", False)]
    live = ports.live_parameters("pid", rows, changes.append)
    kind = service_type("dynamic_reconfigure/Reconfigure")
    request = kind.Request()
    double = message_type("dynamic_reconfigure/DoubleParameter")
    request.config.doubles = [double(name="p", value=5.0)]
    response = server.node.call("/mira/roll/pid/set_parameters", request)
    assert response.config.doubles[0].value == 5.0
    assert changes == [{"p": 5.0, "antiwindup": False}]
    live.update({"p": 7.0})
    assert server.node.parameters.get("/mira/roll/pid/p") == 7.0


def test_live_parameters_of_ros2_are_the_nodes_parameters(server):
    ports, changes, sets = _ports(server, 2), [], []
    rows = [LiveParameter("p", "double", 1.0), LiveParameter("i", "double", 0.0)]
    ports.live_parameters("gains.joint_1", rows, changes.append)

    def on_set(values: dict[str, Any]) -> str:
        sets.append(values)
        return "no" if "joint" in values else ""

    ports.offer_parameters({"joint": "joint_1", "gains.joint_1.p": 1.0}, on_set)
    assert _set(server, "gains.joint_1.p", 4.0)
    assert changes == [{"p": 4.0, "i": 0.0}]
    assert sets == []
    assert not _set(server, "joint", "x")
    assert _set(server, "other", 2.0)


def _set(server: WorldServer, name: str, value: float | str) -> bool:
    kind = service_type("rcl_interfaces/SetParameters")
    parameter = message_type("rcl_interfaces/Parameter")(name=name)
    if isinstance(value, str):
        parameter.value.type, parameter.value.string_value = 4, value
    else:
        parameter.value.type, parameter.value.double_value = 3, value
    request = kind.Request(parameters=[parameter])
    response = server.node.call("/mira/roll/set_parameters", request)
    return bool(response.results[0].successful)


def test_an_action_is_found_by_name_until_its_controller_closes(server):
    ports, goals = _ports(server, 2), []
    ports.action_server(
        "~/follow_joint_trajectory",
        "control_msgs/FollowJointTrajectory",
        on_goal=goals.append,
        on_cancel=lambda goal: False,
    )
    name = "/mira/roll/follow_joint_trajectory"
    server.controls.action(name).submit({})
    assert len(goals) == 1
    with pytest.raises(NotFoundError, match="follow_joint_trajectory"):
        server.controls.action("/mira/roll/follow_joint_trajektory")
    ports.close()
    assert server.controls.actions == {}


def _manager(server: WorldServer, resources: Resources, ros_version: int) -> ControllerManager:
    interface_values = InterfaceValues()
    interface_values.freeze()
    robot = Robot(ros_version, Model("mira"), interface_values, (), {})
    manager = ControllerManager(
        robot,
        namespace="mira",
        make_ports=lambda name: make_ports(server, resources, "mira", name, ros_version),
        source=StoreSource(server.node.parameters, "mira"),
        diagnostics=Diagnostics(),
        update_rate_hz=100.0,
    )
    offer_manager(manager, server, resources)
    return manager


def test_a_ros1_manager_speaks_ros1s_layout(server):
    _manager(server, Resources(server), 1)
    kind = ros1_service_type("controller_manager_msgs/ListControllers")
    answer = server.node.call("/mira/controller_manager/list_controllers", kind._request_class())
    assert isinstance(answer, kind._response_class)
    assert answer.controller == []


def test_a_ros2_manager_takes_types_as_parameters_of_its_node(server):
    manager = _manager(server, Resources(server), 2)
    assert "/mira/controller_manager/configure_controller" in server.node.services
    kind = service_type("rcl_interfaces/SetParameters")
    parameter = message_type("rcl_interfaces/Parameter")(name="arm.type")
    parameter.value.type, parameter.value.string_value = 4, "some/Type"
    request = kind.Request(parameters=[parameter])
    server.node.call("/mira/controller_manager/set_parameters", request)
    assert manager.source.manager_tree()["arm"]["type"] == "some/Type"


def test_a_manager_goes_with_its_model(server):
    resources = Resources(server)
    manager = _manager(server, resources, 1)
    assert server.controls.manager() is manager
    assert server.controls.manager("mira") is manager
    with pytest.raises(NotFoundError, match="namespaces with a controller manager: /mira"):
        server.controls.manager("mirra")
    resources.close()
    with pytest.raises(NotFoundError, match="none; a robot has one when"):
        server.controls.manager()
    assert not [name for name in server.node.services if name.startswith("/mira")]
