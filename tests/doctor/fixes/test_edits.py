"""Edits of texts, and diffs of them."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from gazelle.diagnostics import SourceSpan
from gazelle.doctor.fixes import Edit, SourceText, difference, edited


def test_edits_are_of_the_first_text() -> None:
    edits = (Edit(0, 1, "A"), Edit(2, 2, "-"), Edit(3, 5, ""))
    assert edited("abcdefg", edits) == "Ab-cfg"


@pytest.mark.parametrize(
    ("line", "column", "offset"), [(1, 1, 0), (2, 4, 8), (2, 0, 7), (9, 1, 10), (2, 99, 9)]
)
def test_offsets_are_those_of_places(line: int, column: int, offset: int) -> None:
    """Without a column it is where the line's words begin."""
    source = SourceText("f", "abcd\n  ef\ng")
    assert source.offset(SourceSpan("f", line, column)) == offset


def test_diff_is_one_that_git_applies(tmp_path: Path) -> None:
    git = shutil.which("git")
    if git is None:
        pytest.skip("git is not installed")
    before, after = "one\ntwo\nthree", "one\n2\nthree"
    (tmp_path / "a b.txt").write_bytes(before.encode())
    (tmp_path / "change.diff").write_text(difference(before, after, "a b.txt"), "utf-8")
    subprocess.run([git, "apply", "change.diff"], cwd=tmp_path, check=True)
    assert (tmp_path / "a b.txt").read_bytes() == after.encode()
