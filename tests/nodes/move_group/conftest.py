"""move_group of the example arm, with controllers that go where they are told."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.nodes.conftest import Bench
from tests.nodes.move_group.fake_robot import FakeRobot
from tests.patience import stretched

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces import action_type, fill
from gazelle.workspace import Workspace

ARM_WS = Path(__file__).parents[3] / "examples" / "arm_ws"
JOINTS = [f"joint_{number}" for number in range(1, 7)]
READY = [0.0, -0.3, 1.9, 0.0, 1.5416, 0.0]


@cache
def parameters() -> dict[str, Any]:
    """What the arm's launch file gives to move_group."""
    source, diagnostics = ARM_WS / "src", Diagnostics()
    workspace = Workspace.discover(environ={}, extra=[ARM_WS])
    urdf = expand_xacro(
        source / "heron_description" / "urdf" / "heron.urdf.xacro",
        workspace=workspace,
        diagnostics=diagnostics,
    )
    assert urdf is not None
    meshes = f"file://{source / 'heron_description'}/"
    config = source / "heron_moveit_config" / "config"

    def read(name: str) -> Any:
        return yaml.safe_load((config / name).read_text(encoding="utf-8"))

    planning = {**read("joint_limits.yaml"), **read("pilz_cartesian_limits.yaml")}
    pilz = "pilz_industrial_motion_planner"
    return {
        "robot_description": urdf.text.replace("package://heron_description/", meshes),
        "robot_description_semantic": (config / "heron.srdf").read_text(encoding="utf-8"),
        "robot_description_kinematics": read("kinematics.yaml"),
        "robot_description_planning": planning,
        "planning_pipelines": ["ompl", pilz],
        "ompl": {"planning_plugin": "ompl_interface/OMPLPlanner"},
        pilz: {"planning_plugin": f"{pilz}/CommandPlanner"},
        **read("moveit_controllers.yaml"),
    }


class ArmBench:
    """A running move_group and what is needed to talk to it."""

    def __init__(self, bench: Bench, ros_version: int, folder: Path) -> None:
        self.bench = bench
        self.folder = folder
        self.ros_version = ros_version
        self.robot = FakeRobot(
            bench.node,
            dict(zip([*JOINTS, "finger_joint"], [*READY, 0.04], strict=True)),
            ros_version,
        )
        self._stop = threading.Event()
        self._pump = threading.Thread(target=self._publish, daemon=True)

    def start(self, **changes: Any) -> None:
        """Start move_group, some of its parameters changed."""
        values = {**parameters(), **changes}
        if self.ros_version == 2:
            file = self.folder / "parameters.yaml"
            file.write_text(yaml.safe_dump({"/move_group": {"ros__parameters": values}}), "utf-8")
            words = ("--ros-args", "--params-file", str(file))
            self.bench.start("moveit_ros_move_group/move_group", *words)
        else:
            own = {k: v for k, v in values.items() if not k.startswith("robot_description")}
            self.bench.node.parameters.set("/move_group", own)
            for key, value in values.items():
                if key not in own:
                    self.bench.node.parameters.set(f"/{key}", value)
            self.bench.start("moveit_ros_move_group/move_group")
        self._pump.start()
        name = "/move_action" if self.ros_version == 2 else "/move_group"
        self.mover = ActionClient(self.bench.node, name, action_type("moveit_msgs/MoveGroup"))
        assert self.mover.wait_for_server(stretched())

    def stop(self) -> None:
        """Stop the joint states."""
        self._stop.set()
        if self._pump.is_alive():
            self._pump.join()

    def move(self, *, plan_only: bool = False, **request: Any) -> Any:
        """Send a goal and return its result."""
        goal = self.send(plan_only=plan_only, **request)
        assert goal.wait(stretched())
        return goal.result

    def send(self, *, plan_only: bool = False, **request: Any) -> ClientGoal:
        """Send a goal with fields of a ``MotionPlanRequest``."""
        made: Any = action_type("moveit_msgs/MoveGroup").Goal()
        usual = {"group_name": "arm", "allowed_planning_time": 5.0, "num_planning_attempts": 1}
        fill(made.request, {**usual, **request})
        made.planning_options.plan_only = plan_only
        return self.mover.send_goal(made)

    def call(self, name: str, kind: str, **fields: Any) -> Any:
        """Call a service with fields as mappings."""
        from gazelle.interfaces import service_type

        service = service_type(f"moveit_msgs/{kind}")
        client = self.bench.node.create_client(f"/{name}", service)
        assert client.wait_for_service(stretched()), name
        request = service.Request()
        fill(request, fields)
        return client.call(request, timeout_s=stretched())

    def add_box(self, name: str, size: list[float], at: list[float]) -> None:
        """Put a box into the scene."""
        box = box_object(name, size, at)
        answer = self.call(
            "apply_planning_scene",
            "ApplyPlanningScene",
            scene={"is_diff": True, "world": {"collision_objects": [box]}},
        )
        assert answer.success

    def _publish(self) -> None:
        while not self._stop.wait(0.02):
            self.robot.publish()


def box_object(name: str, size: list[float], at: list[float]) -> dict[str, Any]:
    """Return a ``CollisionObject`` as a mapping."""
    return {
        "id": name,
        "primitives": [{"type": 1, "dimensions": size}],
        "primitive_poses": [pose(*at)],
    }


def pose(
    x: float, y: float, z: float, quat: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
) -> dict[str, Any]:
    """Return a ``Pose`` as a mapping."""
    return {
        "position": {"x": x, "y": y, "z": z},
        "orientation": dict(zip("xyzw", quat, strict=True)),
    }


def joint_goal(values: list[float], tolerance: float = 1e-4) -> list[dict[str, Any]]:
    """Return ``goal_constraints`` that ask for a position of every joint."""
    rows = [
        {"joint_name": name, "position": value, "tolerance_above": tolerance,
         "tolerance_below": tolerance, "weight": 1.0}
        for name, value in zip(JOINTS, values, strict=True)
    ]  # fmt: skip
    return [{"joint_constraints": rows}]


def pose_goal(
    x: float, y: float, z: float, *, link: str = "tool_link", frame: str = "world"
) -> list[dict[str, Any]]:
    """Return ``goal_constraints`` that ask for the tool to point down at a place."""
    header = {"frame_id": frame}
    region = {"primitives": [{"type": 2, "dimensions": [1e-3]}], "primitive_poses": [pose(x, y, z)]}
    place = {"header": header, "link_name": link, "constraint_region": region, "weight": 1.0}
    turn = {
        "header": header, "link_name": link,
        "orientation": {"x": 0.0, "y": 1.0, "z": 0.0, "w": 0.0},
        "absolute_x_axis_tolerance": 1e-2, "absolute_y_axis_tolerance": 1e-2,
        "absolute_z_axis_tolerance": 1e-2, "weight": 1.0,
    }  # fmt: skip
    return [{"position_constraints": [place], "orientation_constraints": [turn]}]


@pytest.fixture
def make_arm(bench: Bench, tmp_path: Path) -> Iterator[Callable[..., ArmBench]]:
    made: list[ArmBench] = []

    def make(ros_version: int = 2, **changes: Any) -> ArmBench:
        one = ArmBench(bench, ros_version, tmp_path)
        made.append(one)
        one.robot.follow("arm_controller")
        one.start(**changes)
        return one

    yield make
    for one in made:
        one.stop()


@pytest.fixture
def arm(make_arm: Callable[..., ArmBench]) -> ArmBench:
    return make_arm()
