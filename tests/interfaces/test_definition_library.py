from __future__ import annotations

import os
from pathlib import Path

import pytest

from gazelle.errors import InterfaceError, NotFoundError, UserFileError
from gazelle.interfaces import (
    RosVersion,
    action_type,
    add_package,
    add_search_path,
    convert,
    from_cdr,
    from_ros1,
    known_types,
    message_type,
    ros1_message_type,
    ros1_service_type,
    service_type,
    to_cdr,
    to_ros1,
)

CATKIN = "<package><buildtool_depend>catkin</buildtool_depend></package>"
AMENT = "<package><export><build_type>ament_cmake</build_type></export></package>"


def _package(folder: Path, files: dict[str, str], manifest: str = "") -> Path:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    if manifest:
        (folder / "package.xml").write_text(manifest, encoding="utf-8")
    return folder


def test_ros1_package_has_both_forms_and_one_wire(tmp_path):
    text = "Header header\ntime[] stamps\nOther[] others\nbyte level\nchar letter\nstring X=# no"
    files = {"msg/Mine.msg": text, "msg/Other.msg": "duration d\nuint8[] raw"}
    add_package("mine", _package(tmp_path / "mine", files, CATKIN))
    view = ros1_message_type("mine/Mine")(level=-3, letter=200)
    view.header.stamp.secs = 4
    view.others.append(ros1_message_type("mine/Other")(raw=b"\1\2"))
    assert view.X == "# no"
    canonical = convert(view, message_type("mine/Mine"))
    assert (canonical.level, canonical.letter, canonical.header.stamp.sec) == (-3, 200, 4)
    assert canonical.others[0].raw.tolist() == [1, 2]
    assert to_cdr(canonical) == to_cdr(view)
    assert ros1_message_type("mine/Mine")._full_text.startswith("Header header\ntime[] stamps")


def test_ros2_package_has_a_ros1_form(tmp_path):
    text = "std_msgs/Header header\nbuiltin_interfaces/Time[] stamps\nstring<=4 word\nint32 a 5"
    add_package("two", _package(tmp_path / "two", {"msg/Mine.msg": text}, AMENT))
    view = ros1_message_type("two/Mine")(word="abc")
    assert view._slot_types == ["std_msgs/Header", "time[]", "string", "int32"]
    assert view.a == 0
    assert message_type("two/Mine")().a == 5
    assert from_cdr(message_type("two/Mine"), to_cdr(view)).word == "abc"


def test_services_and_actions_of_a_package(tmp_path):
    files = {"srv/Do.srv": "int32 a\n---\nbool ok", "action/Go.action": "int8 g\n---\n---\nint8 f"}
    add_package("acts", _package(tmp_path / "acts", files, CATKIN))
    assert service_type("acts/Do").Response().ok is False
    assert ros1_service_type("acts/Do")._request_class(a=3).a == 3
    assert ros1_message_type("acts/GoActionFeedback")().feedback.f == 0
    assert action_type("acts/Go").Goal(g=1).g == 1
    assert "acts/msg/GoActionGoal" in known_types(package="acts")


def test_package_without_manifest_is_guessed_by_its_words(tmp_path):
    files = {"msg/One.msg": "Header header", "msg/Two.msg": "std_msgs/Header header"}
    add_package("bare", _package(tmp_path / "bare", files))
    for name in ("One", "Two"):
        assert message_type(f"bare/{name}")().header.frame_id == ""
        assert ros1_message_type(f"bare/{name}")._has_header
    files = {"msg/Four.msg": "int32 a 5", "action/Go.action": "int8 g\n---\n---\n"}
    add_package("plain", _package(tmp_path / "plain", files))
    assert message_type("plain/Four")().a == 5
    assert ros1_message_type("plain/Four")().a == 0
    assert ros1_message_type("plain/GoActionGoal")().goal.g == action_type("plain/Go").Goal().g


def test_own_package_comes_before_a_shipped_one_of_its_generation(tmp_path):
    before = message_type("beginner_tutorials/Num")
    files = {"msg/Num.msg": "float32 number"}
    add_package("beginner_tutorials", _package(tmp_path / "b", files, CATKIN))
    assert message_type("beginner_tutorials/Num")().number == 0.0
    assert message_type("beginner_tutorials/Num") is not before
    files = {"msg/CameraInfo.msg": "Header header\nfloat64[9] K"}
    add_package("sensor_msgs", _package(tmp_path / "s", files, CATKIN))
    assert hasattr(message_type("sensor_msgs/CameraInfo")(), "k")
    assert ros1_message_type("sensor_msgs/CameraInfo").__slots__ == ["header", "K"]


def test_classes_stay_when_an_unrelated_package_is_added(tmp_path):
    scan, view = message_type("sensor_msgs/LaserScan"), ros1_message_type("sensor_msgs/LaserScan")
    add_package("other", _package(tmp_path / "other", {"msg/A.msg": "int8 a"}))
    assert message_type("sensor_msgs/LaserScan") is scan
    assert ros1_message_type("sensor_msgs/LaserScan") is view


