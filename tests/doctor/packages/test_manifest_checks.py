"""package.xml, names and dependencies."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.diagnostics import Severity

HEAD = '<package format="{}">\n<name>bot</name><version>{}</version><description>d</description>\n'
TAIL = '<maintainer email="a@b.c">a</maintainer><license>MIT</license>{}</package>\n'
AMENT = "project(bot)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"
TYPE = "<export><build_type>ament_cmake</build_type></export>"


def manifest(
    inner: str = "", *, format: str = "3", version: str = "0.1.0", export: str = TYPE
) -> str:
    return HEAD.format(format, version) + TAIL.format(f"\n{inner}\n{export}")


def test_right_manifest_has_no_finding(check: Any, make: Any) -> None:
    root = make(**{"package.xml": manifest("<depend>rclpy</depend>"), "CMakeLists.txt": AMENT})
    assert list(check("bot", root)[0]) == []


@pytest.mark.parametrize(
    ("text", "words", "fix"),
    [
        (manifest(version="1.0"), 'Package version "1.0" does not follow', "write 0.1.0"),
        (
            manifest("<run_depend>tf2</run_depend>"),
            "must not contain the following tags: run",
            "exec",
        ),
        (
            manifest("<exec_depend>tf2</exec_depend>", format="1"),
            "<exec_depend> does not exist in format 1",
            '<package format="2">',
        ),
        (
            manifest("<exec_dependency>tf2</exec_dependency>"),
            "no <exec_dependency>",
            "'exec_depend'",
        ),
        (manifest(format="4"), "the manifest's format is '4'", '<package format="3">'),
        (
            f'<package format="3"><name>bot</name>{TYPE}</package>',
            "lacks <version>, <description>, <maintainer>, <license>",
            "add <version>",
        ),
    ],
)
def test_rules_of_the_format(check: Any, make: Any, text: str, words: str, fix: str) -> None:
    found, _ = check("bot", make(**{"package.xml": text, "CMakeLists.txt": AMENT}))
    (item,) = found.by_code("package.manifest")
    assert words in item.message
    assert fix in item.fix
    assert item.span.line > 0


def test_malformed_manifest_is_reported_by_the_workspace(check: Any, make: Any) -> None:
    found, _ = check(
        "bot", make(**{"package.xml": "<package><name>bot</name>\n<version></package>"})
    )
    (item,) = found.by_code("workspace.bad-manifest")
    assert "mismatched tag" in item.message


@pytest.mark.parametrize("export", ["", "<export><build_type>catkin</build_type></export>"])
def test_build_type_is_not_that_of_the_build_file(check: Any, make: Any, export: str) -> None:
    root = make(**{"package.xml": manifest(export=export), "CMakeLists.txt": AMENT})
    (item,) = check("bot", root)[0].by_code("package.build-type")
    assert item.message.startswith("CMakeLists.txt is for ament_cmake, the ")
    assert item.fix == "add <export><build_type>ament_cmake</build_type></export>"


def test_unknown_build_type_has_a_nearest_one(check: Any, make: Any) -> None:
    text = manifest(export="<export><build_type>ament_cmak</build_type></export>")
    (item,) = check("bot", make(**{"package.xml": text, "CMakeLists.txt": AMENT}))[0]
    assert item.code == "package.build-type"
    assert item.fix == "did you mean 'ament_cmake'?"


def test_package_without_build_file(check: Any, make: Any) -> None:
    (item,) = check("bot", make())[0]
    assert (item.code, item.severity) == ("package.no-build-file", Severity.INFO)
    assert "has no CMakeLists.txt" in item.message


def test_names_of_project_and_setup_differ_from_the_manifests(check: Any, make: Any) -> None:
    root = make(**{"CMakeLists.txt": AMENT.replace("(bot)", "(robot)")})
    (item,) = check("bot", root)[0].by_code("package.names")
    assert "package name 'bot' does not match current PROJECT_NAME 'robot'" in item.message
    assert (item.span.line, item.fix) == (1, "project(bot)")
    setup = "from setuptools import setup\nsetup(name='robot')\n"
    root = make("ament_python", **{"setup.py": setup})
    (root / "bot" / "CMakeLists.txt").unlink()
    (item,) = check("bot", root)[0].by_code("package.names")
    assert (item.span.line, item.fix) == (2, "name='bot'")


def test_undeclared_packages_are_listed_once_with_a_place(check: Any, make: Any) -> None:
    launch = '<launch>\n<!-- <node pkg="amcl"/> -->\n<node pkg="rviz2" exec="rviz2"/>\n</launch>\n'
    xacro = '<robot><xacro:include filename="$(find xacro)/a.xacro"/></robot>'
    lists = AMENT.replace(
        "ament_package", "install(DIRECTORY launch urdf DESTINATION share/bot)\nament_package"
    )
    files = {"launch__a.launch.xml": launch, "urdf__a.xacro": xacro, "CMakeLists.txt": lists}
    (item,) = check("bot", make(**files))[0]
    assert (item.code, item.severity) == ("package.undeclared", Severity.INFO)
    assert "declare rviz2 (launch/a.launch.xml:3), xacro (urdf/a.xacro:1)" in item.message
    assert item.fix == "add <exec_depend>rviz2</exec_depend><exec_depend>xacro</exec_depend>"


def test_what_depends_on_the_package_itself_need_not_be_declared(check: Any, make: Any) -> None:
    """Declared, it would close a circle that no build tool can sort."""
    xacro = '<robot><link name="$(find bot_config)"/><link name="$(find bot_launch)"/></robot>'
    lists = AMENT.replace(
        "ament_package", "install(DIRECTORY urdf DESTINATION share/bot)\nament_package"
    )
    root = make(**{"urdf__a.xacro": xacro, "CMakeLists.txt": lists})
    for name, needs in {"bot_config": "bot", "bot_launch": "bot_config", "other": "x"}.items():
        text = f"<package format='3'><name>{name}</name><depend>{needs}</depend></package>"
        (root / name).mkdir()
        (root / name / "package.xml").write_text(text)
    assert list(check("bot", root)[0]) == []
    (root / "bot_config" / "package.xml").write_text("<package><name>bot_config</name></package>")
    (item,) = check("bot", root)[0]
    assert "bot_config (urdf/a.xacro:1), bot_launch" in item.message


def test_mistyped_dependency_has_a_nearest_name(check: Any, make: Any) -> None:
    inner = "<depend>sensor_msg</depend><depend>my_msgs</depend><depend>python3-numpy</depend>"
    root = make(**{"package.xml": manifest(inner), "CMakeLists.txt": AMENT})
    (item,) = check("bot", root)[0]
    assert item.code == "package.unknown-dependency"
    assert "Cannot locate rosdep definition for [sensor_msg]" in item.message
    assert item.fix == "did you mean 'sensor_msgs'?"
