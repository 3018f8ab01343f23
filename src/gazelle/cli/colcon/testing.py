"""Running the Python tests of a package with pytest, in the environment of its workspace."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan, render_text
from gazelle.launch.environment import node_environment
from gazelle.workspace import Workspace
from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import site_packages

__all__ = ["package_environment", "test_package"]

_FOLDERS = ("test", "tests")
_PYTHON_CALLS = {"ament_add_pytest_test": 1, "catkin_add_nosetests": 0}
# Calls for tests that need a compiler, or tools that are not here.
_OTHER_CALLS = (
    "add_launch_test", "add_rostest", "add_rostest_gtest", "ament_add_gmock", "ament_add_gtest",
    "catkin_add_gmock", "catkin_add_gtest",
)  # fmt: skip
_FAILED, _NO_TESTS = 1, 5


def package_environment(install_base: Path, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of tests: the install space and Gazelle's own modules.

    Args:
        install_base: install space; it need not be there.
        environ: environment variables to start from.
    """
    prefixes = [install_base] if (install_base / "share").is_dir() else sorted(
        path for path in install_base.glob("*") if (path / "share").is_dir())  # fmt: skip
    modules = [path for prefix in prefixes if (path := prefix / site_packages()).is_dir()]
    found = dict(environ)
    for name, paths in (("AMENT_PREFIX_PATH", prefixes), ("PYTHONPATH", modules)):
        parts = [*map(str, paths), *filter(None, environ.get(name, "").split(os.pathsep))]
        found[name] = os.pathsep.join(dict.fromkeys(parts))
    return node_environment(found, Workspace.discover(environ=found))


def test_package(
    package: SourcePackage, results: Path, environ: Mapping[str, str], pytest_args: Sequence[str]
) -> Outcome:
    """Run a package's tests; that some fail is no failure of the run, their file tells.

    Args:
        package: whose tests.
        results: folder for ``pytest.xml``.
        environ: of the tests.
        pytest_args: more arguments for pytest.
    """
    begin = time.monotonic()
    diagnostics = Diagnostics()
    paths = _test_paths(package, diagnostics)
    results.mkdir(parents=True, exist_ok=True)
    (results / "pytest.xml").unlink(missing_ok=True)
    code, output, errors = 0, [], [render_text(item) for item in diagnostics]
    if paths and find_spec("pytest") is None:
        errors.append("pytest is not installed for the Python of Gazelle: pip install pytest")
        code = 1
    elif paths:
        words = [sys.executable, "-m", "pytest", f"--junit-xml={results / 'pytest.xml'}",
                 "-p", "no:cacheprovider", "-o", "junit_family=xunit2",
                 *pytest_args, *map(str, paths)]  # fmt: skip
        done = subprocess.run(
            words, cwd=package.path, env=dict(environ), text=True, check=False, errors="replace",
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        output = done.stdout.splitlines()
        code = 0 if done.returncode in {0, _FAILED, _NO_TESTS} else done.returncode
        errors += output if done.returncode not in {0, _NO_TESTS} else []
    return Outcome(package.name, code, time.monotonic() - begin, tuple(output), tuple(errors))


def _test_paths(package: SourcePackage, diagnostics: Diagnostics) -> list[Path]:
    if package.build_type == "ament_python":
        return [package.path / name for name in _FOLDERS if (package.path / name).is_dir()]
    lists = read_cmake_lists(package.path, package.name)
    if lists is None:
        return []
    paths = []
    for step in lists.called(*_PYTHON_CALLS, *_OTHER_CALLS):
        place = _PYTHON_CALLS.get(step.name)
        if place is not None and len(step.words) > place:
            paths.append(package.path / step.folder / step.words[place])
        elif place is None:
            _report(step.name, step.words, step.span, diagnostics)
    return paths


def _report(call: str, words: Sequence[str], span: SourceSpan, diagnostics: Diagnostics) -> None:
    text = f"test '{words[0] if words else ''}' of {call}() is not run: only Python tests are"
    diagnostics.report("build.test-not-run", text, span)
