"""Results of tests in JUnit's XML files."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["Counts", "FileResult", "read_results"]


class Counts(NamedTuple):
    """How many tests did what."""

    tests: int = 0
    errors: int = 0
    failures: int = 0
    skipped: int = 0

    def __str__(self) -> str:
        words = [
            f"{self.tests} test{'' if self.tests == 1 else 's'}",
            f"{self.errors} error{'' if self.errors == 1 else 's'}",
            f"{self.failures} failure{'' if self.failures == 1 else 's'}",
            f"{self.skipped} skipped",
        ]
        return ", ".join(words)

    @property
    def is_bad(self) -> bool:
        """A test failed."""
        return bool(self.errors or self.failures)


class FileResult(NamedTuple):
    """One file: its counts, and the tests that failed in it."""

    file: Path
    counts: Counts
    failures: tuple[str, ...]


def read_results(folder: Path) -> tuple[Counts, tuple[FileResult, ...]]:
    """Return the sum and each file of the results below a folder; other XML files are left out."""
    results = []
    for file in sorted(folder.rglob("*.xml")):
        root = read_xml(file, Diagnostics())
        if root is not None and root.name in {"testsuites", "testsuite"}:
            cases = list(_cases(root))
            counts = Counts(
                len(cases),
                *(sum(any(tag.name == kind for tag in case.children) for case in cases)
                  for kind in ("error", "failure", "skipped")),
            )  # fmt: skip
            results.append(FileResult(file, counts, tuple(_failures(cases))))
    total = Counts(*(sum(column) for column in zip(*(r.counts for r in results), strict=True)))
    return total, tuple(results)


def _cases(tag: Tag) -> list[Tag]:
    if tag.name == "testcase":
        return [tag]
    return [case for child in tag.children for case in _cases(child)]


def _failures(cases: list[Tag]) -> list[str]:
    found = []
    for case in cases:
        words = (case.attributes.get("classname", ""), case.attributes.get("name", ""))
        for child in case.children:
            if child.name in {"error", "failure"}:
                message = child.attributes.get("message", "").partition("\n")[0]
                found.append(f"{' '.join(filter(None, words))}: {message}")
    return found
