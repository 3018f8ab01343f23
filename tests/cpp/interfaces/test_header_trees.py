"""Include folders: what is in them, and what stays untouched when they are made again."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cpp.interfaces.message_probe import OWN_PACKAGE

from gazelle.cpp.interfaces import known_messages, package_messages
from gazelle.errors import UserFileError

FILES = sorted(file for file in OWN_PACKAGE.rglob("*.*") if file.suffix != ".xml")


def _paths(folder: Path, written: list[Path]) -> set[str]:
    return {str(file.relative_to(folder)) for file in written}


def test_all_that_gazelle_knows_has_headers(tmp_path: Path) -> None:
    ros1 = _paths(tmp_path / "1", known_messages(1, tmp_path / "1"))
    assert {
        "std_msgs/String.h",
        "std_srvs/SetBool.h",
        "std_srvs/SetBoolRequest.h",
        "actionlib_tutorials/FibonacciActionGoal.h",
        "dynamic_reconfigure/Reconfigure.h",
    } <= ros1
    ros2 = _paths(tmp_path / "2", known_messages(2, tmp_path / "2"))
    assert {
        "std_msgs/msg/string.hpp",
        "std_msgs/msg/detail/string__struct.hpp",
        "example_interfaces/action/fibonacci.hpp",
        "builtin_interfaces/msg/time.hpp",
    } <= ros2


def test_a_package_of_ros1_has_gencpps_headers(tmp_path: Path) -> None:
    written = package_messages(OWN_PACKAGE, 1, tmp_path, FILES)
    walk = {f"Walk{end}.h" for end in ("Action", "ActionGoal", "ActionResult", "ActionFeedback")}
    walk |= {"WalkGoal.h", "WalkResult.h", "WalkFeedback.h"}
    wanted = walk | {"Ask.h", "AskRequest.h", "AskResponse.h", "Everything.h", "Nothing.h"}
    wanted.add("Shapes.h")
    assert _paths(tmp_path, written) == {f"probe_msgs/{name}" for name in wanted}


def test_headers_that_are_right_stay_untouched(tmp_path: Path) -> None:
    package_messages(OWN_PACKAGE, 2, tmp_path, FILES)
    before = {file: file.stat().st_mtime_ns for file in tmp_path.rglob("*.hpp")}
    changed = tmp_path / "probe_msgs/msg/nothing.hpp"
    changed.write_text("// other", encoding="utf-8")
    package_messages(OWN_PACKAGE, 2, tmp_path, FILES)
    after = {file: file.stat().st_mtime_ns for file in tmp_path.rglob("*.hpp")}
    assert {file for file in after if after[file] != before[file]} <= {changed}
    assert "struct Nothing" in changed.read_text(encoding="utf-8")


def test_messages_of_other_packages_are_found(tmp_path: Path) -> None:
    user = tmp_path / "user_msgs"
    (user / "msg").mkdir(parents=True)
    (user / "package.xml").write_text("<package><name>renamed</name></package>", encoding="utf-8")
    file = user / "msg/Report.msg"
    file.write_text("probe_msgs/Shapes[] shapes\nLine line\n", encoding="utf-8")
    (user / "msg/Line.msg").write_text("string text\n", encoding="utf-8")
    header = package_messages(user, 2, tmp_path, [file], [OWN_PACKAGE])[0]
    assert header == tmp_path / "renamed/msg/report.hpp"
    text = header.read_text(encoding="utf-8")
    assert "#include <probe_msgs/msg/shapes.hpp>" in text
    assert "#include <renamed/msg/line.hpp>" in text


def test_a_mistake_is_told_at_its_line(tmp_path: Path) -> None:
    (tmp_path / "bad_msgs/msg").mkdir(parents=True)
    file = tmp_path / "bad_msgs/msg/Bad.msg"
    file.write_text("int32 fine\nNoSuchThing wrong\n", encoding="utf-8")
    with pytest.raises(UserFileError) as error:
        package_messages(tmp_path / "bad_msgs", 1, tmp_path / "out", [file])
    (found,) = error.value.diagnostics
    assert (found.code, found.span.line) == ("interfaces.unknown-type", 2)