def test_search_path_adds_the_packages_under_a_folder(tmp_path):
    _package(tmp_path / "p1", {"msg/A.msg": "int8 a"})
    _package(tmp_path / "p2", {"src/a.cpp": ""})
    assert add_search_path(tmp_path) == ("p1",)
    assert known_types(package="p1") == ("p1/msg/A",)


def test_definitions_lie_in_folders_of_msg_too(tmp_path):
    files = {"msg/A.msg": "int8 a\nC c", "msg/made/base/C.msg": "int8 c", "srv/made/S.srv": "---\n"}
    add_package("nested", _package(tmp_path / "nested", files, CATKIN))
    assert known_types(package="nested") == ("nested/msg/A", "nested/msg/C")
    assert ros1_message_type("nested/A")().c.c == 0
    assert ros1_service_type("nested/S") is not None


def test_a_count_of_empty_messages_beyond_the_bytes_is_refused(tmp_path):
    files = {"msg/None_.msg": "", "msg/Many.msg": "None_[] many"}
    add_package("void", _package(tmp_path / "void", files, CATKIN))
    view = ros1_message_type("void/Many")(many=[ros1_message_type("void/None_")()])
    assert len(from_ros1(type(view), to_ros1(view)).many) == 1
    with pytest.raises(InterfaceError, match="a count is beyond the bytes"):
        from_ros1(type(view), b"\xff\xff\xff\xff")


def test_missing_folder_is_refused(tmp_path):
    with pytest.raises(NotFoundError, match=r"package folder .* not found"):
        add_package("x", tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("files", "code", "text"),
    [
        (
            {"msg/A.msg": "int8 a\nPoes p"},
            "interfaces.unknown-type",
            "A.msg:2:1: error: type 'bad/Poes' is not known",
        ),
        (
            {"msg/A.msg": "std_msgs/Strin s"},
            "interfaces.unknown-type",
            "did you mean 'std_msgs/msg/String'",
        ),
        (
            {"msg/A.msg": "A[] inner"},
            "interfaces.recursive-type",
            "contains itself: bad/msg/A → bad/msg/A",
        ),
        (
            {"msg/A.msg": "B b", "msg/B.msg": "A a"},
            "interfaces.recursive-type",
            "bad/msg/A → bad/msg/B → bad/msg/A",
        ),
        (
            {"msg/A.msg": "int8 a b\nint8"},
            "interfaces.bad-line",
            "A.msg:2:1: error: 'int8' has a type but no name",
        ),
        ({"msg/A.msg": "int8 x-y"}, "interfaces.bad-name", "A.msg:1:6"),
        ({"msg/A.msg": "int9 x"}, "interfaces.bad-type", "A.msg:1:1"),
        ({"msg/A.msg": "int8 X=999"}, "interfaces.bad-value", "A.msg:1:8"),
        ({"msg/A.msg": "int8 x\nint8 x"}, "interfaces.repeated-name", "A.msg:2:6"),
    ],
)
@pytest.mark.parametrize("form", [message_type, ros1_message_type])
def test_errors_in_users_files_have_code_and_place(tmp_path, form, files, code, text):
    add_package("bad", _package(tmp_path / "bad", files, AMENT))
    with pytest.raises(UserFileError) as error:
        form("bad/A")
    assert code in {item.code for item in error.value.diagnostics}
    assert text in str(error.value)


def test_service_without_separator_names_the_file(tmp_path):
    add_package("bad", _package(tmp_path / "bad", {"srv/S.srv": "int8 a"}))
    with pytest.raises(UserFileError, match=r"S\.srv:1: error: a service has 1 line") as error:
        service_type("bad/S")
    assert error.value.diagnostics[0].code == "interfaces.missing-separator"


def test_errors_in_the_second_part_count_lines_of_the_file(tmp_path):
    add_package("bad", _package(tmp_path / "bad", {"srv/S.srv": "int8 a\n---\n\nint9 b\nPoes c"}))
    with pytest.raises(UserFileError) as error:
        service_type("bad/S")
    assert "S.srv:4:1: error: 'int9'" in str(error.value)
    assert "S.srv:5:1: error: type 'bad/Poes'" in str(error.value)


def test_unreadable_file_is_reported(tmp_path, monkeypatch):
    folder = _package(tmp_path / "bad", {"msg/A.msg": "int8 a"})

    def refuse(self, *args, **kwargs):
        raise PermissionError(13, os.strerror(13))

    add_package("bad", folder)
    monkeypatch.setattr(Path, "read_text", refuse)
    with pytest.raises(UserFileError, match=r"A\.msg: error: cannot read it") as error:
        message_type("bad/A")
    assert error.value.diagnostics[0].code == "interfaces.unreadable"


def test_packages_of_the_sample_workspaces(workspaces_dir):
    folder = workspaces_dir / "turtlebot3_ws" / "src" / "turtlebot3_msgs"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    add_package("turtlebot3_msgs", folder)
    state = ros1_message_type("turtlebot3_msgs/SensorState")(battery=11.5)
    back = from_cdr(message_type("turtlebot3_msgs/SensorState"), to_cdr(state))
    assert back.battery == 11.5
    assert RosVersion.ROS2 is back.GENERATION
