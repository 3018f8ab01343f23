"""What the tests of a launch came to, also as JUnit XML."""

from __future__ import annotations

import time
import unittest
import xml.etree.ElementTree as ET  # writing only
from collections.abc import Mapping
from typing import Any

from gazelle.launch.ros2.launch_testing.loader import TestRun

__all__ = ["FailResult", "SkipResult", "TestResult", "unittestResultsToXml"]

_DIGITS = 3


class _WithTimes(unittest.TestResult):
    """Knows how long each test took.

    Attributes:
        testTimes: seconds by test.
    """

    def __init__(self, *argv: Any, **options: Any) -> None:
        super().__init__(*argv, **options)
        self.testTimes: dict[Any, float] = {}

    @property
    def testCases(self) -> list[Any]:
        """The tests."""
        return list(self.testTimes)


class FailResult(_WithTimes):
    """All tests of a run failed, since its launch did."""

    def __init__(self, test_run: TestRun, message: str) -> None:
        super().__init__()
        for case in test_run.all_cases():
            self.addFailure(case, (Exception, Exception(message), None))  # type: ignore[arg-type]
            self.testTimes[case] = 0.0
            self.testsRun += 1

    def wasSuccessful(self) -> bool:
        """Return False."""
        return False


class SkipResult(_WithTimes):
    """All tests of a run were left out."""

    def __init__(self, test_run: TestRun, skip_reason: str = "") -> None:
        super().__init__()
        for case in test_run.all_cases():
            self.addSkip(case, skip_reason)
            self.testTimes[case] = 0.0
            self.testsRun += 1


class TestResult(unittest.TextTestResult, _WithTimes):
    """Tests that ran."""

    __test__ = False

    def startTest(self, test: unittest.TestCase) -> None:
        """Note the time."""
        self.testTimes[test] = time.monotonic()
        super().startTest(test)

    def stopTest(self, test: unittest.TestCase) -> None:
        """Note how long it took."""
        self.testTimes[test] = time.monotonic() - self.testTimes[test]
        super().stopTest(test)

    def append(self, results: TestResult) -> None:
        """Add other tests that ran."""
        self.testTimes.update(results.testTimes)
        self.testsRun += results.testsRun
        for name in ("failures", "errors", "skipped", "expectedFailures", "unexpectedSuccesses"):
            getattr(self, name).extend(getattr(results, name))


def unittestResultsToXml(
    *, test_results: Mapping[Any, Any], name: str = "launch_test"
) -> ET.ElementTree[ET.Element]:
    """Return the results of runs as JUnit XML."""
    root = ET.Element("testsuites", name=name)
    suites = [_suite(str(run), result) for run, result in test_results.items()]
    root.extend(suites)
    for key in ("tests", "failures", "errors"):
        root.set(key, str(sum(int(suite.get(key, "0")) for suite in suites)))
    root.set("time", str(round(sum(float(suite.get("time", "0")) for suite in suites), _DIGITS)))
    return ET.ElementTree(root)


def _suite(name: str, result: Any) -> ET.Element:
    counts = {
        "tests": result.testsRun,
        "failures": len(result.failures),
        "errors": len(result.errors),
        "skipped": len(result.skipped),
        "time": round(sum(result.testTimes.values()), _DIGITS),
    }
    suite = ET.Element("testsuite", {"name": name, **{k: str(v) for k, v in counts.items()}})
    suite.extend([_case(result, case) for case in result.testCases])
    return suite


def _case(result: Any, case: Any) -> ET.Element:
    path, _, qualifiers = case.id().partition(" ")
    classname, _, method = path.rpartition(".")
    seconds = str(round(result.testTimes[case], _DIGITS))
    name = f"{method} {qualifiers}".strip()
    element = ET.Element("testcase", classname=classname, name=name, time=seconds)
    for tag, found in (
        ("failure", result.failures),
        ("error", result.errors),
        ("skipped", result.skipped),
    ):
        for _one, text in [pair for pair in found if pair[0] is case]:
            ET.SubElement(element, tag, message=text)
    return element
