"""Modules, entry points, scripts and the marker of Python packages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

ROWS = "[('share/ament_index/resource_index/packages', ['resource/bot']),"
ROWS += " ('share/bot', ['package.xml'])]"
SETUP = """from setuptools import setup
setup(name='bot', packages={packages}, data_files={rows},
      entry_points={{'console_scripts': [{scripts}]}})
"""
CFG = "[develop]\nscript_dir=$base/lib/bot\n[install]\ninstall_scripts=$base/lib/bot\n"


def python(
    make: Any, packages: str = "['bot']", rows: str = ROWS, scripts: str = "", **files: str
) -> Path:
    base = {"resource__bot": "", "bot/__init__.py": "", "setup.cfg": CFG}
    setup = SETUP.format(packages=packages, rows=rows, scripts=scripts)
    root: Path = make("ament_python", **base, **files, **{"setup.py": setup})
    (root / "bot" / "bot").mkdir(exist_ok=True)
    (root / "bot" / "bot" / "__init__.py").touch()
    return root


def test_right_python_package_has_no_finding(check: Any, make: Any) -> None:
    assert list(check("bot", python(make))[0]) == []


def test_marker_of_another_name(check: Any, make: Any) -> None:
    root = python(make, rows=ROWS.replace("resource/bot", "resource/robot"), resource__robot="")
    (item,) = check("bot", root)[0]
    assert item.code == "package.index-marker"
    assert "Package 'bot' not found" in item.message
    assert "['resource/bot']" in item.fix


def test_manifest_that_is_not_installed(check: Any, make: Any) -> None:
    rows = "[('share/ament_index/resource_index/packages', ['resource/bot'])]"
    (item,) = check("bot", python(make, rows=rows))[0]
    assert (item.code, item.fix) == ("package.index-marker", "('share/bot', ['package.xml']),")


def test_inner_module_that_is_not_listed(check: Any, make: Any) -> None:
    root = python(make)
    (root / "bot" / "bot" / "arm").mkdir()
    (root / "bot" / "bot" / "arm" / "__init__.py").touch()
    (item,) = check("bot", root)[0]
    assert item.code == "package.module"
    assert "ModuleNotFoundError: No module named 'bot.arm'" in item.message


def test_module_without_a_folder(check: Any, make: Any) -> None:
    (item,) = check("bot", python(make, packages="['bots']"))[0].by_code("package.module")
    assert "package directory 'bots' does not exist" in item.message
    assert item.fix == "did you mean 'bot'?"


def test_executables_go_where_nobody_looks(check: Any, make: Any) -> None:
    root = python(make, scripts="'go = bot.go:main'")
    (root / "bot" / "bot" / "go.py").write_text("def main(): pass\n")
    (root / "bot" / "setup.cfg").unlink()
    (item,) = check("bot", root)[0]
    assert item.code == "package.scripts-folder"
    assert "ros2 run looks into lib/bot (No executable found)" in item.message


def test_entry_point_of_a_module_that_is_not_there(check: Any, make: Any) -> None:
    root = python(make, scripts="'go = bot.goo:main'")
    (root / "bot" / "bot" / "go.py").write_text("def main(): pass\n")
    (item,) = check("bot", root)[0]
    assert item.code == "package.entry-point"
    assert "ModuleNotFoundError: No module named 'bot.goo'" in item.message
    assert item.fix == "did you mean 'bot.go' or 'bot'?"


def test_script_without_the_executable_bit(check: Any, make: Any) -> None:
    lists = "project(bot)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    root = make("catkin", **{"CMakeLists.txt": lists, "scripts__go.py": "#!/usr/bin/env python3\n"})
    (item,) = check("bot", root)[0]
    assert (item.code, item.fix) == ("package.script-not-executable", "chmod +x scripts/go.py")
    (root / "bot" / "scripts" / "go.py").chmod(0o755)
    assert list(check("bot", root)[0]) == []


def test_script_that_is_not_installed(check: Any, make: Any) -> None:
    lists = "project(bot)\nament_package()\ninstall(DIRECTORY urdf DESTINATION share/bot)\n"
    files = {"CMakeLists.txt": lists, "scripts__go.py": "#!/usr/bin/env python3\n", "urdf__a": ""}
    root = make(**files)
    (root / "bot" / "scripts" / "go.py").chmod(0o755)
    (item,) = check("bot", root)[0]
    assert item.code == "package.script-not-installed"
    assert item.fix == "install(PROGRAMS scripts/go.py DESTINATION lib/${PROJECT_NAME})"
