"""rosparam."""

from __future__ import annotations

import io
import math

import pytest
import yaml

from gazelle.graph import Graph


def test_list_is_sorted_and_filtered(graph: Graph, run) -> None:
    graph.parameters.set("/b/x", 1)
    graph.parameters.set("/a", 2)
    assert run("rosparam", "list").out == "/a\n/b/x\n"
    assert run("rosparam", "list", "/b").out == "/b/x\n"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1, "1\n"),
        (0.001, "0.001\n"),
        (True, "true\n"),
        ("two words", "two words\n"),
        ([1, 2], "- 1\n- 2\n\n"),
        ({"kp": 1.5, "gains": {"a": 1}}, "gains:\n  a: 1\nkp: 1.5\n\n"),
    ],
)
def test_get_prints_yaml(graph: Graph, run, value, text: str) -> None:
    graph.parameters.set("/v", value)
    assert run("rosparam", "get", "v") == (0, text, "")


def test_get_prints_what_gazebo_had(graph: Graph, run, own_workspaces_dir) -> None:
    text = (own_workspaces_dir / "recorded/gazebo/params_values.txt").read_text("utf-8")
    camera, gazebo = text.split("\n\n")[:2]
    graph.parameters.set("/depth_camera", yaml.safe_load(camera))
    graph.parameters.set("/gazebo", yaml.safe_load(gazebo))
    assert (
        run("rosparam", "get", "/depth_camera").out + run("rosparam", "get", "/gazebo").out == text
    )


def test_pretty_printing_shows_long_texts(graph: Graph, run) -> None:
    graph.parameters.set("/n", {"text": "a\nb", "word": "x", "deep": {"k": 1}})
    assert run("rosparam", "get", "-p", "/n").out == ("deep:\n  k: 1\ntext: |\n  a\n  b\nword: x\n")
    assert run("rosparam", "get", "-p", "/n/text").out == "a\nb\n"
    assert run("rosparam", "get", "-v", "/n/word").out == "getting parameter [/n/word]\nx\n"


def test_missing_parameter_names_what_is_near(graph: Graph, run) -> None:
    graph.parameters.set("/robot/speed", 1)
    found = run("rosparam", "get", "/robot/sped")
    assert (found.code, found.out) == (1, "")
    assert found.err == (
        "ERROR: Parameter [/robot/sped] is not set\n  did you mean '/robot/speed'?\n"
    )


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("-3", -3),
        ("-0.5", -0.5),
        ("1.0", 1.0),
        ("'1'", "1"),
        ("true", True),
        ("text", "text"),
        ("", ""),
        ("[1, a]", [1, "a"]),
        ("rad(pi/2)", math.pi / 2),
        ("deg(180)", math.pi),
        ("a:=b", "a:=b"),
    ],
)
def test_set_takes_yaml(graph: Graph, run, word: str, value) -> None:
    assert run("rosparam", "set", "/v", word) == (0, "", "")
    found = graph.parameters.get("/v")
    assert found == value
    assert type(found) is type(value)


def test_a_dictionary_updates_its_namespace(graph: Graph, run) -> None:
    graph.parameters.set("/pid", {"p": 1, "i": 2})
    found = run("rosparam", "set", "-v", "/pid", "{i: 5, d: {max: 1}}")
    assert found.out == "set parameter [/pid/i] to [5]\nset parameter [/pid/d/max] to [1]\n"
    assert graph.parameters.get("/pid") == {"p": 1, "i": 5, "d": {"max": 1}}


def test_set_takes_files(graph: Graph, run, tmp_path) -> None:
    (tmp_path / "robot.urdf").write_text("<robot/>")
    (tmp_path / "data.bin").write_bytes(b"\0\1")
    run("rosparam", "set", "/robot_description", "-t", str(tmp_path / "robot.urdf"))
    run("rosparam", "set", "-b", str(tmp_path / "data.bin"), "/blob")
    assert graph.parameters.get("/robot_description") == "<robot/>"
    assert graph.parameters.get("/blob") == b"\0\1"
    assert run("rosparam", "set", "/x", "-t", "none").code == 2


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["/x", "null"], "cannot be null"),
        (["/x", "{1: a}"], "YAML dictionaries must have string keys"),
        (["/x", "[1"], "is not YAML"),
        (["/x", "99999999999999999999"], "Overflow"),
    ],
)
def test_values_that_cannot_be_are_one_error(graph: Graph, run, words, text: str) -> None:
    found = run("rosparam", "set", *words)
    assert found.code == 1
    assert found.err.startswith("ERROR: ")
    assert text in found.err
    assert not graph.parameters.has("/x")


def test_load_reads_files_and_their_namespaces(graph: Graph, run, tmp_path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("a: 1\nb: {c: deg(90)}\n---\n_ns: deeper\nz: 2\n---\n")
    assert run("rosparam", "load", str(file), "/top").code == 0
    assert graph.parameters.get("/top") == {
        "a": 1,
        "b": {"c": math.pi / 2},
        "deeper": {"z": 2},
    }
    out = run("rosparam", "load", "-v", str(file)).out
    assert out.startswith(f"reading parameters from [{file}]\n/a=1\n/b/c=1.57")
    assert run("rosparam", "load", "none.yaml").err == "ERROR: file [none.yaml] does not exist\n"


def test_load_reads_standard_input(graph: Graph, run, monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("k: v"))
    assert run("rosparam", "load", "-").code == 0
    assert graph.parameters.get("/k") == "v"


def test_load_wants_names_and_values(graph: Graph, run, monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("[1, 2]"))
    assert run("rosparam", "load", "-").err == (
        "ERROR: [-] must hold 'name: value' pairs, it holds [1, 2]\n"
    )


def test_what_is_dumped_can_be_loaded(graph: Graph, run, tmp_path) -> None:
    tree = {"a": {"b": [1.5, "x"], "t": "one\ntwo"}, "c": True}
    graph.parameters.set("/ns", tree)
    file = tmp_path / "dump.yaml"
    assert run("rosparam", "dump", str(file), "/ns") == (0, "", "")
    run("rosparam", "load", str(file), "/again")
    assert graph.parameters.get("/again") == tree
    assert yaml.safe_load(run("rosparam", "dump").out) == {"again": tree, "ns": tree}


def test_delete_takes_parameters_and_namespaces(graph: Graph, run) -> None:
    graph.parameters.set("/a/b", 1)
    assert run("rosparam", "delete", "-v", "/a/b").out == "deleted parameter [/a/b]\n"
    found = run("rosparam", "delete", "/a/b")
    assert (found.code, found.err) == (1, "ERROR: parameter [/a/b] is not set\n")
    graph.parameters.set("/x", 1)
    assert run("rosparam", "delete", "-v", "/").out == "deleted ENTIRE parameter server\n"
    assert graph.parameters.names() == []
