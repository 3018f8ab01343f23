from __future__ import annotations

import sys

import pytest

from gazelle.description.xacro import XacroCommand, parse_xacro_arguments


def test_file_mappings_and_options_in_any_order() -> None:
    command = parse_xacro_arguments(
        ["a:=1", "r.xacro", "b:=x y", "-o", "out.urdf", "--root-dir=/d", "--deps", "-v"]
    )
    assert command == XacroCommand(
        "r.xacro", {"a": "1", "b": "x y"}, "out.urdf", "/d", True, verbosity=2
    )


def test_node_parameters_are_no_mappings() -> None:
    command = parse_xacro_arguments(["r.xacro", "_p:=1", "__name:=n"])
    assert command.mappings == {"__name": "n"}


def test_options_of_older_generations_are_accepted_with_a_notice() -> None:
    words = ["--xacro-ns", "--check-order", "--legacy", "--oldorder", "--includes", "r.xacro"]
    command = parse_xacro_arguments(words)
    assert command.file == "r.xacro"
    assert len(command.notices) == 5
    assert command.notices[0] == (
        "option --xacro-ns has no effect: tags without the prefix 'xacro:' are taken and told in"
        " ROS 1"
    )


@pytest.mark.parametrize("words", [["--output", "o.urdf"], ["--output=o.urdf"], ["-oo.urdf"]])
def test_output_has_all_its_spellings(words: list[str]) -> None:
    command = parse_xacro_arguments([*words, "r.xacro"])
    assert (command.output, command.file) == ("o.urdf", "r.xacro")
    assert bool(command.notices) == words[0].startswith("--")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "xacro: error: expected exactly one input file as argument"),
        (["a", "b"], "expected exactly one input file as argument"),
        (["a", "--nope"], "no such option: --nope"),
        (["a", "-o"], "-o option requires 1 argument"),
        (["-h"], "-h asks for help only"),
        (["a:=b:=c", "f"], "Invalid remapping argument 'a:=b:=c'"),
    ],
)
def test_wrong_calls_say_why(words: list[str], text: str) -> None:
    before = sys.argv
    with pytest.raises(ValueError, match=text):
        parse_xacro_arguments(words)
    assert sys.argv is before
