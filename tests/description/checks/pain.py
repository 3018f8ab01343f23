"""The doctor's fixtures of broken and clean robots, read and checked."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.checks import check_description
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parents[2] / "doctor" / "fixtures"
OWN = (
    "pain_04_massless",
    "pain_05_tensor",
    "pain_06_lumping",
    "pain_14_wheels",
    "pain_15_contact",
    "pain_20_optical",
)


def examined(path: Path) -> Diagnostics:
    """Return what the checks say of a robot's file."""
    found = Diagnostics()
    workspace = Workspace.discover(cwd=path.parent)
    for model in load_models(path, workspace=workspace, diagnostics=Diagnostics()):
        check_description(model, diagnostics=found)
    return found


def finding(name: str) -> Diagnostic:
    """Return the only finding about a broken fixture."""
    pain, _, file = name.partition("/")
    (item,) = examined(FIXTURES / pain / "broken" / file)
    return item


def place(item: Diagnostic) -> str:
    """Return the line that a finding is about."""
    assert item.span is not None
    return Path(item.span.file).read_text(encoding="utf-8").splitlines()[item.span.line - 1].strip()
