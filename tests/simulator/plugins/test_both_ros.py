"""What plug-ins of both versions of ROS are called: what started the simulator decides."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import pytest

from gazelle.description.loader import load_models, load_world
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.dry_start.plan import DryNode
from gazelle.simulator.plugins.registry import all_tables
from gazelle.simulator.world_server import ServerSettings, WorldServer

SENSORS = {
    "camera": "<camera><image><width>8</width><height>6</height></image></camera>",
    "depth": "<camera><image><width>8</width><height>6</height></image></camera>",
    "imu": "",
    "contact": "<contact><collision>c</collision></contact>",
}
# Keys of both, as nobody writes them together: each plug-in reads its own.
R1, R2 = "<robotNamespace>one</robotNamespace>", "<ros><namespace>two</namespace></ros>"
WHEELS = "<leftJoint>l</leftJoint><rightJoint>r</rightJoint>"
WHEELS += "<left_joint>l</left_joint><right_joint>r</right_joint>"
TRICYCLE = "".join(
    f"<{key}>{joint}</{key}>"
    for joint, keys in (
        ("l", "steeringJoint actuatedWheelJoint steering_joint actuated_wheel_joint"),
        ("r", "encoderWheelLeftJoint encoderWheelRightJoint"),
        ("r", "encoder_wheel_left_joint encoder_wheel_right_joint"),
    )
    for key in keys.split()
)
BODY = "<bodyName>base</bodyName><body_name>base</body_name><link_name>base</link_name>"
TOPIC = "<topicName>mine</topicName>"
ODOM = "<commandTopic>go</commandTopic><odometryTopic>where</odometryTopic>"
SLIP = '<wheel link_name="left"><slip_compliance_lateral>1</slip_compliance_lateral>'
SLIP += "<slip_compliance_longitudinal>1</slip_compliance_longitudinal>"
SLIP += "<wheel_normal_force>10</wheel_normal_force></wheel>"


class Row(NamedTuple):
    """A plug-in and its names under ROS 1, then under ROS 2."""

    family: str
    library: str
    sensor: str
    keys: str
    ros1: str
    ros2: str


ROWS = (
    Row("camera", "camera", "camera", "", "/image_raw /camera_info", "/s/image_raw /s/camera_info"),
    Row("camera", "camera", "camera", R1 + R2 + "<cameraName>a</cameraName>"
        "<camera_name>b</camera_name><imageTopicName>rgb</imageTopicName>",
        "/one/a/rgb /one/a/rgb/compressed /one/a/camera_info /one/a/parameter_updates",
        "/two/b/image_raw /two/b/image_raw/compressed /two/b/camera_info"),
    Row("camera", "camera", "depth", "<camera_name>b</camera_name>",
        "/image_raw /camera_info", "/b/points /b/depth/image_raw /b/depth/camera_info"),
    Row("imu_sensor", "imu_sensor", "imu", R1 + R2 + TOPIC, "/one/mine", "/two/p/out"),
    Row("imu_sensor", "imu_sensor", "imu", "", "/imu_data", "/p/out"),
    Row("bumper", "bumper", "contact", R1 + R2 + "<bumperTopicName>touch</bumperTopicName>",
        "/one/touch", "/two/bumper_states"),
    Row("diff_drive", "diff_drive", "", R1 + R2 + WHEELS + ODOM
        + "<publish_odom>1</publish_odom>", "/one/go /one/where", "/two/cmd_vel /two/odom"),
    Row("planar_move", "planar_move", "", R1 + R2 + ODOM, "/one/go /one/where",
        "/two/cmd_vel /two/odom"),
    Row("tricycle_drive", "tricycle_drive", "", R1 + R2 + TRICYCLE + ODOM
        + "<publish_odom>1</publish_odom>", "/one/go /one/where", "/two/cmd_vel /two/odom"),
    Row("joint_state_publisher", "joint_state_publisher", "", R1 + R2, "/one/joint_states",
        "/two/joint_states"),
    Row("p3d", "p3d", "", R1 + R2 + BODY + TOPIC, "/one/mine", "/two/odom"),
    Row("force", "force", "", R1 + R2 + BODY + TOPIC, "/one/mine", "/two/gazebo_ros_force"),
    Row("ft_sensor", "ft_sensor", "", R1 + R2 + "<jointName>l</jointName>"
        "<joint_name>l</joint_name>" + TOPIC, "/one/mine", "/two/wrench"),
    Row("vacuum_gripper", "vacuum_gripper", "", R1 + R2 + BODY + TOPIC,
        "/one/mine /one/on /one/off", "/two/grasping /two/switch"),
    Row("joint_pose_trajectory", "joint_pose_trajectory", "", R1 + R2 + TOPIC
        + "<serviceName>serve</serviceName>", "/one/mine /one/serve", "/two/set_joint_trajectory"),
    Row("hand_of_god", "hand_of_god", "", "<linkName>base</linkName>" + BODY, "/tf", "/tf"),
    Row("wheel_slip", "wheel_slip", "", R1 + R2 + SLIP,
        "/m/one/set_parameters /m/one/parameter_updates", "/two/wheel_slip /two/p/set_parameters"),
)  # fmt: skip


def model(row: Row) -> str:
    plugin = f'<plugin name="p" filename="libgazebo_ros_{row.library}.so">{row.keys}</plugin>'
    inside = outside = ""
    if row.sensor:
        inside = f'<sensor name="s" type="{row.sensor}">{SENSORS[row.sensor]}{plugin}</sensor>'
    else:
        outside = plugin
    shape = "<geometry><cylinder><radius>.1</radius><length>.1</length></cylinder></geometry>"
    wheels = "".join(
        f'<link name="{name}"><pose>0 {y} 0.1 0 0 0</pose><collision name="c">{shape}</collision>'
        f'</link><joint name="{name[0]}" type="revolute"><parent>base</parent><child>{name}'
        "</child><axis><xyz>0 0 1</xyz></axis></joint>"
        for name, y in (("left", 0.2), ("right", -0.2))
    )
    base = f'<link name="base"><collision name="c">{shape}</collision>{inside}</link>'
    return f'<sdf version="1.6"><model name="m">{base}{wheels}{outside}</model></sdf>'


def names(row: Row, ros_version: int, namespace: str = "") -> tuple[set[str], Diagnostics]:
    """Return all topics and services of a plug-in, and what was said."""
    found, node = Diagnostics(), DryNode()
    world = load_world('<sdf version="1.6"><world name="w"/></sdf>', workspace=None,
                       diagnostics=found)  # fmt: skip
    settings = ServerSettings(ros_version=ros_version)
    server = WorldServer(world, node=node, diagnostics=found, settings=settings)
    try:
        (made,) = load_models(model(row), workspace=None, diagnostics=found)
        server.spawn(made, namespace=namespace)
        return {*node.offered, *node.heard, *node.services}, found
    finally:
        server.close()


@pytest.mark.parametrize("ros_version", [1, 2])
@pytest.mark.parametrize("row", ROWS, ids=[f"{row.family}-{n}" for n, row in enumerate(ROWS)])
def test_the_start_decides_what_a_plug_in_is_called(row: Row, ros_version: int) -> None:
    wanted = set((row.ros1 if ros_version == 1 else row.ros2).split())
    others = set((row.ros2 if ros_version == 1 else row.ros1).split()) - wanted
    found, _ = names(row, ros_version)
    assert wanted <= found
    assert not others & found


def test_every_plug_in_of_both_is_in_the_table() -> None:
    both = {table.parameters.family for table in all_tables() if table.in_both_ros}
    assert both == {row.family for row in ROWS}


@pytest.mark.parametrize("row", ROWS, ids=[f"{row.family}-{n}" for n, row in enumerate(ROWS)])
def test_nothing_of_dynamic_reconfigure_is_in_ros2(row: Row) -> None:
    found, _ = names(row, 2)
    assert not [name for name in found if name.endswith(("_descriptions", "_updates"))]


def test_without_a_start_the_ros_tag_decides() -> None:
    row = ROWS[0]
    assert "/image_raw" in names(row, 0)[0]
    assert "/s/image_raw" in names(row._replace(keys="<ros/>"), 0)[0]


@pytest.mark.parametrize(
    ("ros_version", "text"),
    [
        (1, "<camera_name> (of ROS 2, ROS 1 reads <cameraName>)"),
        (1, "<ros> (of ROS 2)"),
        (2, "<cameraName> (of ROS 1, ROS 2 reads <camera_name>)"),
        (2, "<imageTopicName> (of ROS 1)"),
    ],
)
def test_keys_of_the_other_version_are_told(ros_version: int, text: str) -> None:
    _, found = names(ROWS[1], ros_version)
    (idle,) = found.by_code("parameter.idle")
    assert text in idle.message


def test_a_drive_of_ros2_publishes_no_odometry_unless_it_is_asked_to() -> None:
    row = next(row for row in ROWS if row.family == "diff_drive")._replace(keys=WHEELS)
    assert "/odom" in names(row, 1)[0]
    found, _ = names(row, 2)
    assert "/cmd_vel" in found
    assert not {"/odom", "/tf"} & found


@pytest.fixture(params=["camera", "imu_sensor", "joint_state_publisher"])
def namespaced(request: pytest.FixtureRequest) -> Iterator[Row]:
    yield next(row for row in ROWS if row.family == request.param and R1 in row.keys)


def test_where_a_robot_is_spawned_goes_before_its_own_namespace_in_ros2(namespaced: Row) -> None:
    found, _ = names(namespaced, 2, "/robot_7")
    moved = {name.replace("/two/", "/robot_7/") for name in namespaced.ros2.split()}
    assert moved <= found
    assert not {name for name in found if name.startswith("/two/")}


def test_where_a_robot_is_spawned_leaves_its_own_namespace_in_ros1(namespaced: Row) -> None:
    found, _ = names(namespaced, 1, "/robot_7")
    assert set(namespaced.ros1.split()) <= found
    bare, _ = names(namespaced._replace(keys=namespaced.keys.replace(R1, "")), 1, "/robot_7")
    moved = {name.replace("/one/", "/robot_7/") for name in namespaced.ros1.split()}
    assert moved <= bare
