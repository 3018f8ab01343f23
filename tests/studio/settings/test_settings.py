"""Files that keep what people look at."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.studio.errors import StudioError
from gazelle.studio.protocol import METHODS
from gazelle.studio.request_params import Params
from gazelle.studio.settings.rqt_perspectives import perspective_value
from gazelle.studio.settings.rviz_files import rviz_value

_ROS1 = """
Visualization Manager:
  Class: ""
  Displays:
    - {Class: rviz/LaserScan, Name: Laser, Enabled: true, Topic: /scan, Size (m): 0.03}
    - Class: rviz/Group
      Name: Sensors
      Enabled: false
      Displays:
        - {Class: rviz/Image, Name: Camera, Enabled: true, Image Topic: camera/image_raw}
    - {Class: rviz/RobotModel, Name: Robot, Enabled: true, Robot Description: robot_description}
  Global Options: {Fixed Frame: odom, Background Color: 48; 48; 48}
  Tools: [{Class: rviz/MoveCamera}, {Class: rviz/SetGoal, Topic: /move_base_simple/goal}]
  Views:
    Current:
      {Class: rviz/Orbit, Distance: 3.5, Pitch: 0.4, Yaw: 1.2, Focal Point: {X: 1, Y: 2, Z: 0}}
"""
_ROS2 = """
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/LaserScan
      Name: LaserScan
      Enabled: true
      Topic: {Depth: 5, Reliability Policy: Best Effort, Value: /scan}
    - Class: rviz_default_plugins/RobotModel
      Name: RobotModel
      Enabled: true
      Description Topic: {Value: /robot_description}
  Global Options: {Fixed Frame: map}
  Views:
    Current: {Class: rviz_default_plugins/TopDownOrtho, Scale: 80, X: 1.5, Y: -2, Angle: 0}
  Tools:
    - {Class: rviz_default_plugins/SetInitialPose, Covariance x: 0.5, Topic: {Value: initialpose}}
    - {Class: nav2_rviz_plugins/GoalTool}
Panels: [{Class: rviz_common/Displays}, {Class: nav2_rviz_plugins/Navigation 2}]
Mystery: {}
"""


REPOSITORY = Path(__file__).parents[3]


def test_rviz_file_of_ros1_gives_displays_groups_and_view() -> None:
    value = rviz_value(_ROS1, "a.rviz")
    assert (value["fixed_frame"], value["background"]) == ("odom", "48; 48; 48")
    laser, camera, robot = value["displays"]
    assert laser["class"] == "LaserScan" and laser["topic"] == "/scan"
    assert laser["properties"] == {"Size (m)": 0.03}
    assert (camera["topic"], camera["enabled"]) == ("/camera/image_raw", False)
    assert [laser["name"], camera["name"]] == ["Laser", "Sensors/Camera"]
    assert robot["topic"] == "/robot_description"
    assert value["view"] == {
        "kind": "Orbit", "distance": 3.5, "pitch": 0.4, "yaw": 1.2, "focal": [1.0, 2.0, 0.0],
    }  # fmt: skip
    assert [tool["class"] for tool in value["tools"]] == ["MoveCamera", "SetGoal"]
    assert value["tools"][1]["topic"] == "/move_base_simple/goal"


def test_rviz_file_of_ros2_is_the_same_display() -> None:
    value = rviz_value(_ROS2, "b.rviz")
    assert [(one["class"], one["topic"]) for one in value["displays"]] == [
        ("LaserScan", "/scan"),
        ("RobotModel", "/robot_description"),
    ]
    assert value["view"]["focal"] == [1.5, -2.0, 0.0]
    assert value["unknown"] == ["Mystery"]
    assert value["tools"] == [
        {"class": "SetInitialPose", "topic": "/initialpose", "properties": {"Covariance x": 0.5}},
        {"class": "GoalTool", "topic": "", "properties": {}},
    ]
    assert value["panels"] == ["rviz_common/Displays", "nav2_rviz_plugins/Navigation 2"]


@pytest.mark.parametrize(
    ("folder", "least"),
    [
        (REPOSITORY / "examples", 1),
        (REPOSITORY / "src/gazelle", 3),
        *shared_cases((SHARED / "workspaces", 10)),
    ],
)
def test_files_of_packages_that_run_are_read(folder: Path, least: int) -> None:
    files = sorted(folder.rglob("*.rviz"))
    assert len(files) >= least
    for file in files:
        value: Any = METHODS["rviz.open"](None, Params("rviz.open", {"path": str(file)}))
        assert value["fixed_frame"] and value["displays"], file
        assert all(one["class"] and one["name"] for one in value["displays"]), file


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: [", "x.rviz:1:5: not YAML"),
        ("- 1", "x.rviz is no .rviz file: it holds list"),
        ("Panels: []", "x.rviz is no .rviz file: it has no 'Visualization Manager'"),
        ("a: &a [1]\nb: *c", "x.rviz:2:4: not YAML"),
    ],
)
def test_broken_rviz_file_is_told_with_its_place(text: str, words: str) -> None:
    with pytest.raises(StudioError) as caught:
        rviz_value(text, "x.rviz")
    assert str(caught.value).startswith(words)


def test_perspective_opens_the_panels_that_ran() -> None:
    plugin = {"groups": {"plugin": {"keys": {"topics": {"repr": "['/odom/pose/x', '/cmd/x']"}}}}}
    manager = {
        "keys": {"running-plugins": {"repr": "{'rqt_graph/RosGraph': [1], 'rqt_plot/Plot': [1]}"}},
        "groups": {"plugin__rqt_plot__Plot__1": plugin},
    }
    value = perspective_value(json.dumps({"groups": {"pluginmanager": manager}}), "p.perspective")
    assert value == {
        "panels": [
            {"kind": "rqt_graph", "params": {}},
            {"kind": "rqt_plot", "params": {"curves": ["/odom/pose/x", "/cmd/x"]}},
        ]
    }
    with pytest.raises(StudioError, match="is no perspective: it names no running plug-ins"):
        perspective_value("{}", "p.perspective")


def test_layouts_are_kept_under_any_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))

    def call(method: str, **params: Any) -> Any:
        return METHODS[method](None, Params(method, params))

    assert call("layout.list") == []
    for name in ("mine", "../up", "Ärm / 2"):
        call("layout.save", name=name, value={"dock": [name]})
    assert call("layout.list") == ["../up", "mine", "Ärm / 2"]
    assert call("layout.load", name="../up") == {"dock": ["../up"]}
    assert (
        sorted(file.parent for file in tmp_path.rglob("*.json"))
        == [tmp_path / "gazelle" / "layouts"] * 3
    )
    call("layout.delete", name="mine")
    with pytest.raises(StudioError, match="there is no layout 'mime'"):
        call("layout.load", name="mime")
    with pytest.raises(StudioError, match="a layout's name has 1 to 100 characters"):
        call("layout.save", name=" ", value={})


def test_a_layout_of_before_versions_is_loaded_and_one_of_a_newer_gazelle_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    folder = tmp_path / "gazelle" / "layouts"
    folder.mkdir(parents=True)
    (folder / "old.json").write_text('{"dock": [1]}')
    (folder / "new.json").write_text('{"version": 2, "layout": {"dock": [2]}}')

    def load(name: str) -> Any:
        return METHODS["layout.load"](None, Params("layout.load", {"name": name}))

    assert load("old") == {"dock": [1]}
    with pytest.raises(StudioError, match="the layout 'new' is of version 2, saved by a newer"):
        load("new")
