"""Pain 2: what an installed package would lack."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.diagnostics import Severity

EXAMPLES = Path(__file__).parents[3] / "examples"
FIXTURES = Path(__file__).parents[1] / "fixtures" / "pain_02_install"
AMENT = "project(bot)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"


def test_launch_file_of_python_package_is_not_installed(check: Any) -> None:
    found, _ = check("arm_bringup", FIXTURES / "broken")
    text = "\n".join(str(item) for item in found.by_code("package.not-installed"))
    words = "file 'arm.launch.py' was not found in the share directory of package 'arm_bringup'"
    assert words in text
    assert "'arm.rviz' of folder 'rviz' is not installed" in text
    assert (
        "fix: add to data_files: (os.path.join('share', package_name, 'launch'), "
        "glob('launch/*.launch.py'))," in text
    )
    assert all(item.severity is Severity.WARNING for item in found.by_code("package.not-installed"))


def test_glob_of_a_misspelt_folder_is_named_at_its_place(check: Any) -> None:
    found, _ = check("arm_bringup", FIXTURES / "broken")
    (item,) = found.by_code("package.empty-glob")
    assert item.message == "glob('lanch/*.launch.py') finds no file: there is no folder 'lanch'"
    assert (item.span.line, item.span.column) == (15, 62)
    assert item.fix == "did you mean 'launch'?"


def test_data_file_that_does_not_exist_is_an_error(check: Any) -> None:
    found, _ = check("arm_bringup", FIXTURES / "broken")
    (item,) = found.by_code("package.install-missing")
    assert "error: can't copy 'config/arms.yaml': doesn't exist or not a regular file" in str(item)
    assert (item.span.line, item.fix) == (16, "did you mean 'arm.yaml'?")
    assert item.severity is Severity.ERROR


def test_entry_point_names_a_function_that_is_not_there(check: Any) -> None:
    found, _ = check("arm_bringup", FIXTURES / "broken")
    (item,) = found.by_code("package.entry-point")
    assert "AttributeError: module 'arm_bringup.wave' has no attribute 'mian'" in item.message
    assert (item.span.line, item.fix) == (18, "did you mean 'main'?")


def test_folder_is_installed_into_one_of_its_own_name(check: Any) -> None:
    found, _ = check("arm_description", FIXTURES / "broken")
    (item,) = found.by_code("package.install-place")
    assert "folder 'urdf' goes to share/arm_description/urdf/urdf" in item.message
    assert (item.span.line, item.fix) == (5, "write urdf/ or DESTINATION share/arm_description")
    (missing,) = found.by_code("package.install-missing")
    assert missing.message.startswith("'mesh' is to be installed and does not exist (CMake Error")
    (launch,) = found.by_code("package.not-installed")
    assert launch.fix == "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})"


@pytest.mark.parametrize("name", ["arm_bringup", "arm_description"])
def test_clean_twins_have_no_finding(check: Any, name: str) -> None:
    found, _ = check(name, FIXTURES / "clean")
    assert list(found) == []


@pytest.mark.parametrize(
    "rule",
    [
        "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})",
        'install(DIRECTORY "launch/" DESTINATION "share/bot/launch")',
        "INSTALL(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/launch\n DESTINATION share/bot)",
        "ament_auto_package(INSTALL_TO_SHARE launch)",
        "install(FILES launch/a.launch.py DESTINATION share/bot/launch)",
        "file(GLOB found launch/*.py)\ninstall(FILES ${found} DESTINATION share/bot/launch)",
        "file(GLOB f RELATIVE ${PROJECT_SOURCE_DIR} launch/*)\ninstall(FILES ${f} DESTINATION x)",
        'install(DIRECTORY . DESTINATION share/bot FILES_MATCHING PATTERN "*.launch.py")',
        "install(DIRECTORY launch DESTINATION ${WHERE_NOBODY_KNOWS})",
        "list(APPEND all launch)\ninstall(DIRECTORY ${all} DESTINATION share/bot)",
        "#[[ a long\ncomment ) ]]\ninstall(DIRECTORY launch DESTINATION share/bot) # end",
    ],
)
def test_rules_that_install_the_launch_folder(check: Any, make: Any, rule: str) -> None:
    root = make(**{"CMakeLists.txt": AMENT.format(rule), "launch__a.launch.py": ""})
    found, _ = check("bot", root)
    assert not found.by_code("package.not-installed")
    assert not found.by_code("package.install-missing")


@pytest.mark.parametrize(
    "rule",
    [
        "",
        "# install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})",
        'install(DIRECTORY launch DESTINATION share/bot PATTERN "*.py" EXCLUDE)',
        'install(DIRECTORY launch DESTINATION share/bot FILES_MATCHING PATTERN "*.xml")',
        "install(DIRECTORY config DESTINATION share/bot)",
    ],
)
def test_rules_that_leave_the_launch_folder_out(check: Any, make: Any, rule: str) -> None:
    files = {"CMakeLists.txt": AMENT.format(rule), "launch__a.launch.py": "", "config__x.txt": ""}
    found, _ = check("bot", make(**files))
    (item,) = found.by_code("package.not-installed")
    assert "'a.launch.py' of folder 'launch' is not installed" in item.message


def test_ros1_package_without_rules_is_a_notice(check: Any, make: Any) -> None:
    lists = "project(bot)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    files = {"CMakeLists.txt": lists, "launch__a.launch": "<launch/>", "urdf__a.urdf": "<robot/>"}
    found, _ = check("bot", make("catkin", **files))
    (item,) = found
    assert (item.code, item.severity) == ("package.not-installed", Severity.INFO)
    assert "works from its workspace (devel)" in item.message
    assert item.fix.startswith("install(DIRECTORY launch urdf DESTINATION ${CATKIN_PACKAGE_SHARE")


def test_rules_known_at_build_time_only_are_said_so(check: Any, make: Any) -> None:
    rule = "include(cmake/rules.cmake)"
    files = {"CMakeLists.txt": AMENT.format(rule), "launch__a.launch.py": ""}
    found, _ = check("bot", make(**files))
    (item,) = found
    assert item.code == "package.install-unread"
    assert "whether 'launch/a.launch.py' is installed cannot be told" in item.message


def test_unclosed_parenthesis_is_found_where_it_opens(check: Any, make: Any) -> None:
    found, _ = check("bot", make(**{"CMakeLists.txt": "project(bot)\ninstall(DIRECTORY launch\n"}))
    (item,) = found.by_code("package.cmake-syntax")
    assert item.message == "CMake stops here: install( is never closed: a ')' is missing"
    assert (item.span.line, item.span.column) == (2, 1)


def test_setup_py_of_python_2_is_found(check: Any, make: Any) -> None:
    found, _ = check("bot", make("ament_python", **{"setup.py": "x = 1\nprint 'hello'\n"}))
    (item,) = found.by_code("package.setup-syntax")
    assert (item.span.line, item.severity) == (2, Severity.ERROR)


def test_folder_among_data_files_is_an_error(check: Any, make: Any) -> None:
    setup = "from glob import glob\nfrom setuptools import setup\nsetup(name='bot', data_files=["
    setup += "('share/bot', ['package.xml']), ('share/bot/meshes', glob('meshes/*'))])\n"
    files = {"setup.py": setup, "meshes__visual__a.stl": "", "meshes__b.stl": ""}
    found, _ = check("bot", make("ament_python", **files))
    (item,) = found.by_code("package.install-missing")
    assert item.message.startswith("'meshes/visual' is a folder, and only files can stand here")


def test_data_files_of_a_walk_are_followed(check: Any, make: Any) -> None:
    setup = """
