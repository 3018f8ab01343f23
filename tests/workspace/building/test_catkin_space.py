"""Catkin's devel and install spaces."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace
from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.catkin_space import (
    CatkinSpaces,
    build_catkin_package,
    write_space_scripts,
)
from gazelle.workspace.building.packages import find_packages

Make = Callable[..., Path]

_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project(bot)
find_package(catkin REQUIRED COMPONENTS rospy message_generation)
catkin_python_setup()
add_message_files(FILES Level.msg)
generate_messages()
catkin_package()
add_executable(driver src/driver.cpp)
catkin_add_env_hooks(50.bot SHELLS sh DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/env-hooks)
catkin_install_python(PROGRAMS scripts/walk.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
"""
_SETUP = """from setuptools import setup
from catkin_pkg.python_setup import generate_distutils_setup
setup(**generate_distutils_setup(packages=['bot'], package_dir={'': 'src'}))
"""
_FILES = {
    "CMakeLists.txt": _LISTS,
    "setup.py": _SETUP,
    "src/bot/__init__.py": "KIND = 'bot'\n",
    "msg/Level.msg": "float64 level\n",
    "env-hooks/50.bot.sh": 'export BOT_HOME="$CATKIN_ENV_HOOK_WORKSPACE"\n',
    "scripts/walk.py": "#!/usr/bin/env python3\nimport bot\nprint(bot.KIND)\n",
    "launch/bot.launch": "<launch/>",
}


@pytest.fixture
def spaces(tmp_path: Path) -> CatkinSpaces:
    """The folders of a workspace with catkin's names."""
    return CatkinSpaces(*(tmp_path / name for name in ("src", "build", "devel", "install")))


def _build(spaces: CatkinSpaces, *, installs: bool = False) -> Outcome:
    (package,) = find_packages([spaces.source], Diagnostics())
    outcome = build_catkin_package(package, spaces, {}, installs=installs)
    write_space_scripts(spaces.devel, (spaces.source,), {})
    if installs:
        write_space_scripts(spaces.install, (), {})
    return outcome


def _shell(file: Path, then: str, shell: str = "bash") -> str:
    environ = {"PATH": "/usr/bin:/bin", "ROS_DISTRO": "noetic"}
    words = [shell, "-c", f'set -eu\n. "{file}"\n. "{file}"\n{then}']
    done = subprocess.run(words, env=environ, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.mark.parametrize("shell", ["bash", "sh"])
def test_the_devel_space_stands_for_the_sources(
    make: Make, spaces: CatkinSpaces, shell: str
) -> None:
    folder = make("bot", "catkin", _FILES)
    (folder / "scripts/walk.py").chmod(0o755)
    outcome = _build(spaces)
    assert outcome.code == 0
    (told,) = outcome.errors
    assert f"{folder}/CMakeLists.txt:8:1" in told
    assert "executable 'driver'" in told
    assert (spaces.devel / ".catkin").read_text() == str(spaces.source)
    file = spaces.devel / f"setup.{shell}"
    names = "$ROS_PACKAGE_PATH $CMAKE_PREFIX_PATH $BOT_HOME $ROS_DISTRO"
    printed = _shell(file, f'echo "{names}"\n{spaces.devel}/lib/bot/walk.py', shell).splitlines()
    assert printed[0] == f"{spaces.source} {spaces.devel} {spaces.devel} noetic"
    assert printed[1] == "bot"
    assert not spaces.install.exists()


def test_the_sources_are_found_through_the_devel_space(
    make: Make, spaces: CatkinSpaces, tmp_path: Path
) -> None:
    folder = make("bot", "catkin", _FILES)
    _build(spaces)
    environ = {"CMAKE_PREFIX_PATH": str(spaces.devel), "HOME": str(tmp_path)}
    package = Workspace.discover(environ=environ, cwd=spaces.devel).package("bot")
    assert package.path == folder
    assert package.find_executables("walk.py") == (folder / "scripts/walk.py",)


def test_the_install_space_has_copies(make: Make, spaces: CatkinSpaces, tmp_path: Path) -> None:
    make("bot", "catkin", _FILES)
    outcome = _build(spaces, installs=True)
    share = spaces.install / "share/bot"
    for name in ("package.xml", "launch/bot.launch", "msg/Level.msg"):
        assert (share / name).is_file()
        assert f"-- Installing: {share / name}" in outcome.output
    assert not (spaces.install / "lib/bot/walk.py").is_symlink()
    then = f'echo "$ROS_PACKAGE_PATH"\n{spaces.install}/lib/bot/walk.py'
    printed = _shell(spaces.install / "setup.bash", then).splitlines()
    assert printed == [str(spaces.install / "share"), "bot"]
    environ = {"ROS_PACKAGE_PATH": str(spaces.install / "share"), "HOME": str(tmp_path)}
    package = Workspace.discover(environ=environ, cwd=spaces.install).package("bot")
    assert package.executable_names == ("walk.py",)


def test_env_sh_runs_a_command_in_the_space(make: Make, spaces: CatkinSpaces) -> None:
    make("bot", "catkin", _FILES)
    _build(spaces)
    words = [str(spaces.devel / "env.sh"), "sh", "-c", 'echo "$ROS_PACKAGE_PATH"']
    done = subprocess.run(words, env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True,
                          check=True)  # fmt: skip
    assert done.stdout == f"{spaces.source}\n"


def test_a_missing_message_fails_and_leaves_nothing(make: Make, spaces: CatkinSpaces) -> None:
    folder = make("bot", "catkin", _FILES)
    (folder / "msg/Level.msg").unlink()
    outcome = _build(spaces, installs=True)
    assert outcome.code == 1
    assert "[package.message-missing]" in "\n".join(outcome.errors)
    assert not (spaces.devel / "lib").exists()
    assert not (spaces.install / "share").exists()


def test_a_hook_that_catkin_would_have_to_make_is_told(make: Make, spaces: CatkinSpaces) -> None:
    folder = make("bot", "catkin", _FILES)
    (folder / "env-hooks/50.bot.sh").rename(folder / "env-hooks/50.bot.sh.em")
    outcome = _build(spaces)
    assert outcome.code == 0
    shown = "\n".join(outcome.errors)
    assert "50.bot.sh' is not there as it is sourced" in shown
    assert "[package.install-unread]" in shown


def test_a_missing_script_fails(make: Make, spaces: CatkinSpaces) -> None:
    folder = make("bot", "catkin", _FILES)
    (folder / "scripts/walk.py").unlink()
    outcome = _build(spaces)
    assert outcome.code == 1
    assert "catkin_install_python: '" in "\n".join(outcome.errors)


def test_without_a_build_file_a_package_is_used_but_not_installed(
    make: Make, spaces: CatkinSpaces
) -> None:
    (make("bot", "catkin", _FILES) / "CMakeLists.txt").unlink()
    outcome = _build(spaces)
    assert outcome.code == 0
    assert "it is used from its source folder, where catkin_make would stop" in outcome.errors[0]
    outcome = _build(spaces, installs=True)
    assert outcome.code == 1
    assert "is catkin and has no CMakeLists.txt" in outcome.errors[0]
