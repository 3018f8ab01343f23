"""rosunit and rostest: running a program's own unittest cases, with ROS's result file."""

from __future__ import annotations

import sys
import time
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

__all__ = ["rosrun", "unitrun"]

_XML_OPTION = "--gtest_output=xml:"


def unitrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
    coverage_packages: Sequence[str] | None = None,
) -> None:
    """Run a test case, write the result file that ``--gtest_output`` names, and exit.

    Args:
        package: the package of the test, for the report.
        test_name: name of the report.
        test: a `unittest.TestCase`, or a name of one.
        sysargs: the program's arguments.
        coverage_packages: accepted; coverage is not measured.

    Raises:
        SystemExit: with 0 when all cases pass, 1 otherwise.
    """
    del coverage_packages
    words = list(sys.argv if sysargs is None else sysargs)
    load = unittest.defaultTestLoader
    cases = load.loadTestsFromName(test) if isinstance(test, str) else None
    suite = cases or load.loadTestsFromTestCase(test)
    started = time.monotonic()
    result = unittest.TextTestRunner(verbosity=2 if "--text" in words else 1).run(suite)
    target = next((word for word in words if word.startswith(_XML_OPTION)), None)
    if target is not None:
        seconds = time.monotonic() - started
        file = Path(target.removeprefix(_XML_OPTION))
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(_report(f"{package}.{test_name}", result, seconds), encoding="utf-8")
    raise SystemExit(0 if result.wasSuccessful() else 1)


def rosrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
) -> None:
    """Run a test case that is a node; see `unitrun`. The node ends with it."""
    from gazelle.compat.rospy.client import signal_shutdown

    try:
        unitrun(package, test_name, test, sysargs)
    finally:
        signal_shutdown("test complete")


def _report(name: str, result: unittest.TestResult, seconds: float) -> str:
    rows = []
    for kind, found in (("failure", result.failures), ("error", result.errors)):
        for case, text in found:
            # unittest writes its comparison below the line that says what was raised.
            said = [line for line in text.splitlines() if line[:1].isalpha()]
            last = quoteattr(said[-1] if said else text)
            case_name = quoteattr(case.id())
            rows.append(f"  <testcase name={case_name}><{kind} message={last}/></testcase>")
    counts = f'tests="{result.testsRun}" failures="{len(result.failures)}"'
    head = f'<testsuite name={quoteattr(name)} {counts} errors="{len(result.errors)}"'
    return "\n".join([f'{head} time="{seconds:.3f}">', *rows, "</testsuite>", ""])
