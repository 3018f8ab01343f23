"""The Pythons that CI runs the tests on are those that are promised and found."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from tests.ci_scripts import ci_script

ROOT = Path(__file__).parents[1]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


@pytest.fixture(scope="module")
def every_python() -> ModuleType:
    """The script of CI, as a module."""
    return ci_script("every_python")


def test_promised_are_those_of_the_classifiers_from_the_lowest_one_on(
    every_python: ModuleType,
) -> None:
    promised = every_python.promised(PROJECT)
    lowest = tuple(map(int, PROJECT["requires-python"].removeprefix(">=").split(".")))
    assert min(promised) == lowest
    assert promised == {(3, minor) for minor in range(11, 11 + len(promised))}


def test_lower_bounds_become_pins(every_python: ModuleType) -> None:
    project = {
        "dependencies": ["b>=1.0; python_version < '3.14'", "a-b>=2", "free"],
        "optional-dependencies": {"more": ["c.d>=3.1,<4", "a-b>=2"], "dev": ["e >= 4.0.1"]},
    }
    assert every_python.lowest_pins(project) == [
        "a-b==2", "b==1.0; python_version < '3.14'", "c.d==3.1", "e==4.0.1",
    ]  # fmt: skip


def test_every_requirement_has_a_lower_bound_of_its_own(every_python: ModuleType) -> None:
    groups = [PROJECT["dependencies"], *PROJECT["optional-dependencies"].values()]
    named = {re.split(r"\[|>=", requirement)[0] for group in groups for requirement in group}
    assert {pin.partition("==")[0] for pin in every_python.lowest_pins(PROJECT)} == named


def test_newest_of_each_minor_version_runs_and_the_lowest_one_twice(
    every_python: ModuleType,
) -> None:
    found = {(3, 12, 1): "b", (3, 11, 9): "a", (3, 11, 7): "old"}
    runs = every_python.runs_of(found, lowest=False, others=False)
    assert runs == [
        ((3, 11, 9), "a", False), ((3, 12, 1), "b", False), ((3, 11, 9), "a", True),
    ]  # fmt: skip
    assert every_python.runs_of(found, lowest=True, others=False) == [((3, 11, 9), "a", True)]


def test_others_are_all_but_the_one_that_runs(every_python: ModuleType) -> None:
    found = {sys.version_info[:3]: "this", (3, 99, 0): "other"}
    runs = every_python.runs_of(found, lowest=False, others=True)
    assert runs == [((3, 99, 0), "other", False)]


def test_interpreters_of_pyenv_and_uv_are_found(
    every_python: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there = ["pyenv/versions/3.12.1/bin/python3.12", "uv/cpython-3.12.4-linux/bin/python3.12"]
    for name in there:
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).touch()
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PYENV_ROOT", str(tmp_path / "pyenv"))
    monkeypatch.setenv("UV_PYTHON_INSTALL_DIR", str(tmp_path / "uv"))
    found = list(every_python.candidates({(3, 11), (3, 12)}))
    assert found == [str(tmp_path / name) for name in there]
