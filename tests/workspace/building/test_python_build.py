"""``ament_python`` packages: what ``setup.py`` says is below the prefix."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.workspace import Workspace
from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.plan import site_packages

Make = Callable[..., Path]
Build = Callable[..., dict[str, Outcome]]

_SETUP = """from glob import glob
from setuptools import find_packages, setup
package_name = 'bot'
setup(
    name=package_name, version='0.1.0', packages=find_packages(exclude=['test']),
    package_data={'bot': ['*.txt']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.py')),
    ],
    install_requires=['setuptools'],
    entry_points={'console_scripts': ['talk = bot.talk:main']},
)
"""
_FILES = {
    "setup.py": _SETUP,
    "setup.cfg": "[develop]\nscript_dir=$base/lib/bot\n[install]\ninstall_scripts=$base/lib/bot\n",
    "resource/bot": "",
    "bot/__init__.py": "",
    "bot/talk.py": "def main():\n    print('talking')\n",
    "bot/words.txt": "hello",
    "bot/inner/__init__.py": "",
    "launch/bot.launch.py": "# a launch file\n",
}


@pytest.mark.parametrize("symlinks", [False, True])
def test_setup_py_is_followed(make: Make, build: Build, tmp_path: Path, symlinks: bool) -> None:
    make("bot", "ament_python", _FILES)
    outcome = build(symlinks=symlinks)["bot"]
    assert (outcome.code, outcome.errors) == (0, ())
    prefix = tmp_path / "install" / "bot"
    modules = prefix / site_packages() / "bot"
    assert (prefix / "share/ament_index/resource_index/packages/bot").is_file()
    assert (prefix / "share/bot/launch/bot.launch.py").is_symlink() == symlinks
    assert (modules / "talk.py").is_file()
    assert (modules / "inner/__init__.py").is_file()
    assert (modules / "words.txt").read_text() == "hello"
    assert modules.is_symlink() == symlinks


def test_the_executable_runs_with_the_modules_on_the_path(
    make: Make, build: Build, tmp_path: Path
) -> None:
    make("bot", "ament_python", _FILES)
    build()
    prefix = tmp_path / "install" / "bot"
    environ = {**os.environ, "PYTHONPATH": str(prefix / site_packages())}
    program = prefix / "lib/bot/talk"
    done = subprocess.run([program], env=environ, capture_output=True, text=True, check=True)
    assert done.stdout == "talking\n"
    query = "from importlib.metadata import entry_points, version\n"
    query += "found = entry_points(group='console_scripts', name='talk')\n"
    query += "print(version('bot'), [item.value for item in found])"
    told = subprocess.run(
        [sys.executable, "-c", query], env=environ, capture_output=True, text=True, check=True
    )
    assert told.stdout == "0.1.0 ['bot.talk:main']\n"


@pytest.mark.parametrize(
    ("variable", "folder"), [("AMENT_PREFIX_PATH", "bot"), ("ROS_PACKAGE_PATH", "bot/share")]
)
def test_the_installed_package_is_found_with_its_executable(
    make: Make, build: Build, tmp_path: Path, variable: str, folder: str
) -> None:
    make("bot", "ament_python", _FILES)
    build()
    prefix = tmp_path / "install" / "bot"
    environ = {variable: str(tmp_path / "install" / folder), "HOME": str(tmp_path)}
    package = Workspace.discover(environ=environ, cwd=prefix).package("bot")
    assert package.path == prefix / "share/bot"
    assert package.executable_names == ("talk",)


def test_a_missing_data_file_fails_and_installs_nothing(
    make: Make, build: Build, tmp_path: Path
) -> None:
    folder = make("bot", "ament_python", _FILES)
    (folder / "resource/bot").unlink()
    outcome = build()["bot"]
    assert outcome.code == 1
    assert "[package.install-missing]" in outcome.errors[0]
    assert "doesn't exist or not a regular file" in outcome.errors[0]
    assert not (tmp_path / "install" / "bot").exists()


def test_a_forgotten_index_marker_is_made_and_told(
    make: Make, build: Build, tmp_path: Path
) -> None:
    setup = "from setuptools import setup\nsetup(name='bot', packages=['bot'])\n"
    make("bot", "ament_python", {"setup.py": setup, "bot/__init__.py": ""})
    outcome = build()["bot"]
    assert outcome.code == 0
    assert "doesn't explicitly install a marker in the package index" in outcome.errors[0]
    assert "[package.index-marker]" in outcome.errors[0]
    assert (tmp_path / "install/bot/share/ament_index/resource_index/packages/bot").is_file()
    assert (tmp_path / "install/bot/share/bot/package.xml").is_file()


@pytest.mark.parametrize(
    ("files", "code", "words"),
    [
        ({}, "package.no-build-file", "has no setup.py"),
        ({"setup.py": "setup(\n"}, "package.setup-syntax", "setup.py is not Python 3"),
        ({"setup.py": "print('hello')\n"}, "package.no-build-file", "setup() is called nowhere"),
        (
            {"setup.py": "from setuptools import setup\nsetup(name='bot', packages=['bto'])\n"},
            "package.module",
            "module 'bto' is not there",
        ),
    ],
)
def test_what_setup_py_lacks_is_named(
    make: Make, build: Build, files: dict[str, str], code: str, words: str
) -> None:
    make("bot", "ament_python", files)
    outcome = build()["bot"]
    assert outcome.code == 1
    assert words in outcome.errors[0]
    assert f"[{code}]" in outcome.errors[0]


def test_an_entry_point_that_is_no_function_makes_no_program(
    make: Make, build: Build, tmp_path: Path
) -> None:
    setup = _SETUP.replace("talk = bot.talk:main", "talk = bot.talk main; import os")
    make("bot", "ament_python", {**_FILES, "setup.py": setup})
    outcome = build()["bot"]
    assert "is not 'name = package.module:function'" in outcome.errors[0]
    assert not (tmp_path / "install/bot/lib/bot").exists()


_COMPUTED = """import os
from setuptools import find_packages, setup
from setuptools.command.install import install
class Own(install):
    pass
