"""Importing single Python files."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from gazelle.workspace.python_files import import_python_file


def test_file_is_imported_once_and_again_when_it_changed(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "helper_of_it.py").write_text("VALUE = 3\n")
    file = tmp_path / "mine.py"
    file.write_text("from helper_of_it import VALUE\n")
    folders = (tmp_path / "src", tmp_path / "none")
    made = import_python_file(file, "gazelle_test.mine", folders=folders)
    assert made.VALUE == 3
    assert import_python_file(file, "gazelle_test.mine", folders=folders) is made
    file.write_text("VALUE = 4\n")
    os.utime(file, ns=(1, 1))
    assert import_python_file(file, "gazelle_test.mine", folders=folders).VALUE == 4
    assert str(tmp_path / "none") not in sys.path


def test_what_a_file_raises_comes_through_and_leaves_no_module(tmp_path: Path) -> None:
    file = tmp_path / "bad.py"
    file.write_text("raise RuntimeError('no')\n")
    with pytest.raises(RuntimeError, match="no"):
        import_python_file(file, "gazelle_test.bad")
    assert "gazelle_test.bad" not in sys.modules
