"""YAML that would take a reader for ever or surprise it."""

from __future__ import annotations

import time

import pytest
import yaml

from gazelle.documents.yaml import ProblemKind, YamlError, load_yaml, load_yaml_documents


def _bomb(levels: int) -> str:
    lines = ["a0: &a0 [x,x,x,x,x,x,x,x,x,x]"]
    lines += [f"a{n + 1}: &a{n + 1} [{','.join([f'*a{n}'] * 10)}]" for n in range(levels)]
    return "\n".join(lines)


def test_plain_files_are_read_as_ever() -> None:
    text = "a: {b: [1, 2.5, yes], c: &x {d: e}}\nf: *x\ng: 2001-01-01\n<<: {h: 0x10}"
    assert load_yaml(text) == yaml.safe_load(text)
    assert load_yaml(_bomb(3)) == yaml.safe_load(_bomb(3))


def test_aliases_count_as_often_as_they_are_used() -> None:
    with pytest.raises(YamlError) as caught:
        load_yaml(_bomb(9))
    text = "12345679021 values, aliases followed are above the limit of 1000000; if the file means"
    assert text in str(caught.value)
    assert "GAZELLE_LIMITS=10" in str(caught.value)


def test_lists_that_hold_themselves_are_refused() -> None:
    with pytest.raises(YamlError, match="an alias stands inside the very list or mapping") as e:
        load_yaml("a: &a [1, *a]")
    assert "line 1, column 4" in str(e.value)


def test_nesting_has_a_limit_and_a_place() -> None:
    for depth in (65, 50_000):
        with pytest.raises(YamlError, match="are nested deeper than 64") as caught:
            load_yaml("[" * depth)
        assert "line 1, column 65" in str(caught.value)


def test_long_texts_are_refused_at_once() -> None:
    start = time.thread_time()
    with pytest.raises(YamlError, match="are above the limit of 8388608"):
        load_yaml("a: 1\n" * 20_000_000)
    assert time.thread_time() - start < 10.0


@pytest.mark.parametrize(
    "text",
    ["a: 2001-99-99", "a: !!int abc", "a: !!timestamp b", "a: !!float b", f"a: {'9' * 5000}",
     "a: !!python/object:os.system x", "? [a]\n: b", "a: !!binary é", "<<: 3", "=", "\x00"],
)  # fmt: skip
def test_values_that_are_none_are_errors_of_the_yaml(text: str) -> None:
    try:
        load_yaml(text)
    except YamlError:
        return
    assert text == "="


def test_documents_of_one_text_share_the_limit_of_values() -> None:
    with pytest.raises(YamlError, match="values, aliases followed are above the limit") as caught:
        load_yaml_documents("\n---\n".join([_bomb(4)] * 10))
    assert caught.value.problem.kind is ProblemKind.TOO_MUCH


@pytest.mark.parametrize("text", [f"0x{'f' * 5000}", f"0b{'1' * 20_000}", ":59" * 5000])
def test_whole_numbers_that_python_does_not_print_are_none(text: str) -> None:
    start = time.thread_time()
    with pytest.raises(YamlError, match="this value cannot be read: a whole number of") as caught:
        load_yaml(f"a: 1{text}" if text[0] == ":" else f"a: {text}")
    assert caught.value.problem.kind is ProblemKind.VALUE
    assert time.thread_time() - start < 5.0


def test_a_tab_is_called_a_tab() -> None:
    with pytest.raises(yaml.YAMLError) as caught:
        load_yaml("a:\n\tb: 1\n")
    assert (
        "found character '\\t' that cannot start any token: this is a tab, YAML is indented with"
        " spaces" in str(caught.value)
    )
