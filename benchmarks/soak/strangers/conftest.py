"""Public packages that nobody prepared for Gazelle, run as their README says.

    pytest benchmarks/soak/strangers --strangers DIR [-n 2] [-k h13]

DIR holds a folder for each package (``H13/ws/src/husky/…``); one that is missing is skipped. A
module is one package and each of its tests one thing that must be seen; in ``test_more.py`` a
parameter is (``-k M10``; `lay_out.py` lays these out). The table at the end has a line a package.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parent))

from stage import Stage, staged


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--strangers", type=Path, help="where the packages are laid out")
    parser.addoption("--sdf-cases", type=Path, help="expectations of sdformat's files (JSON)")


def _package(test: str) -> str:
    """Return the package of a test by its name: that of the parameter, or of the module."""
    named = re.search(r"\[(M\d\d)", test)
    return named[1] if named else Path(test.partition("::")[0]).stem.split("_")[1].upper()


@pytest.fixture(scope="session")
def laid_out(pytestconfig: pytest.Config) -> Callable[[str], Path]:
    """Gives the folder of a package by its name."""
    base: Path | None = pytestconfig.getoption("--strangers")

    def find(package: str) -> Path:
        if base is None:
            pytest.skip("--strangers DIR says where the packages are")
        found = base.resolve() / package
        if not found.is_dir():
            pytest.skip(f"'{found}' is not there")
        return found

    return find


@pytest.fixture(scope="module")
def folder(request: pytest.FixtureRequest, laid_out: Callable[[str], Path]) -> Path:
    """The folder of the module's package."""
    return laid_out(_package(str(request.path)))


@pytest.fixture
def stage(request: pytest.FixtureRequest, folder: Path) -> Iterator[Stage]:
    """The package's stage, anew for each test.

    A module's ENVIRONMENT is added; its PATIENCE_S is for worlds that take long to load.
    """
    environment = getattr(request.module, "ENVIRONMENT", {})
    with staged(folder, environment, getattr(request.module, "PATIENCE_S", 90.0)) as opened:
        yield opened


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    counts: dict[str, dict[str, int]] = {}
    for outcome in ("passed", "failed", "error", "xfailed", "skipped"):
        for report in terminalreporter.stats.get(outcome, []):
            name = _package(report.nodeid)
            row = counts.setdefault(name, {})
            row[outcome] = row.get(outcome, 0) + 1
    if not counts:
        return
    terminalreporter.section("packages")
    for name, row in sorted(counts.items()):
        good = not row.keys() & {"failed", "error", "skipped"}
        told = ", ".join(f"{number} {outcome}" for outcome, number in row.items())
        terminalreporter.line(f"{name}  {'as expected' if good else 'NOT as expected':15}  {told}")
