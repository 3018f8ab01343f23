"""The Setup Assistant's methods: a robot loaded, changed part by part, and written."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.motion.setup_assistant.robots import chain, link
from tests.studio.page import Page, RefusedError

from gazelle.graph import Graph
from gazelle.studio import Server, Studio

_ARM_WS = Path(__file__).parents[3] / "examples" / "arm_ws"
_ROBOT = f'<robot name="picker">{link("base")}{chain("", "base", 4)}</robot>'


@pytest.fixture
def server(graph: Graph, tmp_path: Path) -> Iterator[Server]:
    """A server whose pages may write below the test's folder."""
    (tmp_path / "picker.urdf").write_text(_ROBOT, encoding="utf-8")
    with Server(Studio(graph, tmp_path), port=0) as made:
        yield made


@pytest.fixture
def loaded(page: Page) -> dict[str, Any]:
    """What the page is told of the robot."""
    found: dict[str, Any] = page.call("setup_assistant.load", file="picker.urdf")
    return found


def _edit(page: Page, loaded: dict[str, Any], part: str, value: Any) -> dict[str, Any]:
    found: dict[str, Any] = page.call(
        "setup_assistant.edit", session=loaded["session"], part=part, value=value
    )
    return found


def test_a_robot_brings_its_proposal_and_every_pair_of_links(
    loaded: dict[str, Any], tmp_path: Path
) -> None:
    assert loaded["folder"] == str(tmp_path / "picker_moveit_config")
    assert [group["name"] for group in loaded["groups"]] == ["arm"]
    assert len(loaded["pairs"]) == 10
    reasons = [pair["reason"] for pair in loaded["pairs"]]
    assert reasons.count("Adjacent") == 4
    assert "Never" not in reasons
    assert [row["name"] for row in loaded["links"]][:2] == ["base", "link_1"]
    assert loaded["robot"]["groups"][0]["variables"] == [f"joint_{n}" for n in range(1, 5)]
    assert loaded["interfaces"][0] == {"joint": "joint_1", "kinds": ["position"], "is_added": True}


def test_pairs_are_found_and_those_chosen_by_hand_stay(page: Page, loaded: dict[str, Any]) -> None:
    mine = {"link1": "base", "link2": "link_4", "reason": "User"}
    rows = [pair for pair in loaded["pairs"] if pair["reason"]]
    _edit(page, loaded, "pairs", [*rows, mine])
    found = page.call("setup_assistant.find_pairs", session=loaded["session"], trials=60)
    reasons = {(one["link1"], one["link2"]): one["reason"] for one in found["pairs"]}
    assert reasons["base", "link_1"] == "Adjacent"
    assert reasons["base", "link_4"] in ("User", "Never")
    assert found["trials"] == 60
    assert page.call("setup_assistant.progress", session=loaded["session"]) == 1.0


def test_groups_that_stay_keep_their_poses_and_a_new_one_gets_its_own(
    page: Page, loaded: dict[str, Any]
) -> None:
    states = [{"name": "up", "group": "arm", "values": {"joint_1": 0.5}}]
    _edit(page, loaded, "states", states)
    wrist = {"name": "wrist", "chains": [{"base_link": "link_2", "tip_link": "link_4"}]}
    wrist |= {"links": [], "joints": [], "subgroups": [], "solver": ""}
    after = _edit(page, loaded, "groups", [*loaded["groups"], wrist])
    poses = [(state["group"], state["name"]) for state in after["states"]]
    assert poses == [("arm", "up"), ("wrist", "home")]
    assert after["groups"][1]["solver"] == "kdl_kinematics_plugin/KDLKinematicsPlugin"
    assert [one["name"] for one in after["controllers"]] == ["arm_controller"]


