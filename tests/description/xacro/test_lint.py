from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity

ADDRESS = "http://www.ros.org/wiki/xacro"


@pytest.fixture
def remarks(tmp_path: Path) -> Callable[..., list[Diagnostic]]:
    def run(text: str, head: str = f'xmlns:xacro="{ADDRESS}"', **values: str) -> list[Diagnostic]:
        path = tmp_path / "one.xacro"
        path.write_text(f"<robot {head}>\n{text}\n</robot>", encoding="utf-8")
        diagnostics = Diagnostics()
        found = expand_xacro(path, workspace=None, diagnostics=diagnostics, mappings=values)
        assert found is not None
        return list(diagnostics)

    return run


Remarks = Callable[..., list[Diagnostic]]


@pytest.mark.parametrize(
    "tag",
    [
        '<property name="a" value="1"/>',
        '<macro name="m" params=""/>',
        '<include filename="x.xacro"/>',
        '<if value="1"/>',
        '<insert_block name="b"/>',
        '<arg name="a" default="1"/>',
    ],
)
def test_old_tags_without_prefix_are_told_in_ros2(
    tag: str, remarks: Remarks, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_VERSION", "2")
    (found,) = remarks(f"<link/>\n  {tag}")
    name = tag[1:].partition(" ")[0]
    assert (found.code, found.severity) == ("xacro.not-expanded", Severity.WARNING)
    assert f"<{name}> without the prefix 'xacro:' is not xacro's" in found.message
    assert (found.span.line, found.span.column) == (3, 3)
    assert found.fix == f"write <xacro:{name} …>"


def test_macro_called_without_prefix_is_told_in_ros2(
    remarks: Remarks, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_VERSION", "2")
    macro = '<xacro:macro name="wheel" params="n"><link name="${n}"/></xacro:macro>\n'
    (found,) = remarks(f'{macro}<wheel n="left"/>')
    assert (
        found.message == "macro 'wheel' is called without the prefix 'xacro:'; it is not expanded"
    )
    assert found.span.line == 3


def test_tags_that_only_look_like_xacro_are_let_be(remarks: Remarks) -> None:
    text = (
        '<xacro:macro name="sensor" params=""/><sensor/><link><property/></link>'
        '<gazebo><plugin><property name="a" value="b"/><include filename="x"/></plugin></gazebo>'
    )
    assert remarks(text) == []


def test_expression_in_cdata_is_told(remarks: Remarks) -> None:
    (found,) = remarks("<a>\n<t><![CDATA[${1 + 1}]]></t></a><b><![CDATA[$5]]></b>")
    assert found.code == "xacro.not-expanded"
    assert "xacro expands nothing inside <![CDATA[…]]>" in found.message
    assert found.span.line == 3


def test_other_prefix_for_xacro_is_told(remarks: Remarks) -> None:
    (found,) = remarks('<x:property name="a" value="1"/>', f'xmlns:x="{ADDRESS}"')
    assert found.code == "xacro.not-expanded"
    assert "xacro's address belongs to the prefix 'x:' here" in found.message


def test_foreign_address_is_a_remark(remarks: Remarks) -> None:
    address = "http://playerstage.sourceforge.net/gazebo/xmlschema/#interface"
    (found,) = remarks("<a/>", f'xmlns:xacro="{address}"')
    assert (found.code, found.severity) == ("xacro.namespace-address", Severity.INFO)
    assert (found.span.line, found.span.column, found.span.length) == (1, 21, len(address))
    assert remarks("<a/>", 'xmlns:xacro="http://wiki.ros.org/xacro"') == []


def test_values_for_arguments_that_are_not_there_are_told(remarks: Remarks) -> None:
    text = '<xacro:arg name="use_gpu" default="0"/><v a="$(arg undeclared)"/>'
    found = remarks(text, use_gpuu="1", zzz="2", undeclared="3")
    assert [(item.code, item.severity) for item in found] == [
        ("xacro.unused-argument", Severity.WARNING),
        ("xacro.unused-argument", Severity.INFO),
    ]
    assert found[0].message == "'use_gpuu:=1' has no effect: no <xacro:arg> has this name"
    assert found[0].fix == "did you mean 'use_gpu'?"


def test_argument_in_a_branch_not_taken_is_no_mistake(remarks: Remarks) -> None:
    text = '<xacro:if value="0"><xacro:arg name="rate" default="1"/></xacro:if>'
    assert remarks(text, rate="5") == []


def test_scope_that_does_not_exist_is_told(remarks: Remarks) -> None:
    (found,) = remarks('<xacro:property name="n" value="5" scope="glbal"/>')
    assert (found.code, found.severity) == ("xacro.bad-element", Severity.WARNING)
    assert found.message.startswith("there is no scope 'glbal'")
    assert (found.span.column, found.fix) == (43, "did you mean 'global'?")
    assert remarks('<xacro:property name="n" value="5" scope="local"/>') == []
