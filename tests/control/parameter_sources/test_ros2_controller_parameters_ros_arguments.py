from __future__ import annotations

from gazelle.control.parameter_sources.ros2_controller_parameters import read_ros_arguments


def test_rules_files_and_values_of_a_nodes_words() -> None:
    found = read_ros_arguments(
        ["--ros-args -r ~/cmd_vel:=/cmd_vel", "--remap node:a:=b", "-p x.y:=[1,2]"]
    )
    assert found.remappings == (("~/cmd_vel", "/cmd_vel"), ("a", "b"))
    assert found.values == {"x.y": [1, 2]}
    found = read_ros_arguments(["-p", "use:=true", "--params-file", "/a.yaml", "c:=d", "--", "e"])
    assert found.values == {"use": True}
    assert found.files == ("/a.yaml",)
    assert found.remappings == (("c", "d"),)
    assert found.strange == ("e",)
