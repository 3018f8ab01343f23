"""Sourcing an install space in real shells."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.plan import site_packages
from gazelle.workspace.building.setup_scripts import underlays, write_prefix_scripts

Make = Callable[..., Path]
Build = Callable[..., dict[str, Outcome]]

_SETUP = "from setuptools import setup\nsetup(name='{0}', packages=['{0}'])\n"
_HOOK = (
    'ament_prepend_unique_value GAZEBO_MODEL_PATH "$AMENT_CURRENT_PREFIX/share/@PROJECT_NAME@"\n'
)


def _sourced(shell: str, *files: Path, **before: str) -> dict[str, str]:
    """Return the environment after sourcing files, with errors of the shell being failures."""
    lines = ["set -eu", *(f'. "{file}"' for file in files), "env -0"]
    environ = {"PATH": "/usr/bin:/bin", "HOME": "/", **before}
    done = subprocess.run(
        [shutil.which(shell) or shell, "-c", "\n".join(lines)],
        env=environ,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    pairs = (item.partition("=") for item in done.stdout.split("\0") if item)
    return {name: value for name, _, value in pairs}


def _shells() -> list[str]:
    return [shell for shell in ("sh", "bash", "dash", "zsh") if shutil.which(shell)]


@pytest.fixture
def workspace(make: Make, build: Build, tmp_path: Path) -> Path:
    """Packages ``msgs`` and ``bot``, which needs it, built."""
    make("msgs", "ament_python", {"setup.py": _SETUP.format("msgs"), "msgs/__init__.py": ""})
    lists = "project(bot)\nament_environment_hooks(env-hooks/bot.sh.in)\nament_package()\n"
    files = {"CMakeLists.txt": lists, "env-hooks/bot.sh.in": _HOOK}
    make("bot", files=files, needs=("msgs",))
    assert {outcome.code for outcome in build().values()} == {0}
    return tmp_path / "install"


@pytest.mark.parametrize("shell", _shells())
def test_sourcing_sets_the_paths_dependencies_last(workspace: Path, shell: str) -> None:
    suffix = shell if shell in {"bash", "zsh"} else "sh"
    found = _sourced(shell, workspace / f"setup.{suffix}", AMENT_PREFIX_PATH="/opt/ros/humble")
    prefixes = [str(workspace / "bot"), str(workspace / "msgs"), "/opt/ros/humble"]
    assert found["AMENT_PREFIX_PATH"].split(":") == prefixes
    assert found["PYTHONPATH"] == str(workspace / "msgs" / site_packages())
    assert found["GAZEBO_MODEL_PATH"] == str(workspace / "bot/share/bot")
    assert found["COLCON_PREFIX_PATH"] == str(workspace)
    left = {name for name in found if name.startswith(("_gazelle", "COLCON_CURRENT", "AMENT_CUR"))}
    assert not left


@pytest.mark.parametrize("shell", _shells())
def test_sourcing_twice_is_sourcing_once(workspace: Path, shell: str) -> None:
    file = workspace / ("setup.bash" if shell == "bash" else "setup.sh")
    once, twice = _sourced(shell, file), _sourced(shell, file, file)
    for name in ("AMENT_PREFIX_PATH", "PYTHONPATH", "GAZEBO_MODEL_PATH", "CMAKE_PREFIX_PATH"):
        assert once[name] == twice[name]


def test_bash_finds_a_workspace_that_was_moved(workspace: Path, tmp_path: Path) -> None:
    moved = tmp_path / "moved to a place with spaces"
    workspace.rename(moved)
    found = _sourced("bash", moved / "setup.bash")
    assert found["AMENT_PREFIX_PATH"].split(":") == [str(moved / "bot"), str(moved / "msgs")]


def test_sh_says_that_a_workspace_was_moved(workspace: Path, tmp_path: Path) -> None:
    moved = workspace.rename(tmp_path / "moved")
    done = subprocess.run(
        ["sh", "-c", f". {moved}/setup.sh"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "does not exist. Source setup.bash" in done.stderr


def test_one_package_can_be_sourced(workspace: Path) -> None:
    found = _sourced("bash", workspace / "bot/share/bot/local_setup.bash")
    assert found["AMENT_PREFIX_PATH"] == str(workspace / "bot")
    found = _sourced("sh", workspace / "msgs/share/msgs/package.sh")
    assert found["AMENT_PREFIX_PATH"] == str(workspace / "msgs")


def test_dsv_rows_of_a_package_are_followed(make: Make, build: Build, tmp_path: Path) -> None:
    lists = "project(bot)\nament_environment_hooks(env-hooks/bot.dsv)\nament_package()\n"
    rows = "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share/bot/worlds\nset;BOT_KIND;small\n"
    make("bot", files={"CMakeLists.txt": lists, "env-hooks/bot.dsv": rows})
    build()
    found = _sourced("bash", tmp_path / "install/setup.bash")
    assert found["GZ_SIM_RESOURCE_PATH"] == str(tmp_path / "install/bot/share/bot/worlds")
    assert found["BOT_KIND"] == "small"


def test_a_missing_hook_fails_the_package(make: Make, build: Build) -> None:
    lists = "project(bot)\nament_environment_hooks(env-hooks/no.sh)\nament_package()\n"
    make("bot", files={"CMakeLists.txt": lists})
    outcome = build()["bot"]
    assert outcome.code == 2
    assert "names 'env-hooks/no.sh', and there is no such file" in outcome.errors[0]


def test_a_workspace_sources_the_one_it_was_built_on(workspace: Path, tmp_path: Path) -> None:
    over = tmp_path / "over"
    over.mkdir()
    environ = {"COLCON_PREFIX_PATH": f"{workspace}:{over}", "AMENT_PREFIX_PATH": f"{workspace}/bot"}
    assert underlays(environ, ("COLCON_PREFIX_PATH", "AMENT_PREFIX_PATH"), over) == (workspace,)
    assert write_prefix_scripts(over, merged=False, environ=environ) == ()
    found = _sourced("bash", over / "setup.bash")
    assert found["COLCON_PREFIX_PATH"].split(":") == [str(over), str(workspace)]
    assert found["AMENT_PREFIX_PATH"].split(":")[0] == str(workspace / "bot")


def test_a_merged_install_space_has_one_prefix(make: Make, build: Build, tmp_path: Path) -> None:
    lists = "install(FILES package.xml DESTINATION share/{0}/x)\nament_package()\n"
    for name in ("one", "two"):
        make(name, files={"CMakeLists.txt": f"project({name})\n{lists.format(name)}"})
    build(merged=True)
    found = _sourced("bash", tmp_path / "install/setup.bash")
    assert found["AMENT_PREFIX_PATH"] == str(tmp_path / "install")
    assert (tmp_path / "install/share/one/x/package.xml").is_file()
    assert (tmp_path / "install/share/two/x/package.xml").is_file()


def test_a_hook_for_bash_alone_is_sourced_by_bash(make: Make, build: Build, tmp_path: Path) -> None:
    lists = "project(bot)\nament_environment_hooks(env-hooks/bot.bash)\nament_package()\n"
    hook = 'export BOT_SHELL="bash $AMENT_CURRENT_PREFIX"\n'
    make("bot", files={"CMakeLists.txt": lists, "env-hooks/bot.bash": hook})
    build()
    found = _sourced("bash", tmp_path / "install/setup.bash")
    assert found["BOT_SHELL"] == f"bash {tmp_path / 'install/bot'}"
    assert "BOT_SHELL" not in _sourced("sh", tmp_path / "install/setup.sh")
    one = _sourced("bash", tmp_path / "install/bot/share/bot/local_setup.bash")
    assert one["BOT_SHELL"] == found["BOT_SHELL"]
