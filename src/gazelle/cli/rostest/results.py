"""Results of tests: read from the files that they write, summed up, written."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from gazelle.compat.rostest import xml_text
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["Case", "missing_result", "print_summary", "read_cases", "write_suite"]

_RULE = "[ROSTEST]" + "-" * 71
_STATE_RULE = 26
_PROBLEMS = ("failure", "error")


class Case(NamedTuple):
    """One test method, as JUnit XML has it; `problem` is empty, ``failure`` or ``error``."""

    classname: str
    name: str
    seconds: float = 0.0
    problem: str = ""
    kind: str = ""
    text: str = ""

    @property
    def passed(self) -> bool:
        """Whether it passed."""
        return not self.problem


def missing_result(test_name: str, text: str) -> Case:
    """Return the case of a test that left no results."""
    return Case("rostest.runner", test_name, problem="error", kind="Error", text=text)


def read_cases(file: Path) -> list[Case]:
    """Return the cases of a file; one error when it cannot be read."""
    diagnostics = Diagnostics()
    root = read_xml(file, diagnostics)
    if root is None:
        why = "; ".join(item.message for item in diagnostics)
        return [missing_result(file.stem, f"the results cannot be read: {why}")]
    suites = [root] if root.name == "testsuite" else list(root.children)
    return [_case(tag) for suite in suites for tag in suite.children if tag.name == "testcase"]


def write_suite(file: Path, name: str, cases: Sequence[Case]) -> None:
    """Write all cases into one file."""
    file.parent.mkdir(parents=True, exist_ok=True)
    total_s = sum(one.seconds for one in cases)
    file.write_text(xml_text(name, cases, total_s), encoding="utf-8")


def print_summary(package: str, cases: Sequence[Case]) -> int:
    """Print every case and the sums; return the exit code."""
    errors = sum(one.problem == "error" for one in cases)
    failures = sum(one.problem == "failure" for one in cases)
    print(f"\n{_RULE}\n")
    for one in cases:
        state = {"": "passed", "failure": "FAILURE", "error": "ERROR"}[one.problem]
        rule = "-" * _STATE_RULE if one.problem else ""
        print(f"[{package}.{one.classname}/{one.name}][{state}]{rule}")
        if one.problem:
            print(one.text.rstrip("\n"))
            print("-" * 80 + "\n")
    result = "FAIL" if errors or failures else "SUCCESS"
    print(f"\nSUMMARY\n * RESULT: {result}\n * TESTS: {len(cases)}")
    print(f" * ERRORS: {errors}\n * FAILURES: {failures}\n")
    return 1 if errors or failures else 0


def _case(tag: Tag) -> Case:
    words = tag.attributes
    bad = next((child for child in tag.children if child.name in _PROBLEMS), None)
    try:
        seconds = float(words.get("time", "0"))
    except ValueError:
        seconds = 0.0
    case = Case(words.get("classname", ""), words.get("name", ""), seconds)
    if bad is None:
        return case
    text = bad.text or bad.attributes.get("message", "")
    return case._replace(problem=bad.name, kind=bad.attributes.get("type", ""), text=text)
