"""Small worlds, and the documents' robots where they are present."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import ROS2_PLUGINS, offer_gazebo_ros
from gazelle.workspace import Workspace

DIFF_ROBOT = """<robot name="cart">
  <link name="base_footprint"/>
  <joint name="base_joint" type="fixed"><origin xyz="0 0 0.1"/>
    <parent link="base_footprint"/><child link="base_link"/></joint>
  <link name="base_link">
    <inertial><mass value="8"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.15"/>
    </inertial>
    <collision><origin xyz="0 0 0.02"/><geometry><box size="0.4 0.2 0.08"/></geometry></collision>
    <visual><origin xyz="0 0 0.02"/><geometry><box size="0.4 0.2 0.08"/></geometry></visual>
  </link>
  {wheels}
  <link name="caster"><inertial><mass value="0.2"/>
    <inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial>
    <collision><geometry><sphere radius="0.04"/></geometry></collision></link>
  <joint name="caster_joint" type="fixed"><origin xyz="-0.15 0 -0.06"/>
    <parent link="base_link"/><child link="caster"/></joint>
  <gazebo reference="caster"><mu1>0</mu1><mu2>0</mu2></gazebo>
  <gazebo reference="base_link">
    <sensor name="scanner" type="ray"><update_rate>10</update_rate><pose>0 0 0.2 0 0 0</pose>
      <ray><scan><horizontal><samples>9</samples><min_angle>-0.6</min_angle>
        <max_angle>0.6</max_angle></horizontal></scan>
        <range><min>0.05</min><max>10</max></range></ray>
      <plugin name="laser" filename="libgazebo_ros_laser.so">
        <topicName>scan</topicName><frameName>laser</frameName></plugin>
    </sensor>
  </gazebo>
  <gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">{drive}</plugin></gazebo>
  {extra}
</robot>"""

WHEEL = """<link name="{side}_wheel"><inertial><mass value="0.5"/>
    <inertia ixx="8e-4" ixy="0" ixz="0" iyy="8e-4" iyz="0" izz="1.5e-3"/></inertial>
    <collision><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision></link>
  <joint name="{side}_joint" type="continuous">
    <origin xyz="0.1 {y} 0" rpy="-1.5707963267948966 0 0"/>
    <parent link="base_link"/><child link="{side}_wheel"/><axis xyz="0 0 {axis}"/></joint>"""

DRIVE = """<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>
  <wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.2</wheelDiameter>
  <wheelTorque>10</wheelTorque><updateRate>100</updateRate><legacyMode>false</legacyMode>
  <publishWheelTF>true</publishWheelTF><publishWheelJointState>true</publishWheelJointState>"""


@pytest.fixture
def cart_urdf() -> Callable[..., str]:
    """A robot of plain cylinders whose parameters are its geometry's, unless told otherwise."""

    def build(drive: str = DRIVE, extra: str = "", axis: int = 1) -> str:
        wheels = WHEEL.format(side="left", y=0.15, axis=axis)
        wheels += WHEEL.format(side="right", y=-0.15, axis=axis)
        return DIFF_ROBOT.format(wheels=wheels, drive=drive, extra=extra)

    return build


@pytest.fixture
def drive_keys() -> str:
    return DRIVE


@pytest.fixture(scope="session")
def bare_workspace() -> Workspace:
    """Built-in packages only."""
    return Workspace.discover(environ={}, cwd=Path("/"))


@pytest.fixture
def load(bare_workspace: Workspace) -> Iterator[Callable[..., Simulation]]:
    """Loads simulations that are closed after the test."""
    opened: list[Simulation] = []

    def load_one(source: Any = None, **options: Any) -> Simulation:
        options.setdefault("workspace", bare_workspace)
        services = options.pop("services", False)
        opened.append(Simulation.load(source, **options))
        if services:
            offer_gazebo_ros(opened[-1].server, ros2=ROS2_PLUGINS)
        return opened[-1]

    yield load_one
    for sim in opened:
        sim.close()


@pytest.fixture(scope="session")
def documents(workspaces_dir: Path) -> Workspace:
    """The documents' own packages and models, unmodified."""
    environ = {
        "ROS_PACKAGE_PATH": str(workspaces_dir / "catkin_ws" / "src"),
        "GAZEBO_MODEL_PATH": str(workspaces_dir / "gazebo_models"),
    }
    return Workspace.discover(environ=environ, cwd=Path("/"))


@pytest.fixture
def slambot(load: Callable[..., Simulation], documents: Workspace) -> Callable[..., Simulation]:
    """SLAMBOT in its world, as its launch file brings it up."""
    robot = documents.package("slam_robot").path

    def bring_up(**options: Any) -> Simulation:
        return load(
            robot / "urdf" / "slam_robot_gazebo.urdf",
            world=robot / "worlds" / "slam_robot_world.world",
            name="slam_robot",
            workspace=documents,
            services=True,
            **options,
        )

    return bring_up


@pytest.fixture
def listen() -> Callable[[Simulation, str], list[Any]]:
    """Collects the messages of a topic."""

    def start(sim: Simulation, topic: str) -> list[Any]:
        messages: list[Any] = []
        sim.subscribe(topic, messages.append)
        return messages

    return start


@pytest.fixture
def yaw_of() -> Callable[[Pose], float]:
    return lambda pose: pose.rpy_rad[2]


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of its own on a free port."""
    with Graph.open(port=free_port, environ={}) as opened:
        yield opened
