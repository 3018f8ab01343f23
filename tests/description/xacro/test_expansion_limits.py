"""Files that would take a xacro for ever, or all memory."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics

_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
_DOUBLING = '<xacro:property name="p0" value="{start}"/>' + "".join(
    f'<xacro:property name="p{number + 1}" value="{{more{number}}}"/>' for number in range(40)
)


def _doubling(start: str, more: str) -> str:
    texts = {f"more{number}": more.replace("p", f"p{number}") for number in range(40)}
    return _DOUBLING.format(start=start, **texts) + '<a b="${p40}"/>'


def _errors(tmp_path: Path, body: str) -> list[str]:
    (tmp_path / "a.xacro").write_text(f"{_HEAD}{body}</robot>")
    diagnostics = Diagnostics()
    start = time.thread_time()
    assert expand_xacro(tmp_path / "a.xacro", workspace=None, diagnostics=diagnostics) is None
    assert time.thread_time() - start < 10.0
    return [f"{item.message} [{item.code}]" for item in diagnostics.errors]


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        ("9**9**9", "a whole number of 1162261467 binary digits is above the limit of 100000"),
        ("'a'*10**10", "a text of 10000000000 characters is above the limit of 10000000"),
        ("[0]*10**10", "a list of 10000000000 items is above the limit of 2000000"),
        ("python.list(range(10**9))", "a range of 1000000000 numbers is above the limit"),
        ("[x for x in range(10**9)]", "the expressions of this file take more than 2000000 steps"),
        ("[*range(10**9)]", "the expressions of this file take more than 2000000 steps"),
        ("1 &lt;&lt; 10**9", "a whole number of 1000000001 binary digits is above"),
        ("'%1000000000d' % 1", "a text of 1000000000 characters is above"),
        ("'a'.ljust(10**10)", "a text of 10000000000 characters is above"),
        ("math.factorial(10**7)", "a product of 10000000 factors is above the limit of 10000"),
        ("round(1, -10**9)", "a whole number of 4000000000 binary digits is above"),
        ("-" * 50_000 + "1", "an expression is nested too deep to be understood"),
    ],
)
def test_expressions_that_would_never_end(tmp_path: Path, expression: str, text: str) -> None:
    (found,) = _errors(tmp_path, f'<a b="${{{expression}}}"/>')
    assert text in found
    assert "when evaluating expression '" in found
    assert found.endswith("[limits.expression]")


def test_evaluated_arguments_have_limits_too(tmp_path: Path) -> None:
    assert "binary digits" in _errors(tmp_path, '<a b="$(eval 9**9**9)"/>')[0]


@pytest.mark.parametrize(
    ("start", "more", "text"),
    [
        ("ha", "${p}${p}", "a text of 16777216 characters"),
        ("ha", "${p+p}", "a text of 16777216 characters"),
        ("${[1]}", "${[p,p]}", "a list of 3145727 items"),
    ],
)
def test_billion_laughs_of_properties(tmp_path: Path, start: str, more: str, text: str) -> None:
    assert text in _errors(tmp_path, _doubling(start, more))[0]


def test_aliases_of_yaml_files_count_as_often_as_they_are_used(tmp_path: Path) -> None:
    lines = ["a0: &a0 [x,x,x,x,x,x,x,x,x,x]"]
    lines += [f"a{n + 1}: &a{n + 1} [{','.join([f'*a{n}'] * 10)}]" for n in range(9)]
    (tmp_path / "a.yaml").write_text("\n".join(lines))
    (found,) = _errors(tmp_path, "<a b=\"${xacro.load_yaml('a.yaml')}\"/>")
    assert found.startswith("a list of 12345679011 items is above the limit of 2000000")


@pytest.mark.skipif(os.name == "nt", reason="there are no devices in folders")
def test_devices_are_not_loaded(tmp_path: Path) -> None:
    found = _errors(tmp_path, "<a b=\"${xacro.load_yaml('/dev/zero')}\"/>")
    assert found == ["cannot read '/dev/zero': it is a device, not a file [xacro.file-missing]"]


def test_macros_that_double_are_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.description.xacro.expansion_limits._MAX_CALLS", 500)
    macros = "".join(
        f'<xacro:macro name="m{n}"><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>'
        for n in range(40)
    )
    assert _errors(tmp_path, f'{macros}<xacro:macro name="m40"/><xacro:m0/>') == [
        "the file expands to too much: more than 500 macro calls and includes [limits.expansion]"
    ]


def test_blocks_that_double_are_ended(tmp_path: Path) -> None:
    twice = '<xacro:insert_block name="b"/>' * 2
    macros = f'<xacro:macro name="m0" params="**b">{twice}</xacro:macro>' + "".join(
        f'<xacro:macro name="m{n + 1}" params="**b"><xacro:m{n}><x>{twice}</x></xacro:m{n}>'
        "</xacro:macro>"
        for n in range(29)
    )
    assert _errors(tmp_path, f"{macros}<xacro:m29><x><a/></x></xacro:m29>") == [
        "the file expands to too much: more than 20000 copies of elements [limits.expansion]"
    ]


def test_time_and_size_of_the_expansion_have_limits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    budget = "gazelle.description.xacro.expansion_limits"
    body = '<xacro:macro name="m"><a b="12345"/></xacro:macro>' + "<xacro:m/>" * 50
    for name, text in (
        ("_MAX_SECONDS", "more than 0 s of computing"),
        ("_MAX_TEXTS", "more than 10 attributes and texts"),
        ("_MAX_CHARACTERS", "attributes and texts of more than 10 characters"),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(f"{budget}.{name}", 0 if "SECONDS" in name else 10)
            found = _errors(tmp_path, body)
        assert found == [f"the file expands to too much: {text} [limits.expansion]"]


def test_million_elements_are_refused_before_they_are_read(tmp_path: Path) -> None:
    (found,) = _errors(tmp_path, "<a/>" * 1_000_000)
    assert "the document has 1000001 elements, the limit is 500000 [limits.expansion]" in found


def test_limits_change_no_result(tmp_path: Path) -> None:
    expressions = {
        "2**10": "1024", "2.0**0.5": "1.4142135623730951", "'ab'*3": "ababab", "1+2*3": "7",
        "[x*2 for x in [1,2,3]]": "[2, 4, 6]", "'%05.2f' % 3.14159": "03.14", "7 % 3": "1",
        "max(1, 2)*-1": "-2", "1 &lt;&lt; 4": "16", "','.join(['a', 'b'])": "a,b",
        "(lambda a, b=2: a+b)(1)": "3", "'a-b'.replace('-', '+')": "a+b", "round(1.26, 1)": "1.3",
        "python.sum([1, 2], 3)": "6",
    }  # fmt: skip
    for expression, text in expressions.items():
        (tmp_path / "a.xacro").write_text(f'{_HEAD}<a b="${{{expression}}}"/></robot>')
        diagnostics = Diagnostics()
        found = expand_xacro(tmp_path / "a.xacro", workspace=None, diagnostics=diagnostics)
        assert found is not None, [str(item) for item in diagnostics]
        assert f'<a b="{text}"/>' in found.text


def test_names_in_comprehensions_are_checked_like_others(tmp_path: Path) -> None:
    (found,) = _errors(tmp_path, '<a b="${[x for x in [1] if [].__class__]}"/>')
    assert "Use of invalid name(s): __class__" in found


def test_a_yaml_file_of_brackets_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("[" * 100_000, encoding="utf-8")
    found = _errors(tmp_path, "<a b=\"${xacro.load_yaml('a.yaml')}\"/>")
    assert found == ["not YAML: lists and mappings are nested deeper than 64 [xacro.bad-yaml]"]
