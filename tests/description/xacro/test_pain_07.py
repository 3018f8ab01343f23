"""xacro#267, sdformat#60: errors without a place, and the decimal comma."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parents[2] / "doctor" / "fixtures" / "pain_07_xacro"


def _findings(kind: str, file: str) -> list[Diagnostic]:
    folder = FIXTURES / kind / "pain_07_expressions"
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=folder)
    load_models(folder / "urdf" / file, workspace=workspace, diagnostics=diagnostics)
    return list(diagnostics)


def _place(item: Diagnostic) -> str:
    assert item.span is not None
    way = "".join(f" from {call.line}" for call in item.span.via)
    return f"{Path(item.span.file).name}:{item.span.line}:{item.span.column}{way}"


def test_broken_cart_has_all_its_errors_at_once() -> None:
    found = _findings("broken", "cart.urdf.xacro")
    assert [(item.code, _place(item)) for item in found] == [
        ("xacro.decimal-comma", "cart.urdf.xacro:4:3 from 11 from 18 from 17"),
        ("xacro.undefined-name", "wheel.xacro:7:54 from 17"),
        ("xacro.bad-call", "cart.urdf.xacro:20:3"),
        ("xacro.bad-condition", "cart.urdf.xacro:23:20"),
    ]
    comma, name, call, condition = found
    assert comma.message == ("property 'wheel_radius' is '0,1', a text: the decimal sign is a dot")
    assert comma.fix == "write 0.1"
    assert "name 'wheel_widht' is not defined" in name.message
    assert "macro 'wheel' needs reflect; given: side" in call.message
    assert call.fix == 'add reflect="1", as another call has it, or its own value'
    assert condition.fix == "write true"


def test_tags_without_prefix_are_told_in_a_file_that_expands(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = _findings("broken", "old.urdf.xacro")
    (told,) = (item for item in found if item.code == "xacro.unprefixed")
    assert _place(told) == "old.urdf.xacro:2:3"
    monkeypatch.setenv("ROS_VERSION", "2")
    found = _findings("broken", "old.urdf.xacro")
    spans = [_place(item) for item in found if item.code == "xacro.not-expanded"]
    assert spans == ["old.urdf.xacro:2:3", "old.urdf.xacro:12:3"]


@pytest.mark.parametrize("file", ["cart.urdf.xacro", "old.urdf.xacro"])
def test_clean_twins_have_no_word_of_xacro(file: str) -> None:
    assert [item for item in _findings("clean", file) if item.code.startswith("xacro")] == []
