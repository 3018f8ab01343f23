"""``colcon test`` and ``colcon test-result``: the Python tests of packages.

They run with pytest in the environment of their workspace; results are JUnit's XML files.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from gazelle.cli.colcon.events import Console, Log
from gazelle.cli.colcon.package_selection import add_package_options, chosen_packages, parser_for
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan, render_text
from gazelle.launch.environment import node_environment
from gazelle.workspace import Workspace
from gazelle.workspace.building.build import Outcome, run_jobs
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import site_packages

__all__ = [
    "run",
]

_FOLDERS = ("test", "tests")
_PYTHON_CALLS = {"ament_add_pytest_test": 1, "catkin_add_nosetests": 0}
# Calls for tests that need a compiler, or tools that are not here.
_OTHER_CALLS = (
    "add_launch_test", "add_rostest", "add_rostest_gtest", "ament_add_gmock", "ament_add_gtest",
    "catkin_add_gmock", "catkin_add_gtest",
)  # fmt: skip
_FAILED, _NO_TESTS = 1, 5


class _Counts(NamedTuple):
    """How many tests did what."""

    tests: int = 0
    errors: int = 0
    failures: int = 0
    skipped: int = 0

    def __str__(self) -> str:
        counts = [
            f"{self.tests} test{'' if self.tests == 1 else 's'}",
            f"{self.errors} error{'' if self.errors == 1 else 's'}",
            f"{self.failures} failure{'' if self.failures == 1 else 's'}",
            f"{self.skipped} skipped",
        ]
        return ", ".join(counts)

    @property
    def is_bad(self) -> bool:
        """A test failed."""
        return bool(self.errors or self.failures)


class _FileResult(NamedTuple):
    """One file: its counts, and the tests that failed in it."""

    file: Path
    counts: _Counts
    failures: tuple[str, ...]


def _package_environment(install_base: Path, environ: Mapping[str, str]) -> dict[str, str]:
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


def _test_package(
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
        command = [sys.executable, "-m", "pytest", f"--junit-xml={results / 'pytest.xml'}",
                 "-p", "no:cacheprovider", "-o", "junit_family=xunit2",
                 *pytest_args, *map(str, paths)]  # fmt: skip
        done = subprocess.run(
            command, cwd=package.path, env=dict(environ), text=True, check=False, errors="replace",
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        output = done.stdout.splitlines()
        code = 0 if done.returncode in {0, _FAILED, _NO_TESTS} else done.returncode
        errors += output if done.returncode not in {0, _NO_TESTS} else []
    return Outcome(package.name, code, time.monotonic() - begin, tuple(output), tuple(errors))


def _read_results(folder: Path) -> tuple[_Counts, tuple[_FileResult, ...]]:
    """Return the sum and each file of the results below a folder; other XML files are left out."""
    results = []
    for file in sorted(folder.rglob("*.xml")):
        root = read_xml(file, Diagnostics())
        if root is not None and root.name in {"testsuites", "testsuite"}:
            cases = list(_cases(root))
            counts = _Counts(
                len(cases),
                *(sum(any(tag.name == kind for tag in case.children) for case in cases)
                  for kind in ("error", "failure", "skipped")),
            )  # fmt: skip
            results.append(_FileResult(file, counts, tuple(_failures(cases))))
    total = _Counts(*(sum(column) for column in zip(*(r.counts for r in results), strict=True)))
    return total, tuple(results)


def run(argv: list[str], log_base: Path) -> int:
    """Run the verb that the first word names."""
    return _test(argv[1:], log_base) if argv[0] == "test" else _result(argv[1:])


def _test_paths(package: SourcePackage, diagnostics: Diagnostics) -> list[Path]:
    if package.build_type == "ament_python":
        return [package.path / name for name in _FOLDERS if (package.path / name).is_dir()]
    lists = read_cmake_lists(package.path, package.name)
    if lists is None:
        return []
    paths = []
    for step in lists.called(*_PYTHON_CALLS, *_OTHER_CALLS):
        index = _PYTHON_CALLS.get(step.name)
        if index is not None and len(step.arguments) > index:
            paths.append(package.path / step.folder / step.arguments[index])
        elif index is None:
            _report(step.name, step.arguments, step.span, diagnostics)
    return paths


def _report(
    call: str, arguments: Sequence[str], span: SourceSpan, diagnostics: Diagnostics
) -> None:
    text = (
        f"test '{arguments[0] if arguments else ''}' of {call}() is not run: only Python tests are"
    )
    diagnostics.report("build.test-not-run", text, span)


def _cases(tag: Tag) -> list[Tag]:
    if tag.name == "testcase":
        return [tag]
    return [case for child in tag.children for case in _cases(child)]


def _failures(cases: list[Tag]) -> list[str]:
    found = []
    for case in cases:
        names = (case.attributes.get("classname", ""), case.attributes.get("name", ""))
        for child in case.children:
            if child.name in {"error", "failure"}:
                message = child.attributes.get("message", "").partition("\n")[0]
                found.append(f"{' '.join(filter(None, names))}: {message}")
    return found


def _test(argv: Sequence[str], log_base: Path) -> int:
    begin = time.monotonic()
    parser = parser_for("test", "Run the Python tests of packages.")
    add = parser.add_argument
    add("--build-base", type=Path, default=Path("build"), help="where results go (build)")
    add("--install-base", type=Path, default=Path("install"), help="where packages are (install)")
    add("--return-code-on-test-failure", action="store_true", help="end with 1 when a test fails")
    add("--parallel-workers", type=int, default=os.cpu_count() or 1, metavar="NUMBER")
    add("--event-handlers", nargs="*", default=[], metavar="NAME+|NAME-")
    add("--pytest-args", nargs="*", default=[], metavar="ARG", help="arguments for pytest")
    add_package_options(parser)
    options = parser.parse_args(argv)
    everything, chosen = chosen_packages(options)
    console = Console(options.event_handlers)
    log = Log(log_base if console.writes_log else Path("/dev/null"), "test")
    environ = _package_environment(options.install_base.absolute(), os.environ)

    def ended(outcome: Outcome) -> None:
        console.ended(outcome)
        log.keep(outcome)

    left = run_jobs(
        chosen,
        lambda item: _test_package(
            item, options.build_base.absolute() / item.name, environ, options.pytest_args
        ),
        everything=everything,
        workers=options.parallel_workers,
        started=console.started,
        ended=ended,
        continue_on_error=True,
    )
    failed = [name for name in (item.name for item in chosen)
              if _read_results(options.build_base / name)[0].is_bad]  # fmt: skip
    console.summary(time.monotonic() - begin, left)
    if failed:
        count = "1 package" if len(failed) == 1 else f"{len(failed)} packages"
        print(f"  {count} had test failures: {' '.join(failed)}")
    bad = any(outcome.code for outcome in console.outcomes)
    return 1 if bad or (failed and options.return_code_on_test_failure) else 0


def _result(argv: Sequence[str]) -> int:
    parser = parser_for("test-result", "Show a summary of test results.")
    parser.add_argument("--test-result-base", type=Path, default=Path("build"))
    parser.add_argument("--all", action="store_true", help="files without failures too")
    parser.add_argument("--verbose", action="store_true", help="what failed")
    options = parser.parse_args(argv)
    if not options.test_result_base.is_dir():
        print(f"the test result base '{options.test_result_base}' does not exist", file=sys.stderr)
        return 1
    total, files = _read_results(options.test_result_base)
    for file, counts, failures in files:
        if counts.is_bad or options.all:
            print(f"{os.path.relpath(file)}: {counts}")
        for text in failures if options.verbose else ():
            print(f"- {text}")
    if files and (total.is_bad or options.all):
        print()
    print(f"Summary: {total}")
    return 1 if total.is_bad else 0