def rows(top):
    return {os.path.join('share/bot', root): [os.path.join(root, name) for name in names]
            for root, _, names in os.walk(top)}
exec("name = 'bot'")
setup(
    name=name, version=open('VERSION').read().strip(), packages=find_packages('.', exclude=['t*']),
    data_files=[('share/bot', ['package.xml']), *rows('worlds').items()], cmdclass={'install': Own},
)
"""


def test_a_setup_py_that_computes_its_rules_is_run(
    make: Make, build: Build, tmp_path: Path
) -> None:
    files = {"setup.py": _COMPUTED, "VERSION": "2.0\n", "worlds/deep/a.world": "<sdf/>",
             "bot/__init__.py": "", "test/__init__.py": ""}  # fmt: skip
    make("bot", "ament_python", files)
    outcome = build()["bot"]
    assert outcome.code == 0
    prefix = tmp_path / "install/bot"
    assert (prefix / "share/bot/worlds/deep/a.world").read_text() == "<sdf/>"
    modules = prefix / site_packages()
    assert sorted(path.name.partition("-")[0] for path in modules.iterdir()) == ["bot", "bot"]
    (info,) = modules.glob("bot-2.0-*.egg-info")
    assert "Version: 2.0\n" in (info / "PKG-INFO").read_text()


def test_a_setup_py_that_cannot_be_run_is_told(make: Make, build: Build) -> None:
    make("bot", "ament_python", {"setup.py": _COMPUTED, "bot/__init__.py": ""})
    outcome = build()["bot"]
    text = "\n".join(outcome.errors)
    assert "running it fails: FileNotFoundError: [Errno 2] No such file or directory" in text
    assert "[package.install-unread]" in text


def test_setup_cfg_alone_can_say_it_all(make: Make, build: Build, tmp_path: Path) -> None:
    cfg = """[metadata]
name = bot
version = 3.1
[options]
packages = find:
package_dir =
    = lib
[options.packages.find]
where = lib
[options.data_files]
share/ament_index/resource_index/packages = resource/bot
share/bot =
    package.xml
share/bot/Launch = launch/*.py
[options.entry_points]
console_scripts =
    talk = bot.talk:main
[install]
install_scripts=$base/lib/bot
"""
    files = {"setup.py": "from setuptools import setup\nsetup()\n", "setup.cfg": cfg,
             "resource/bot": "", "launch/a.launch.py": "", "lib/bot/__init__.py": "",
             "lib/bot/talk.py": "def main(): pass\n"}  # fmt: skip
    make("bot", "ament_python", files)
    outcome = build()["bot"]
    assert (outcome.code, outcome.errors) == (0, ())
    prefix = tmp_path / "install/bot"
    assert (prefix / "share/bot/Launch/a.launch.py").is_file()
    assert (prefix / "lib/bot/talk").is_file()
    assert (prefix / site_packages() / "bot/talk.py").is_file()
    assert list((prefix / site_packages()).glob("bot-3.1-*"))
