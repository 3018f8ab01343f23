"""A YAML text as nodes with places, as a value, and what is wrong with it."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from gazelle.diagnostics import SourceSpan
from gazelle.documents.yaml import (
    RCL,
    ROSPARAM,
    Dialect,
    ProblemKind,
    YamlError,
    YamlMapping,
    YamlScalar,
    duplicates,
    entries,
    load_yaml,
    load_yaml_file,
    problem_of,
    read_yaml,
    read_yaml_documents,
    read_yaml_file,
)


def test_nodes_know_where_they_stand_and_how_long_they_are() -> None:
    root = read_yaml("a:\n  wheel: [1, 'two']\n", "f.yaml").root
    assert isinstance(root, YamlMapping)
    found = {".".join(path): (key.span, value.span) for path, key, value, _ in entries(root)}
    assert found["a.wheel"] == (
        SourceSpan("f.yaml", 2, 3, 5),
        SourceSpan("f.yaml", 2, 10, 10),
    )
    items = list(entries(root, lists=True))
    assert [path for path, *_ in items] == [
        ("a",),
        ("a", "wheel"),
        ("a", "wheel", "0"),
        ("a", "wheel", "1"),
    ]
    last = items[-1].value
    assert isinstance(last, YamlScalar)
    assert (last.text, last.is_plain, last.tag) == ("two", False, "str")


def test_merged_keys_are_in_the_value_and_not_in_the_nodes() -> None:
    document = read_yaml("a: &a {x: 1}\nb: {<<: *a, y: 2}\n")
    assert document.value == {"a": {"x": 1}, "b": {"x": 1, "y": 2}}
    root = document.root
    assert isinstance(root, YamlMapping)
    assert [path for path, *_ in entries(root)][2:] == [
        ("b",),
        ("b", "<<"),
        ("b", "<<", "x"),
        ("b", "y"),
    ]


def test_keys_that_are_there_twice_are_told_with_the_first() -> None:
    root = read_yaml("a: 1\nb: 2\na: 3\n").root
    assert isinstance(root, YamlMapping)
    [(again, first)] = duplicates(root).items()
    assert (again.span.line, first.span.line) == (3, 1)
    assert [entry.first for entry in entries(root)] == [None, None, first]


def test_lists_as_keys_have_the_text_that_is_written() -> None:
    root = read_yaml("? [a, b]\n: 1\n").root
    assert isinstance(root, YamlMapping)
    assert root.pairs[0][0].text == "[a, b]"


@pytest.mark.parametrize(
    ("text", "kind", "place", "fix"),
    [
        ("a:\n\tb: 1\n", ProblemKind.TAB_INDENT, (2, 1), "indent with spaces"),
        ("- \tb: c\n", ProblemKind.TAB, (1, 3), "indent with spaces"),
        (
            "a: b: c",
            ProblemKind.MAPPING_VALUE,
            (1, 5),
            "put the value in quotes, or correct the indentation",
        ),
        ("[" * 70, ProblemKind.TOO_DEEP, (1, 65), ""),
        ("a: [1,", ProblemKind.SYNTAX, (1, 7), ""),
    ],
)
def test_problems_say_what_where_and_what_to_do(
    text: str, kind: ProblemKind, place: tuple[int, int], fix: str
) -> None:
    document = read_yaml(text, "f.yaml")
    problem = document.problem
    assert problem is not None
    assert (problem.kind, (problem.span.line, problem.span.column), problem.fix) == (
        kind,
        place,
        fix,
    )
    assert document.root is None
    with pytest.raises(YamlError) as caught:
        _ = document.value
    assert caught.value.problem is problem


def test_errors_print_as_those_of_pyyaml() -> None:
    text = "a: [1,\nb: ]]"
    with pytest.raises(yaml.YAMLError) as theirs:
        yaml.safe_load(text)
    with pytest.raises(yaml.YAMLError) as ours:
        load_yaml(text)
    assert str(ours.value) == str(theirs.value)
    assert problem_of(theirs.value, "x").text == str(theirs.value)


def test_values_that_are_none_are_told_at_their_place() -> None:
    document = read_yaml("a: 1\nb: 2001-99-99\n", "f.yaml")
    assert document.problem is None
    with pytest.raises(YamlError, match="this value cannot be read: month must be in") as caught:
        _ = document.value
    assert caught.value.problem.span == SourceSpan("f.yaml", 2, 4)
    assert caught.value.problem.kind is ProblemKind.VALUE


def test_a_broken_document_is_the_last_one() -> None:
    found = read_yaml_documents("a: 1\n---\nb: [\n---\nc: 3\n", "f.yaml")
    assert [one.problem is None for one in found] == [True, False]
    assert found[0].value == {"a": 1}


def test_dialects_differ_in_numbers() -> None:
    text = "[1e-3, deg(180), 5e2, '1e-3', 08, rad(2*3)]"
    assert load_yaml(text) == ["1e-3", "deg(180)", "5e2", "1e-3", "08", "rad(2*3)"]
    assert load_yaml(text, RCL) == [0.001, "deg(180)", 500.0, "1e-3", 8.0, "rad(2*3)"]
    assert load_yaml(text, ROSPARAM) == ["1e-3", pytest.approx(3.14159265), "5e2", "1e-3", "08", 6]


def test_rosparam_has_tags_of_angles() -> None:
    text = "[!degrees 180, !radians 2*pi, !degrees deg(90)]"
    half = 3.141592653589793
    assert load_yaml(text, ROSPARAM) == pytest.approx([half, 2 * half, half / 2])
    with pytest.raises(YamlError, match="could not determine a constructor for the tag '!degrees'"):
        load_yaml(text)
    with pytest.raises(YamlError, match=r"invalid angle '__import__\(\)'"):
        load_yaml("!degrees __import__()", ROSPARAM)


def test_tags_of_a_dialect_make_values_of_mappings() -> None:
    dialect = Dialect(tags=(("!pair", lambda one: (one["a"], one["b"])),))
    assert load_yaml("x: !pair {a: 1, b: [2]}", dialect) == {"x": (1, [2])}
    with pytest.raises(YamlError, match="could not determine a constructor for the tag '!pair'"):
        load_yaml("x: !pair {a: 1, b: [2]}")


def test_files_that_cannot_be_read_are_problems(tmp_path: Path) -> None:
    problem = read_yaml_file(tmp_path / "none.yaml").problem
    assert problem is not None
    assert (problem.kind, problem.what) == (ProblemKind.UNREADABLE, "No such file or directory")
    latin = tmp_path / "latin.yaml"
    latin.write_bytes(b"a: caf\xe9\n")
    with pytest.raises(YamlError, match="'utf-8' codec can't decode byte 0xe9") as caught:
        load_yaml_file(latin)
    assert caught.value.problem.what == "unexpected end of data at byte 6" or (
        caught.value.problem.what == "invalid continuation byte at byte 6"
    )
    assert caught.value.problem.kind is ProblemKind.NOT_UTF8
