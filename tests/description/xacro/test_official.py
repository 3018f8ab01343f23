from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from tests.shared_files import SHARED, needs_shared, shared_cases

from gazelle.cli.xacro import main
from gazelle.workspace import Workspace

from .official import Outcome, run_official

HEAD = '<robot name="f" xmlns:xacro="http://www.ros.org/wiki/xacro">'
ROBOTS = Path(__file__).parent / "robots"
TESTS = Path(__file__).parents[2]


class Program:
    """Runs our program in this process."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *words: str) -> Outcome:
        code = main(list(words))
        out, err = self._capsys.readouterr()
        return Outcome(code, out, err)


@pytest.fixture
def ours(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> Program:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return Program(capsys)


@needs_shared
@pytest.mark.reference
def test_48_features_equal_the_official_program(
    oracles_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ours: Program
) -> None:
    features, folder = _features(oracles_dir), oracles_dir / "xacro" / "inputs"
    recorded = re.findall(
        r"^(\S.*?)\s+xacro rc=(\d)",
        (oracles_dir / "xacro" / "features.txt").read_text("utf-8"),
        re.MULTILINE,
    )
    assert [name for name, _ in recorded] == list(features)
    assert len(features) == 48
    for name in ("inc.xacro", "conf.yaml"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    files = [f"f{number}.xacro" for number in range(48)]
    for file, text in zip(files, features.values(), strict=True):
        (tmp_path / file).write_text(f"{HEAD}{text}</robot>", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    official = run_official([[file] for file in files], tmp_path)
    for (name, code), file, theirs in zip(recorded, files, official, strict=True):
        mine = ours(file)
        assert str(mine.code) == str(theirs.code) == code, name
        assert mine.out == theirs.out, name
        if not mine.code:
            assert mine.err == theirs.err, name
        elif name != "$(find)":
            assert mine.err.startswith(theirs.err), name


def _features(oracles_dir: Path) -> dict[str, str]:
    """Return the table of features in the script that made the recording."""
    script = oracles_dir / "xacro" / "inputs" / "one.py"
    for node in ast.parse(script.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "F":
            table: dict[str, str] = ast.literal_eval(node.value)
            return table
    raise AssertionError("the script has no table F")


@pytest.mark.reference
@pytest.mark.parametrize(
    "folder",
    [
        *(TESTS.parent / "examples" / name for name in ("arm_ws", "four_wheel_ws", "scout_ws")),
        TESTS / "workspaces" / "ros1",
        *shared_cases(
            *(SHARED / "workspaces" / name for name in ("catkin_ws", "turtlebot3_ws", "ros2_ws"))
        ),
    ],
    ids=lambda folder: folder.name,
)
def test_robots_of_the_workspaces_equal_the_official_program(
    folder: Path, monkeypatch: pytest.MonkeyPatch, ours: Program
) -> None:
    monkeypatch.chdir(folder)
    files = sorted(str(path.relative_to(folder)) for path in folder.rglob("*.xacro"))
    assert files
    packages = {item.name: str(item.path) for item in Workspace.discover().packages.values()}
    official = run_official([[file] for file in files], folder, packages)
    for file, theirs in zip(files, official, strict=True):
        mine = ours(file)
        assert mine.code == theirs.code, file
        assert mine.out == theirs.out, file
        assert mine.err.startswith(theirs.err), file


FIELD = [
    ["arm/arm.urdf.xacro"],
    ["arm/arm.urdf.xacro", "prefix:=left_", "safety:=true"],
    ["rover/rover.urdf.xacro"],
    ["sensors/sensors.urdf.xacro"],
    ["sensors/sensors.urdf.xacro", "lidar:=false", "camera:=mono", "rate:=2"],
    ["sensors/sensors.urdf.xacro", "camera:=none"],
    ["namespaces/two.urdf.xacro"],
    ["scopes/scopes.urdf.xacro"],
    ["dynamic/dynamic.urdf.xacro"],
    ["dynamic/dynamic.urdf.xacro", "kind:=box"],
    ["lazy/lazy.urdf.xacro"],
    ["launchlike/robot.urdf.xacro", "robot:="],
    ["launchlike/robot.urdf.xacro", "robot:=r2", "_private:=1"],
    ["loops/grid.sdf.xacro"],
    ["reuse/reuse.urdf.xacro"],
    ["--deps", "arm/arm.urdf.xacro"],
    ["--root-dir", "rover", "rover.urdf.xacro"],
    ["-i", "rover/rover.urdf.xacro"],
    ["-q", "scopes/scopes.urdf.xacro"],
    ["--verbosity", "0", "rover/rover.urdf.xacro"],
    ["--verbosity=3", "lazy/lazy.urdf.xacro"],
    ["-v", "-v", "-v", "scopes/scopes.urdf.xacro"],
]


@pytest.mark.reference
def test_robots_of_our_own_equal_the_official_program(
    monkeypatch: pytest.MonkeyPatch, ours: Program
) -> None:
    monkeypatch.chdir(ROBOTS)
    for words, theirs in zip(FIELD, run_official(FIELD, ROBOTS), strict=True):
        mine = ours(*words)
        assert mine.code == theirs.code, words
        if "--deps" in words:
            assert set(mine.out.split(" ")) == set(theirs.out.split(" "))
            continue
        assert mine.out == theirs.out, words
        assert _unaddressed(mine.err).startswith(_unaddressed(theirs.err)), words
        assert bool(mine.code) == ("dynamic" in words[0] and words[-1] == "kind:=box")


def _unaddressed(text: str) -> str:
    return re.sub(r"0x[0-9a-f]+", "0x", text)


USAGE = [
    ["-h"],
    ["--help"],
    [],
    ["a.xacro", "b.xacro"],
    ["a.xacro", "--nope"],
    ["a.xacro", "-o"],
    ["a.xacro", "--verbosity", "loud"],
    ["nope.xacro"],
    ["-q", "nope.xacro"],
    ["a:=b:=c", "nope.xacro"],
]


@pytest.mark.reference
def test_help_and_wrong_calls_equal_the_official_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ours: Program
) -> None:
    monkeypatch.chdir(tmp_path)
    for words, theirs in zip(USAGE, run_official(USAGE, tmp_path), strict=True):
        mine = ours(*words)
        assert (mine.code, mine.out) == (theirs.code, theirs.out), words
        assert mine.err.startswith(theirs.err), words
