"""Warnings of Python: a library's are a line, a user's file's stay what they are."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy
import pytest
from tests.patience import stretched

from gazelle import engine
from gazelle.python_warnings import library_of, shorten_library_warnings


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is left to Python to show."""
    left: list[Any] = []
    monkeypatch.setattr(warnings, "showwarning", lambda *words: left.append(words))
    shorten_library_warnings()
    return left


def test_a_librarys_warning_is_one_line(
    shown: list[Any], capsys: pytest.CaptureFixture[str]
) -> None:
    warnings.showwarning(RuntimeWarning("divide\n by zero"), RuntimeWarning, numpy.__file__, 3)
    assert capsys.readouterr().err == "numpy warns: divide by zero (RuntimeWarning)\n"
    assert not shown


def test_a_users_warning_is_left_to_python(
    shown: list[Any], capsys: pytest.CaptureFixture[str]
) -> None:
    warnings.showwarning("old is old", UserWarning, "/home/me/ws/node.py", 1)
    assert shown == [("old is old", UserWarning, "/home/me/ws/node.py", 1, None, None)]
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("file", "library"),
    [
        ("/usr/lib/python3/site-packages/collada/scene.py", "collada"),
        ("/usr/lib/python3/dist-packages/six.py", "six"),
        ("/home/me/ws/src/bot/scripts/node.py", None),
        (str(Path(engine.__file__).with_name("engine.py")), "gazelle.engine.engine"),
        (str(Path(engine.__file__).parents[1] / "launch" / "x.py"), None),
    ],
)
def test_the_library_is_told_by_its_folder(file: str, library: str | None) -> None:
    assert library_of(file) == library


@pytest.mark.parametrize("module", ["gazelle.nodes.__main__", "gazelle.cli.__main__"])
def test_programs_of_gazelle_shorten_them(module: str, tmp_path: Path) -> None:
    library = tmp_path / "site-packages" / "loud.py"
    library.parent.mkdir()
    library.write_text("import warnings\nwarnings.warn('too loud')\n")
    code = f"""
import sys
sys.path.insert(0, {str(library.parent)!r})
import gazelle.process_lifetime
def end_with(main):
    import loud
gazelle.process_lifetime.end_with = end_with
import runpy
sys.argv = ["gazelle"]
runpy.run_module({module!r}, run_name="__main__")
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )
    assert done.stderr == "loud warns: too loud (UserWarning)\n"
