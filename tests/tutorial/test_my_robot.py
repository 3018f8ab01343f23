"""The SDF model built step by step, inserted and pushed (T16)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.tutorial

_EFFORT = "gazebo_msgs/srv/ApplyJointEffort"
_DELETE = "gazebo_msgs/srv/DeleteModel"


@pytest.fixture(scope="module")
def world(module_in_workspace: Callable) -> Any:
    """An empty world that runs as fast as it can."""
    return module_in_workspace("roslaunch", "gazebo_ros", "empty_world.launch", "--fast")


def test_stages_load_in_a_running_world_and_empty_ones_say_why(
    world: Any, workspaces_dir: Path
) -> None:
    for stage in range(1, 8):
        file = workspaces_dir / f"gazebo_models/stages/my_robot_{stage}.sdf"
        answer = world.call(
            "/gazebo/spawn_sdf_model",
            "gazebo_msgs/srv/SpawnModel",
            model_name=f"stage_{stage}",
            model_xml=file.read_text(encoding="utf-8"),
            initial_pose={"position": {"y": 2.0 * stage}},
        )
        assert answer.success == (stage > 2), answer.status_message
        if not answer.success:
            assert "model 'my_robot' has no link" in answer.status_message
    # Their joints have the names of the model's that the other test pushes.
    for stage in range(3, 8):
        name = f"stage_{stage}"
        assert world.call("/gazebo/delete_model", _DELETE, model_name=name).success


def test_my_robot_is_inserted_by_name_and_rolls_when_pushed(
    world: Any, module_in_workspace: Callable
) -> None:
    spawner = module_in_workspace(
        "rosrun", "gazebo_ros", "spawn_model", "-database", "my_robot", "-sdf", "-model", "my_robot"
    )
    assert spawner.wait() == 0, spawner.text
    assert "Spawn status: SpawnModel: Successfully spawned entity" in spawner.text
    for joint in ("left_wheel_hinge", "right_wheel_hinge"):
        pushed = world.call(
            "/gazebo/apply_joint_effort", _EFFORT, joint_name=joint, effort=0.1, duration={"sec": 2}
        )
        assert pushed.success, pushed.status_message

    def speed() -> float:
        state = world.call(
            "/gazebo/get_model_state", "gazebo_msgs/srv/GetModelState", model_name="my_robot"
        )
        return float(state.twist.linear.x)

    # Analytic: a = 2·0.1/0.1/(3 + 2·1/0.1²) m/s² for two seconds, then it coasts.
    world.eventually(lambda: speed() == pytest.approx(0.0197, rel=0.05))
    assert world.call("/gazebo/delete_model", _DELETE, model_name="my_robot").success
