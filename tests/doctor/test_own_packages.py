"""The examples and what `gazelle new` writes: nothing is wrong with them, however one asks."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.description.source_maps import remember
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor import Options, examine
from gazelle.workspace import Workspace
from gazelle.workspace.environment_paths import BUILTIN, builtin_package_names
from gazelle.workspace.scaffold.create_package import FILES, create_package

EXAMPLES = Path(__file__).parents[2] / "examples"
_FILES = (".launch", ".launch.py", ".sdf", ".srdf", ".urdf", ".world", ".xacro", ".xml", ".yaml")
_LAUNCHES = (".launch", ".launch.py")
_ROBOTS = (".urdf.xacro", ".urdf", ".world")
# Written as for the PR2, whose transmissions had no interface: what the doctor says is true.
_TRUE = {"tandem_controller": {"control.hardware-interface-missing"}}
_ARGUMENTS = {"navigate.launch": {"map_file": "{folder}/map.yaml"}}
_MAP = "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"
_MAP += "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
_NAMES = [
    *(path.name for path in sorted(EXAMPLES.glob("*_ws"))),
    *(f"new-{kind}-ros{version}" for kind, version in FILES),
]


@pytest.fixture(params=_NAMES)
def folder(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A workspace with an example, or with a new package."""
    if request.param in {path.name for path in EXAMPLES.glob("*_ws")}:
        shutil.copytree(EXAMPLES / request.param, tmp_path / "ws")
    else:
        _, kind, ros = request.param.split("-")
        version = 1 if ros == "ros1" else 2
        create_package(kind, "my_thing", tmp_path / "ws" / "src", ros_version=version)
    (tmp_path / "ws" / "map.yaml").write_text(_MAP)
    (tmp_path / "ws" / "map.pgm").write_bytes(b"P5 2 2 255\n" + bytes(4))
    return tmp_path / "ws"


def _told(cwd: Path, *words: str, probe: bool = False) -> list[str]:
    """Return what is told of a target that nobody should have to read."""
    arguments = {
        name: text.format(folder=_top(cwd))
        for name, text in (_ARGUMENTS.get(Path(words[-1]).name, {}) if words else {}).items()
    }
    environ = {"HOME": str(_top(cwd)), "PATH": "/usr/bin:/bin"}
    report = examine(words, options=Options(arguments, probe, environ=environ), cwd=cwd)
    return [str(item) for item in report.findings if not _may_be_told(item)]


def _top(path: Path) -> Path:
    return next(place for place in (path, *path.parents) if (place / "map.yaml").exists())


def _may_be_told(item: Diagnostic) -> bool:
    own = next((codes for name, codes in _TRUE.items() if f"/{name}/" in str(item.span)), set())
    if item.severity is not Severity.INFO:
        return item.code in own
    is_ours = item.span is not None and Path(item.span.file).is_relative_to(BUILTIN)
    is_missing = item.code.endswith("packages-elsewhere") and any(
        f" {name}" in item.message for name in builtin_package_names()
    )
    return not is_ours and not is_missing


def _packages(folder: Path) -> list[Path]:
    return sorted((folder / "src").iterdir())


def _files(folder: Path, endings: tuple[str, ...]) -> Iterator[Path]:
    for package in _packages(folder):
        yield from (path for path in sorted(package.rglob("*")) if path.name.endswith(endings))


def test_nothing_is_wrong_with_a_package(folder: Path) -> None:
    for package in _packages(folder):
        assert _told(folder, package.name) == []


def test_nothing_is_wrong_with_a_launch(folder: Path) -> None:
    for file in _files(folder, _LAUNCHES):
        assert _told(folder, str(file)) == []


def test_nothing_is_undeclared_or_not_installed(folder: Path) -> None:
    environ = {"HOME": str(folder), "PATH": "/usr/bin:/bin"}
    report = examine([], options=Options(environ=environ), cwd=folder)
    assert not [item for item in report.findings if item.code.startswith("package.")]


@pytest.mark.slow(15)
def test_nothing_is_wrong_with_any_file_on_its_own(folder: Path) -> None:
    for file in _files(folder, _FILES):
        assert _told(folder, str(file.relative_to(folder))) == []
        assert _told(file.parent, file.name) == []


@pytest.mark.slow(10)
def test_nothing_is_wrong_from_another_folder(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "map.yaml").write_text(_MAP)
    for package in _packages(folder):
        assert _told(package) == []
        assert _told(tmp_path / "elsewhere", str(package)) == []
    for file in _files(folder, _FILES):
        if not file.name.startswith("navigate"):
            assert _told(tmp_path / "elsewhere", str(file)) == []


@pytest.mark.slow(15)
def test_nothing_is_wrong_by_the_probes(folder: Path) -> None:
    for file in _files(folder, (*_ROBOTS, *_LAUNCHES)):
        assert _told(folder, str(file), probe=True) == []


@pytest.mark.slow(10)
@pytest.mark.parametrize("is_remembered", [False, True], ids=["by-others", "by-us"])
def test_nothing_is_wrong_with_an_expanded_robot(folder: Path, is_remembered: bool) -> None:
    environ = {"HOME": str(folder), "PATH": "/usr/bin:/bin"}
    workspace = Workspace.discover(environ=environ, cwd=folder)
    for file in list(_files(folder, (".urdf.xacro",))):
        expanded = expand_xacro(file, mappings={}, workspace=workspace, diagnostics=Diagnostics())
        assert expanded is not None
        if is_remembered:
            remember(expanded)
        plain = file.with_name("expanded.urdf")
        plain.write_text(expanded.text)
        assert _told(folder, str(plain)) == []
        assert _told(folder, str(plain), probe=True) == []
        assert _told(folder, file.parent.parent.name) == []
