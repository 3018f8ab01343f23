"""MIRA's own launch file: paused world, play, droop, another head (M4, M5, M7)."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.loader import load_models
from gazelle.description.model import MeshShape
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import load_mesh
from gazelle.workspace import Workspace

pytestmark = pytest.mark.tutorial

_LAUNCH = ("roslaunch", "urdf_exam", "mira_spawn.launch")
_PITCH_LIMIT_RAD, _ROLL_LIMIT_RAD = 0.44, -0.2
_SERVICES = (
    "apply_body_wrench", "apply_joint_effort", "clear_body_wrenches", "clear_joint_forces",
    "delete_light", "delete_model", "get_joint_properties", "get_light_properties",
    "get_link_properties", "get_link_state", "get_model_properties", "get_model_state",
    "get_physics_properties", "get_world_properties", "pause_physics", "reset_simulation",
    "reset_world", "set_joint_properties", "set_light_properties", "set_link_properties",
    "set_link_state", "set_model_configuration", "set_model_state", "set_physics_properties",
    "spawn_sdf_model", "spawn_urdf_model", "unpause_physics",
)  # fmt: skip


def test_mira_is_spawned_into_a_paused_world_and_droops_when_played(in_workspace: Callable) -> None:
    mira = in_workspace(*_LAUNCH, "--fast")
    mira.wait_for_line(r"Loading model XML from ros parameter robot_description")
    mira.wait_for_line(r"Calling service /gazebo/spawn_urdf_model")
    mira.wait_for_line(r"Spawn status: SpawnModel: Successfully spawned entity")

    topics = dict(mira.graph.topic_names_and_types())
    assert topics["/clock"] == "rosgraph_msgs/msg/Clock"
    assert {"/gazebo/link_states", "/gazebo/model_states"} <= set(topics)
    offered = {service.name for service in mira.graph.services()}
    assert {f"/gazebo/{name}" for name in _SERVICES} <= offered
    world = mira.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert world.sim_time == 0.0
    assert world.model_names == ["ground_plane", "mira"]
    assert _height(mira) == pytest.approx(0.2)

    mira.call("/gazebo/unpause_physics", "std_srvs/srv/Empty")
    mira.eventually(lambda: _sim_time(mira) > 3.0)
    mira.call("/gazebo/pause_physics", "std_srvs/srv/Empty")
    assert _height(mira) == pytest.approx(0.045, abs=0.001)
    assert _position(mira, "pitch_joint") == pytest.approx(_PITCH_LIMIT_RAD, abs=0.01)
    assert _position(mira, "roll_joint") == pytest.approx(_ROLL_LIMIT_RAD, abs=0.01)


def test_another_head_is_seen_after_editing_the_urdf(
    gazelle: Callable, workspaces_dir: Path, tmp_path: Path
) -> None:
    package = tmp_path / "src" / "urdf_exam"
    shutil.copytree(workspaces_dir / "catkin_ws/src/urdf_exam", package)
    urdf = package / "urdf" / "mira_gazebo.urdf"
    # The document's package came read-only here.
    for path in (urdf, urdf.parent):
        path.chmod(0o755)
    text = urdf.read_text(encoding="utf-8")
    assert "mira_head_v5.dae" in text
    urdf.write_text(text.replace("mira_head_v5.dae", "cromulon.dae"), encoding="utf-8")

    mira = gazelle(*_LAUNCH, cwd=tmp_path)
    mira.wait_for_line(r"Spawn status: SpawnModel: Successfully spawned entity")
    assert "warning" not in mira.text
    workspace, diagnostics = Workspace.discover(environ={}, cwd=tmp_path), Diagnostics()
    (model,) = load_models(urdf, workspace=workspace, diagnostics=diagnostics)
    shapes = [visual.shape for link in model.links for visual in link.visuals]
    files = [shape.path for shape in shapes if isinstance(shape, MeshShape) and shape.path]
    heads = [path for path in files if path.name == "cromulon.dae"]
    assert heads and all(path.is_relative_to(package) for path in heads)
    assert len(load_mesh(heads[0]).faces) > 1000


def _sim_time(launched: object) -> float:
    state = launched.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")  # type: ignore[attr-defined]
    return float(state.sim_time)


def _height(launched: object) -> float:
    state = launched.call(  # type: ignore[attr-defined]
        "/gazebo/get_model_state", "gazebo_msgs/srv/GetModelState", model_name="mira"
    )
    assert state.success
    return float(state.pose.position.z)


def _position(launched: object, joint: str) -> float:
    found = launched.call(  # type: ignore[attr-defined]
        "/gazebo/get_joint_properties", "gazebo_msgs/srv/GetJointProperties", joint_name=joint
    )
    assert found.success
    return float(found.position[0])