import os
from setuptools import setup
def all_files(folder):
    rows = []
    for root, folders, files in os.walk(folder):
        rows.append((os.path.join('share', 'bot', root), [os.path.join(root, f) for f in files]))
    return rows
rows = [('share/ament_index/resource_index/packages', ['resource/bot']),
        ('share/bot', ['package.xml'])]
setup(name='bot', packages=[], data_files=rows + all_files('models'))
"""
    files = {"setup.py": setup, "resource__bot": "", "models__a__meshes__a.stl": ""}
    found, _ = check("bot", make("ament_python", **files))
    assert list(found) == []


@pytest.mark.parametrize(
    ("root", "name", "codes"),
    [
        (EXAMPLES / "arm_ws", "heron_bringup", set()),
        (EXAMPLES / "arm_ws", "heron_description", set()),
        (EXAMPLES / "arm_ws", "heron_moveit_config", set()),
        (EXAMPLES / "four_wheel_ws", "courier_robot", set()),
        (EXAMPLES / "own_plugin_ws", "gust_plugins", set()),
        (EXAMPLES / "scout_ws", "scout_robot", set()),
        *shared_cases(
            (SHARED / "workspaces/ros2_ws", "luck_description", set()),
            (SHARED / "workspaces/ros2_ws", "luck_gazebo", {"package.undeclared"}),
            (SHARED / "workspaces/ros2_ws", "luck_robot", {"package.undeclared"}),
            (SHARED / "workspaces/catkin_ws", "urdf_exam", None),
        ),
    ],
)
def test_packages_that_run_have_true_findings_only(
    check: Any, root: Path, name: str, codes: set[str] | None
) -> None:
    found, _ = check(name, root / "src")
    if codes is not None:
        assert {item.code for item in found} == codes
    if EXAMPLES in root.parents or codes is None:
        assert {item.severity for item in found} <= {Severity.INFO}


@pytest.mark.parametrize(
    ("build_type", "name", "text"),
    [
        (
            "ament_cmake",
            "CMakeLists.txt",
            AMENT.format(f"install(FILES {'x' * 5000} DESTINATION s)"),
        ),
        ("ament_cmake", "CMakeLists.txt", "install(" * 3000),
        ("ament_cmake", "CMakeLists.txt", "set(A ${A}${A}x)\n" * 400 + AMENT.format("")),
        ("ament_python", "setup.py", "(" * 5000),
        ("ament_python", "setup.py", "x = '\0'\n"),
        ("ament_python", "setup.py", "x = [0]\nfor i in range(5000):\n    x = x + x\n"),
    ],
)
def test_broken_build_files_come_to_an_end(
    check: Any, make: Any, build_type: str, name: str, text: str
) -> None:
    found, _ = check("bot", make(build_type, **{name: text, "launch__a.launch.py": ""}))
    assert all(item.code.startswith("package.") for item in found)


def test_mark_of_utf8_before_the_first_command_is_none_of_it(check: Any, tmp_path: Path) -> None:
    manifest = '<package format="2"><name>bot</name><version>1.0.0</version></package>'
    (tmp_path / "bot").mkdir()
    (tmp_path / "bot" / "package.xml").write_text(manifest, "utf-8")
    (tmp_path / "bot" / "CMakeLists.txt").write_text(f"\ufeff{AMENT.format('')}", "utf-8")
    found, _ = check("bot", tmp_path)
    assert not found.by_code("package.cmake-syntax")
