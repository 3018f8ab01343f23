"""ament_index_python, over a source tree and an installed one."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from gazelle.launch.environment import drop_in_folder
from gazelle.workspace import ament_index

_MANIFEST = "<package format='3'><name>{}</name><version>1.0.0</version></package>"


@pytest.fixture
def places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A workspace with package ``mine`` and a prefix with package ``theirs``."""
    source = tmp_path / "ws" / "src" / "mine"
    share = tmp_path / "opt" / "share"
    for folder, name in ((source, "mine"), (share / "theirs", "theirs")):
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(name))
    index = share / "ament_index" / "resource_index"
    for kind in ("packages", "rviz_plugins"):
        (index / kind).mkdir(parents=True)
        (index / kind / "theirs").write_text("plugins.xml" if kind == "rviz_plugins" else "")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "opt"))
    monkeypatch.chdir(tmp_path / "ws")
    ament_index.known_workspace.cache_clear()
    yield tmp_path
    ament_index.known_workspace.cache_clear()


def test_packages_of_sources_and_prefixes_are_found(places: Path) -> None:
    share = ament_index.get_package_share_directory
    assert share("mine") == str(places / "ws/src/mine")
    assert share("theirs") == str(places / "opt/share/theirs")
    assert ament_index.get_package_share_path("mine") == places / "ws/src/mine"
    assert ament_index.get_package_prefix("theirs") == str(places / "opt")
    assert ament_index.get_packages_with_prefixes()["theirs"] == str(places / "opt")
    assert ament_index.get_search_paths() == [str(places / "opt")]


def test_index_is_read(places: Path) -> None:
    opt = str(places / "opt")
    assert ament_index.get_resource("rviz_plugins", "theirs") == ("plugins.xml", opt)
    assert ament_index.get_resources("rviz_plugins") == {"theirs": opt}
    assert ament_index.has_resource("packages", "theirs") == opt
    assert ament_index.has_resource("packages", "nobody") is False
    assert ament_index.get_resource_types() == {"packages", "rviz_plugins"}
    with pytest.raises(LookupError, match=r"resource 'their' of type 'rviz.*did you mean 'theirs'"):
        ament_index.get_resource("rviz_plugins", "their")


@pytest.mark.usefixtures("places")
def test_unknown_package_is_named_with_the_nearest() -> None:
    with pytest.raises(ament_index.PackageNotFoundError) as caught:
        ament_index.get_package_share_directory("thiers")
    text = str(caught.value)
    assert text.startswith("package 'thiers' not found, searching: [") and "'theirs'" in text
    with pytest.raises(ValueError, match="'a b' is not a valid package name"):
        ament_index.get_package_prefix("a b")


@pytest.mark.usefixtures("places")
def test_entries_are_names_and_no_paths() -> None:
    with pytest.raises(ament_index.InvalidResourceTypeNameError, match="'a/b' is invalid"):
        ament_index.get_resources("a/b")
    with pytest.raises(ament_index.InvalidResourceNameError, match=r"name '.*' is invalid"):
        ament_index.get_resource("packages", "../x")
    with pytest.raises(ament_index.InvalidResourceNameError, match=r"name '.*' is invalid"):
        ament_index.has_resource("packages", "../x")


def test_hidden_files_of_the_index_are_no_entries(places: Path) -> None:
    folder = places / "opt" / ament_index.RESOURCE_INDEX_SUBFOLDER / "rviz_plugins"
    (folder / ".hidden").write_text("")
    assert list(ament_index.get_resources("rviz_plugins")) == ["theirs"]


def test_drop_in_has_the_modules_and_names_of_the_original(
    places: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(drop_in_folder()))
    names = {"": 13, "packages": 5, "resources": 6, "search_paths": 1, "constants": 2, "cli": 1}
    found = {name: import_module(f"ament_index_python.{name}".rstrip(".")) for name in names}
    assert {name: len(module.__all__) for name, module in found.items()} == names
    assert found[""].PackageNotFoundError is ament_index.PackageNotFoundError
    assert found["cli"].main([]) is None
    assert found["cli"].main(["rviz_plugins"]) is None
    assert found["cli"].main(["rviz_plugins", "theirs"]) is None
    assert found["cli"].main(["rviz_plugins", "theire"]).endswith("did you mean 'theirs'?")
    opt = places / "opt"
    shown = ["packages", "rviz_plugins", f"theirs\t{opt}", str(opt), "<<<", "plugins.xml", ">>>"]
    assert capsys.readouterr().out.splitlines() == shown
