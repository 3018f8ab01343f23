from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.errors import GraphError, UserFileError
from gazelle.graph.ros2_arguments import parse_ros_arguments


def test_arguments_of_ros_stand_between_ros_args_and_two_dashes() -> None:
    words = [
        "prog",
        "-x",
        "--ros-args",
        "-r",
        "a:=b",
        "-p",
        "n:=3",
        "--",
        "--flag",
        "--ros-args",
        "--remap",
        "n1:c:=d",
    ]
    found = parse_ros_arguments(words)
    assert found.rest == ["prog", "-x", "--flag"]
    assert found.remappings("n1") == {"a": "b", "c": "d"}
    assert found.remappings("n2") == {"a": "b"}
    assert found.parameters("/n1") == {"n": 3}


def test_name_and_namespace_may_be_given_for_one_node() -> None:
    found = parse_ros_arguments(["--ros-args", "-r", "__node:=x", "-r", "n:__ns:=/s"])
    assert (found.node_name("n"), found.namespace("n")) == ("x", "/s")
    assert found.namespace("m") is None


def test_parameters_of_files_and_words_in_their_order(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text(
        "/**:\n  ros__parameters:\n    a: 1\n    b: {c: 2.5}\n"
        "/space/n:\n  ros__parameters:\n    a: 7\n"
    )
    words = ["--ros-args", "--params-file", str(file), "-p", "b.c:=3.5", "-p", "n:d:=[x, y]"]
    found = parse_ros_arguments(words)
    assert found.parameters("/space/n") == {"a": 7, "b.c": 3.5, "d": ["x", "y"]}
    assert found.parameters("/m") == {"a": 1, "b.c": 3.5}


def test_a_log_files_name_is_no_argument_of_the_programs() -> None:
    found = parse_ros_arguments(["--ros-args", "--log-file-name", "mine", "-r", "a:=b"])
    assert (found.rest, found.remappings("n")) == ([], {"a": "b"})


def test_values_are_yaml() -> None:
    words = ["--ros-args", "-p", "a:=true", "-p", "b:='1'", "-p", "c:={d: {e: 1}}"]
    values = parse_ros_arguments(words).parameters("/n")
    assert values == {"a": True, "b": "1", "c.d.e": 1}


def test_parameter_file_with_errors_is_told(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("n:\n  ros__parameters:\n    a: [1\n")
    with pytest.raises(UserFileError, match=r"p\.yaml"):
        parse_ros_arguments(["--ros-args", "--params-file", str(file)]).parameters("/n")


def test_parameter_file_without_ros__parameters_is_told_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("ok:\n  a: 1\n")
    for name in ("/ok", "/other"):
        parse_ros_arguments(["--ros-args", "--params-file", str(file)]).parameters(name)
    shown = capsys.readouterr().err
    assert shown.count("ros__parameters") >= 1
    assert shown.count(f"{file}:1") == 1


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--parm", "a:=1"], "did you mean '--param'"),
        (["-p"], "-p has no value after it"),
        (["-r", "ab"], "Couldn't parse -r rule: '-r ab'"),
        (["mine"], "put -- before arguments of your own"),
    ],
)
def test_wrong_arguments_are_explained(words: list[str], text: str) -> None:
    with pytest.raises(GraphError, match=text):
        parse_ros_arguments(["--ros-args", *words])
