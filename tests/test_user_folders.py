from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import platformdirs
import pytest
from platformdirs.macos import MacOS
from platformdirs.unix import Unix

from gazelle.user_folders import (
    cache_folder,
    config_folder,
    ros_home,
    ros_log_folder,
    runtime_folder,
    state_folder,
)

FOLDERS = {"CACHE": cache_folder, "CONFIG": config_folder, "STATE": state_folder}


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in FOLDERS:
        monkeypatch.delenv(f"XDG_{name}_HOME", raising=False)
    return tmp_path


@pytest.mark.parametrize(
    ("system", "places"),
    [
        (Unix, {"CACHE": ".cache", "CONFIG": ".config", "STATE": ".local/state"}),
        (
            MacOS,
            {
                "CACHE": "Library/Caches",
                "CONFIG": "Library/Application Support",
                "STATE": "Library/Application Support",
            },
        ),
    ],
)
def test_a_system_has_its_own_places(
    system: type, places: dict[str, str], home: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(platformdirs, "PlatformDirs", system)
    assert {name: folder() for name, folder in FOLDERS.items()} == {
        name: home / place / "gazelle" for name, place in places.items()
    }


@pytest.mark.parametrize("system", [Unix, MacOS])
@pytest.mark.parametrize("name", sorted(FOLDERS))
@pytest.mark.parametrize("place", ["/else/where", "here"])
def test_the_environment_names_places_on_every_system(
    system: type, name: str, place: str, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(platformdirs, "PlatformDirs", system)
    monkeypatch.setenv(f"XDG_{name}_HOME", place)
    assert FOLDERS[name]() == Path(place) / "gazelle"


def test_an_empty_name_is_none(home: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(platformdirs, "PlatformDirs", Unix)
    monkeypatch.setenv("XDG_CACHE_HOME", "")
    assert cache_folder() == home / ".cache" / "gazelle"
    monkeypatch.setenv("XDG_RUNTIME_DIR", "")
    assert runtime_folder() is None


def test_a_user_without_a_home_has_no_folder(monkeypatch: pytest.MonkeyPatch):
    class Homeless(Unix):
        @property
        def user_cache_path(self) -> Path:
            return Path("~/.cache/gazelle")

    monkeypatch.setattr(platformdirs, "PlatformDirs", Homeless)
    with pytest.raises(RuntimeError, match="Could not determine home directory"):
        cache_folder()


def test_ros_has_its_own_rules(home: Path):
    assert ros_home({}) == home / ".ros"
    assert ros_log_folder({}) == home / ".ros" / "log"
    assert ros_log_folder({"ROS_HOME": "/h"}) == Path("/h/log")
    assert ros_log_folder({"ROS_HOME": "/h", "ROS_LOG_DIR": "/l"}) == Path("/l")


def test_who_names_a_folder_does_not_wait_for_a_library():
    code = (
        "import sys; from gazelle.user_folders import *; cache_folder(); ros_log_folder({}); "
        "print('platformdirs' in sys.modules)"
    )
    environ = {"XDG_CACHE_HOME": "/tmp/c", "HOME": "/"}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environ
    )
    assert done.stdout == "False\n"
