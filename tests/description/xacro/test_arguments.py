from __future__ import annotations

import pytest

from gazelle.description.xacro import XacroCommand, parse_xacro_arguments


def test_file_mappings_and_options_in_any_order() -> None:
    command = parse_xacro_arguments(
        ["--inorder", "a:=1", "r.xacro", "b:=x y", "-o", "out.urdf", "--root-dir=/d", "--deps"]
    )
    assert command == XacroCommand("r.xacro", {"a": "1", "b": "x y"}, "out.urdf", "/d", True)


def test_node_parameters_are_no_mappings() -> None:
    command = parse_xacro_arguments(["r.xacro", "_p:=1", "__name:=n"])
    assert command.mappings == {"__name": "n"}


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "expected exactly one input file as argument, got 0"),
        (["a", "b"], "got 2"),
        (["a", "--nope"], "there is no option --nope"),
        (["a", "-o"], "-o needs a value"),
    ],
)
def test_wrong_calls_say_why(words: list[str], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        parse_xacro_arguments(words)
