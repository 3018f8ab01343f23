"""Message files against the lists of CMakeLists.txt."""

from __future__ import annotations

from pathlib import Path
from typing import Any

CATKIN = "project(bot)\nfind_package(catkin REQUIRED)\n{}\ncatkin_package()\n"
AMENT = "project(bot)\n{}\nament_package()\n"


def test_ros1_lists_and_files_agree(check: Any, make: Any) -> None:
    lists = CATKIN.format("add_message_files(FILES A.msg)\ngenerate_messages()")
    assert (
        list(check("bot", make("catkin", **{"CMakeLists.txt": lists, "msg__A.msg": ""}))[0]) == []
    )


def test_ros1_file_is_not_listed_and_a_listed_one_missing(check: Any, make: Any) -> None:
    lists = CATKIN.format("add_message_files(FILES\n  Amr.msg)\ngenerate_messages()")
    files = {"CMakeLists.txt": lists, "msg__Arm.msg": "", "srv__Go.srv": "---"}
    found, _ = check("bot", make("catkin", **files))
    (missing,) = found.by_code("package.message-missing")
    assert missing.message.startswith("add_message_files() lists 'msg/Amr.msg'")
    assert (missing.span.line, missing.fix) == (3, "did you mean 'msg/Arm.msg'?")
    unlisted = found.by_code("package.message-unlisted")
    assert [item.fix for item in unlisted] == [
        "add_message_files(FILES … Arm.msg)",
        "add_service_files(FILES … Go.srv)",
    ]


def test_ros1_without_generate_messages(check: Any, make: Any) -> None:
    lists = CATKIN.format("add_message_files()")
    found, _ = check("bot", make("catkin", **{"CMakeLists.txt": lists, "msg__A.msg": ""}))
    (item,) = found
    assert item.code == "package.message-build"
    assert item.message.startswith("add_message_files() without generate_messages()")


def test_ros2_lists_by_a_variable_and_the_group(check: Any, make: Any) -> None:
    lists = AMENT.format(
        'set(files "msg/Arm.msg" "srv/Go.srv")\n'
        "rosidl_generate_interfaces(${PROJECT_NAME} ${files} DEPENDENCIES std_msgs)"
    )
    files = {"CMakeLists.txt": lists, "msg__Arm.msg": "", "srv__Go.srv": "---", "msg__leg.msg": ""}
    root: Path = make(**files)
    found, _ = check("bot", root)
    (unlisted,) = found.by_code("package.message-unlisted")
    assert unlisted.fix == 'rosidl_generate_interfaces(${PROJECT_NAME} … "msg/leg.msg")'
    texts = [item.message for item in found.by_code("package.message-build")]
    assert texts[0].startswith("'msg/leg.msg' is no name of an interface in ROS 2")
    assert texts[1].startswith("Packages installing interfaces must include '<member_of_group>")
