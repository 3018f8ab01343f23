"""rostest and rosunit for Python tests: ``rostest.rosrun(PKG, NAME, TestClass)``.

Results are written as JUnit XML, which ``rostest`` and build servers read.
"""

from __future__ import annotations

import sys
import time
import traceback
import unittest
from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple
from xml.sax.saxutils import escape, quoteattr

from gazelle.compat.warn_once import warn_once

__all__ = ["result_file", "rosrun", "run", "run_suite", "unitrun", "xml_text"]

_OPTION = "--gtest_output=xml:"


class _Case(NamedTuple):
    classname: str
    name: str
    seconds: float
    problem: str = ""
    kind: str = ""
    text: str = ""


class _Result(unittest.TextTestResult):
    """Keeps what each test came to."""

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self.cases: list[_Case] = []
        self._start_s = 0.0

    def startTest(self, test: unittest.TestCase) -> None:
        """Note the time."""
        self._start_s = time.perf_counter()
        super().startTest(test)

    def addSuccess(self, test: unittest.TestCase) -> None:
        """Keep a test that passed."""
        super().addSuccess(test)
        self._keep(test)

    def addSkip(self, test: unittest.TestCase, reason: str) -> None:
        """Keep a test that was left out; nothing is wrong with it."""
        super().addSkip(test, reason)
        self._keep(test)

    def addFailure(self, test: unittest.TestCase, err: Any) -> None:
        """Keep a test whose assertion failed."""
        super().addFailure(test, err)
        self._keep(test, "failure", err)

    def addError(self, test: Any, err: Any) -> None:
        """Keep a test that raised something else."""
        super().addError(test, err)
        self._keep(test, "error", err)

    def addSubTest(self, test: Any, subtest: Any, err: Any) -> None:
        """Keep a part of a test that failed."""
        super().addSubTest(test, subtest, err)
        if err is not None:
            is_failure = issubclass(err[0], test.failureException)
            self._keep(subtest, "failure" if is_failure else "error", err)

    def _keep(self, test: Any, problem: str = "", err: Any = None) -> None:
        # Parts of a test have their values in brackets behind the name.
        path, bracket, values = test.id().partition(" (")
        classname, _, name = path.rpartition(".")
        seconds = time.perf_counter() - self._start_s
        kind = err[0].__name__ if err else ""
        text = "".join(traceback.format_exception(*err)) if err else ""
        self.cases.append(_Case(classname, name + bracket + values, seconds, problem, kind, text))


def result_file(argv: Iterable[str]) -> Path | None:
    """Return the file that ``--gtest_output=xml:FILE`` names, None without it."""
    found = [argument.removeprefix(_OPTION) for argument in argv if argument.startswith(_OPTION)]
    return Path(found[-1]) if found else None


def run_suite(suite: unittest.TestSuite, name: str, file: Path | None) -> bool:
    """Run tests, write their results, and return whether all passed.

    Args:
        suite: the tests.
        name: of the suite in the XML.
        file: where the XML goes, None for nowhere.
    """
    start_s = time.perf_counter()
    runner = unittest.TextTestRunner(sys.stdout, verbosity=2, resultclass=_Result)
    result = runner.run(suite)
    assert isinstance(result, _Result)
    if file is not None:
        file.parent.mkdir(parents=True, exist_ok=True)
        text = xml_text(name, result.cases, time.perf_counter() - start_s)
        file.write_text(text, encoding="utf-8")
    return result.wasSuccessful()


def xml_text(name: str, cases: Iterable[Any], seconds: float) -> str:
    """Return a ``<testsuite>``; each case has classname, name, seconds, problem, kind, text."""
    rows = list(cases)
    counts = {kind: sum(one.problem == kind for one in rows) for kind in ("error", "failure")}
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        f'<testsuite errors="{counts["error"]}" failures="{counts["failure"]}" '
        f'name={quoteattr(name)} tests="{len(rows)}" time="{seconds:.3f}">',
    ]
    for one in rows:
        head = (
            f"  <testcase classname={quoteattr(one.classname)} name={quoteattr(one.name)} "
            f'time="{one.seconds:.4f}"'
        )
        if not one.problem:
            lines.append(f"{head}/>")
            continue
        lines += [
            f"{head}>",
            f"    <{one.problem} type={quoteattr(one.kind)}>{escape(one.text)}</{one.problem}>",
            "  </testcase>",
        ]
    return "\n".join([*lines, "</testsuite>", ""])


def rosrun(package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None) -> None:
    """Run a test case as a ``<test>`` node, which ends with it; exit code 1 when it fails.

    Args:
        package: the package it belongs to.
        test_name: its name.
        test: a ``TestCase`` class, or its name ``module.Class``.
        sysargs: the command line, ``sys.argv`` by default.
    """
    from gazelle.compat.rospy.client import signal_shutdown

    try:
        _run(package, test_name, test, sys.argv if sysargs is None else sysargs)
    finally:
        signal_shutdown("test complete")


def unitrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
    coverage_packages: Any = None,
) -> None:
    """Run a test case that needs no graph (`rosunit.unitrun`).

    Args:
        package: the package it belongs to.
        test_name: its name.
        test: a ``TestCase`` class, or its name ``module.Class``.
        sysargs: the command line, ``sys.argv`` by default.
        coverage_packages: told once: coverage is not measured.
    """
    if coverage_packages:
        warn_once("unitrun: coverage is not measured; run the tests with `coverage run`")
    _run(package, test_name, test, sys.argv if sysargs is None else sysargs)


run = rosrun


def _run(package: str, test_name: str, test: Any, argv: Sequence[str]) -> None:
    loader = unittest.TestLoader()
    if isinstance(test, str):
        module, _, name = test.rpartition(".")
        test = getattr(import_module(module), name)
    suite = (
        loader.loadTestsFromTestCase(test)
        if isinstance(test, type) and issubclass(test, unittest.TestCase)
        else unittest.TestSuite([test()])
    )
    if not run_suite(suite, f"{package}.{test_name}", result_file(argv)):
        sys.exit(1)
