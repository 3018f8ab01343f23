"""ROS messages as TypeScript interfaces."""

from __future__ import annotations

from typing import NotRequired, TypedDict

import pytest

from gazelle.studio.typescript.interfaces import ros_interfaces


class Note(TypedDict):
    """What is added."""

    note: NotRequired[str]


def test_message_has_its_fields_and_stands_behind_those_inside_of_it() -> None:
    assert ros_interfaces(["geometry_msgs/msg/PoseStamped"], {})[-1] == (
        "/** `geometry_msgs/msg/PoseStamped`. */\n"
        "export interface PoseStamped {\n"
        "  header: Header;\n"
        "  pose: Pose;\n"
        "}\n"
    )
    names = [text.split()[5] for text in ros_interfaces(["geometry_msgs/msg/Pose"], {})]
    assert names == ["Point", "Quaternion", "Pose"]


def test_what_the_server_adds_is_what_the_interface_extends() -> None:
    (text,) = ros_interfaces(["std_msgs/msg/Bool"], {"std_msgs/msg/Bool": Note})
    assert "export interface Bool extends Note {\n  data: boolean;\n}" in text


def test_arrays_are_lists_and_texts_are_strings() -> None:
    *_, text = ros_interfaces(["sensor_msgs/msg/JointState"], {})
    assert "  name: string[];\n  position: number[];\n" in text


def test_messages_of_one_name_are_refused() -> None:
    text = "std_msgs/msg/Bool and example_interfaces/msg/Bool have one name in TypeScript"
    with pytest.raises(ValueError, match=text):
        ros_interfaces(["std_msgs/msg/Bool", "example_interfaces/msg/Bool"], {})