@pytest.mark.parametrize(
    ("part", "value", "message"),
    [
        ("colour", 1, "there is no part 'colour' of a config package"),
        ("pairs", [{"link1": "base", "link2": "x"}], "there is no link2 'x'"),
        ("groups", [{"name": ""}], "groups: 'name' is empty"),
        ("groups", [{"name": "a"}, {"name": "a"}], "two groups have the same name"),
        ("states", [{"name": "a", "group": "arm", "values": {"q": 1}}], "has no joint 'q'"),
        ("virtual_joints", [{"name": "v", "type": "loose"}], "there is no type 'loose'"),
        ("passive_joints", ["q"], "'q' is none of the joints there are"),
        ("package_name", "Bad Name", "'Bad Name' is no name for a package"),
        ("controllers", 3, "controllers: a list is needed"),
    ],
)
def test_what_cannot_be_is_refused_and_changes_nothing(
    page: Page, loaded: dict[str, Any], part: str, value: Any, message: str
) -> None:
    with pytest.raises(RefusedError, match=message):
        _edit(page, loaded, part, value)
    same = {"name": loaded["author_name"], "email": loaded["author_email"]}
    assert _edit(page, loaded, "author", same) == loaded


def test_every_part_is_taken(page: Page, loaded: dict[str, Any]) -> None:
    held = {"name": "v", "type": "planar", "parent_frame": "odom", "child_link": "base"}
    after = _edit(page, loaded, "virtual_joints", [held])
    assert after["virtual_joints"] == [held]
    rows = [{**row, "kinds": ["effort"]} for row in loaded["interfaces"]]
    after = _edit(page, loaded, "interfaces", rows)
    assert {tuple(row["kinds"]) for row in after["interfaces"]} == {("effort",)}
    controller = {**loaded["controllers"][0], "joints": ["joint_1", "joint_2"]}
    after = _edit(page, loaded, "controllers", [controller])
    assert after["controllers"] == [controller]
    after = _edit(page, loaded, "passive_joints", ["joint_4"])
    assert after["passive_joints"] == ["joint_4"]
    hand = {"name": "h", "group": "arm", "parent_link": "base", "parent_group": ""}
    assert _edit(page, loaded, "end_effectors", [hand])["end_effectors"] == [hand]
    after = _edit(page, loaded, "package_name", "other_config")
    assert after["folder"].endswith("/other_config")


def test_it_is_written_once_and_then_only_what_changed(
    page: Page, loaded: dict[str, Any], tmp_path: Path
) -> None:
    session = loaded["session"]
    planned = page.call("setup_assistant.files", session=session)
    assert {one["state"] for one in planned} == {"new"}
    result = page.call("setup_assistant.write", session=session)
    assert sorted(result["written"]) == sorted(one["path"] for one in planned)
    assert result["next"][0] == "plan with it:   gazelle roslaunch picker_moveit_config demo.launch"
    file = tmp_path / "picker_moveit_config" / "launch" / "demo.launch"
    file.write_text("<launch/>", encoding="utf-8")
    states = {
        one["path"]: one["state"] for one in page.call("setup_assistant.files", session=session)
    }
    assert states["launch/demo.launch"] == "edited"
    result = page.call("setup_assistant.write", session=session)
    assert (result["written"], result["kept"]) == ([], ["launch/demo.launch"])
    result = page.call("setup_assistant.write", session=session, overwrite=["launch/demo.launch"])
    assert "launch/demo.launch" in result["written"]

    again = page.call("setup_assistant.start")
    assert again["packages"] == ["picker_moveit_config"]
    opened = page.call("setup_assistant.load", package="picker_moveit_config")
    assert opened["groups"] == loaded["groups"]


def test_robots_of_the_workspaces_packages_are_offered(page: Page, tmp_path: Path) -> None:
    shutil.copytree(_ARM_WS / "src", tmp_path / "src")
    found = page.call("setup_assistant.start")
    assert found["robots"] == ["package://heron_description/urdf/heron.urdf.xacro"]
    assert found["packages"] == ["heron_moveit_config"]
    assert found["folder"] == str(tmp_path / "src")
    loaded = page.call("setup_assistant.load", file=found["robots"][0])
    assert loaded["ros_version"] == 2


def test_files_elsewhere_are_neither_read_nor_written(page: Page, tmp_path_factory: Any) -> None:
    outside = tmp_path_factory.mktemp("outside") / "other.urdf"
    outside.write_text(_ROBOT, encoding="utf-8")
    with pytest.raises(RefusedError, match=r"is neither below .* nor in a package"):
        page.call("setup_assistant.load", file=str(outside))
    with pytest.raises(RefusedError, match="there is no file"):
        page.call("setup_assistant.load", file="nothing.urdf")
    with pytest.raises(RefusedError, match="this session of the Setup Assistant has ended"):
        page.call("setup_assistant.files", session=99)
