"""Where a text stops being Python."""

from __future__ import annotations

import ast

import pytest

from gazelle.workspace.static_python import SyntaxProblem, syntax_problem

NODES = "x = [\n  f(\n    1,\n  )\n  f(2),\n]\n"


def problem(text: str) -> SyntaxProblem:
    with pytest.raises(SyntaxError) as raised:
        ast.parse(text)
    return syntax_problem(text, raised.value)


def test_missing_comma_is_told_at_its_line() -> None:
    found = problem(NODES)
    assert (found.line, found.column) == (4, 3)
    assert found.fix == "write a comma at the end of line 4"
    assert "Perhaps you forgot a comma" in found.message


def test_other_mistakes_stay_where_the_parser_says() -> None:
    assert problem("def f()\n  pass\n") == SyntaxProblem("expected ':'", 1, 8)
    # Two commas are missing: none of the lines alone is to blame.
    assert problem(NODES.replace("f(2),", "f(2)\n  f(3)")).fix == ""
