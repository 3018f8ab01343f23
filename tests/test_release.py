"""What a release is: the same files each time, and what is in them works where nothing else is."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from pathlib import Path
from types import ModuleType

import pytest
from tests.ci_scripts import ci_script

ROOT = Path(__file__).parents[1]
_STAMP_S = 1_800_000_000
_DRIVE = """
import gazelle
with gazelle.Simulation.load("unit_box", world="empty") as sim:
    sim.run(seconds=0.1)
    print(gazelle.__file__, sim.time_s, len(sim.state_hash()))
"""


@pytest.fixture(scope="module")
def release() -> ModuleType:
    """The script that builds a release, as a module."""
    return ci_script("release")


@pytest.fixture(scope="module")
def built(release: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with wheel and sdist of this very tree."""
    out = tmp_path_factory.mktemp("dist")
    release.build(ROOT, out, _STAMP_S)
    return out


def test_the_same_tree_gives_the_same_files(release: ModuleType, built: Path, tmp_path) -> None:
    first = {path.name: path.read_bytes() for path in built.iterdir()}
    assert len(first) == 2
    release.build(ROOT, tmp_path, _STAMP_S)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == first


def test_the_sdist_holds_what_its_tests_look_at(built: Path) -> None:
    (path,) = built.glob("*.tar.gz")
    with tarfile.open(path) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    wanted = {".ci/pages.py", "CONTRIBUTING.md", "NOTICE", "studio/package-lock.json"}
    assert wanted | {"tests/conftest.py", "docs/architecture.md", "mkdocs.yml"} <= names
    assert not [name for name in names if "node_modules/" in name or "__pycache__" in name]


def test_the_wheel_works_where_nothing_of_the_repository_is(built: Path, tmp_path) -> None:
    (wheel,) = built.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {"gazelle/studio/page/index.html", "gazelle/studio/page/built_from.txt"} <= set(names)
    environment = tmp_path / "venv"
    venv.create(environment, with_pip=True, symlinks=sys.platform != "win32")
    python = environment / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    _run(python, "-m", "pip", "install", "--no-deps", "--no-index", str(wheel))
    # What it depends on comes from the environment of the tests; a path in a .pth file brings
    # packages that lie there, and not what such files there name: the repository is not seen.
    own = _run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip()
    (Path(own) / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
    file, time_s, length = _run(python, "-c", _DRIVE).split()
    assert Path(file).is_relative_to(environment)
    assert (float(time_s), int(length)) == (pytest.approx(0.1), 64)
    assert _run(python, "-m", "gazelle.cli", "--version").startswith("gazelle ")


def test_a_tag_needs_its_version_and_its_section(release: ModuleType, tmp_path) -> None:
    (tmp_path / "src" / "gazelle").mkdir(parents=True)
    version = tmp_path / "src" / "gazelle" / "_version.py"
    version.write_text('"""The version."""\n\n__version__ = "0.3.0"\n')
    (tmp_path / "CHANGELOG.md").write_text("## [Unreleased]\n\n## [0.3.0] - 2027-01-31\n")
    assert release.problems(tmp_path, "v0.3.0") == []
    assert release.problems(tmp_path, "v0.4.0") == [
        "src/gazelle/_version.py says 0.3.0, the tag 0.4.0",
        "CHANGELOG.md has no line '## [0.4.0] - YYYY-MM-DD'",
    ]


def _run(*command: str | Path) -> str:
    done = subprocess.run(
        [str(one) for one in command], capture_output=True, text=True, check=False,
        cwd=Path(command[0]).parent,
        env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
