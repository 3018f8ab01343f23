"""What is proposed for LUCK's arm beside what its document has, pair by pair."""

from __future__ import annotations

from pathlib import Path

from tests.shared_files import needs_shared

from gazelle.description.moveit import read_moveit_config
from gazelle.diagnostics import Diagnostics
from gazelle.motion.setup_assistant import propose, read_robot
from gazelle.workspace import Workspace


@needs_shared
def test_lucks_own_pairs_chain_and_joints_are_found_and_three_pairs_more_that_never_meet(
    workspaces_dir: Path,
) -> None:
    source_folder = workspaces_dir / "ros2_ws" / "src"
    own = read_moveit_config(source_folder / "luck_robot", diagnostics=Diagnostics())
    assert own is not None
    file = source_folder / "luck_description" / "urdf" / "luck_description.urdf"
    workspace = Workspace.discover(environ={}, extra=[source_folder])
    source, robot = read_robot(file, workspace=workspace, diagnostics=Diagnostics())
    made = propose(robot, source, diagnostics=Diagnostics())

    ours = {(pair.link1, pair.link2): pair.reason for pair in made.srdf.disabled_pairs}
    theirs = {(pair.link1, pair.link2): pair.reason for pair in own.srdf.disabled_pairs}
    assert len(theirs) == 6
    assert theirs.items() <= ours.items()
    assert {pair: ours[pair] for pair in ours.keys() - theirs.keys()} == {
        ("base_link", "link_2"): "Never",
        ("base_link", "link_4"): "Never",
        ("link_4", "link_6"): "Never",
    }
    # The document calls its group test_group.
    assert [group.chains for group in made.srdf.groups] == [
        group.chains for group in own.srdf.groups
    ]
    assert [(one.type, one.action_ns, one.joints) for one in made.controllers] == [
        (one.type, one.action_ns, one.joints) for one in own.controllers
    ]
    assert made.kinematics["arm"].solver == own.kinematics["test_group"].solver
    assert made.initial_positions == dict.fromkeys(made.controllers[0].joints, 0.0)
