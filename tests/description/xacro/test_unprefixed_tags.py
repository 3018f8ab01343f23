"""xacro's tags without the prefix, as packages of Kinetic and Melodic have them."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.xacro import Expanded, expand_xacro
from gazelle.diagnostics import Diagnostic, Diagnostics

_HEAD = '<robot name="old" xmlns:xacro="http://www.ros.org/wiki/xacro">'
_OLD = f"""{_HEAD}
  <include filename="wheels.xacro"/>
  <arg name="side" default="left"/>
  <property name="width" value="0.5"/>
  <property name="place"><origin xyz="1 0 0"/></property>
  <if value="${{width > 0.2}}"><link name="wide"/></if>
  <unless value="1"><link name="never"/></unless>
  <wheel name="$(arg side)_wheel"><mass value="2"/></wheel>
  <xacro:wheel name="back_wheel"><mass value="3"/></xacro:wheel>
  <gazebo><plugin name="p" filename="libp.so">
    <property name="a" value="b"/><wheel name="x"><y/></wheel></plugin></gazebo>
</robot>"""
_WHEELS = f"""{_HEAD}
  <macro name="wheel" params="name *inertia">
    <link name="${{name}}"><insert_block name="place"/><insert_block name="inertia"/></link>
  </macro>
</robot>"""


@pytest.fixture
def old(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("ROS_VERSION", raising=False)
    (tmp_path / "wheels.xacro").write_text(_WHEELS, encoding="utf-8")
    path = tmp_path / "old.xacro"
    path.write_text(_OLD, encoding="utf-8")
    return path


def _expanded(path: Path) -> tuple[Expanded, list[Diagnostic]]:
    diagnostics = Diagnostics()
    found = expand_xacro(path, workspace=None, diagnostics=diagnostics)
    assert found is not None
    return found, list(diagnostics)


def test_old_tags_and_calls_are_expanded_as_in_melodic(old: Path) -> None:
    text = _expanded(old)[0].text
    for part in (
        '<link name="wide"/>', '<link name="left_wheel">', '<link name="back_wheel">',
        '<origin xyz="1 0 0"/>', '<mass value="2"/>', '<mass value="3"/>',
    ):  # fmt: skip
        assert part in text
    assert "never" not in text
    assert "<macro" not in text


def test_what_plugins_hold_is_left_to_them(old: Path) -> None:
    text = _expanded(old)[0].text
    assert '<property name="a" value="b"/>' in text
    assert '<wheel name="x">' in text


def test_each_file_is_told_once_with_its_first_place(old: Path) -> None:
    told = [one for one in _expanded(old)[1] if one.code == "xacro.unprefixed"]
    assert [one.message for one in told] == [
        "<include> without the prefix 'xacro:' is taken as <xacro:include>, as until ROS Melodic"
        " (and 6 more in this file)",
        "<macro> without the prefix 'xacro:' is taken as <xacro:macro>, as until ROS Melodic"
        " (and 2 more in this file)",
    ]
    span = told[0].span
    assert span is not None
    assert (span.line, span.column) == (2, 3)
    assert told[0].fix == "write <xacro:include …>, which all versions take"


@pytest.mark.parametrize("name", ["transmission", "cylinder"])
def test_macro_of_an_elements_name_does_not_call_itself(name: str, tmp_path: Path) -> None:
    path = tmp_path / "one.xacro"
    path.write_text(
        f"""{_HEAD}<xacro:macro name="{name}" params="size"><{name} size="${{size}}"/></xacro:macro>
        <xacro:{name} size="2"/><link name="l"><{name} size="3"/></link></robot>""",
        encoding="utf-8",
    )
    found, told = _expanded(path)
    assert f'<{name} size="2"/>' in found.text
    assert f'<{name} size="3"/>' in found.text
    assert "xacro.unprefixed" not in {one.code for one in told}


def test_a_call_alone_is_taken_at_the_top(tmp_path: Path) -> None:
    path = tmp_path / "one.xacro"
    path.write_text(
        f"""{_HEAD}<xacro:macro name="wheel" params="n r:=1"><link name="${{n}}"/></xacro:macro>
        <wheel n="left"/><wheel side="left"/></robot>""",
        encoding="utf-8",
    )
    found, told = _expanded(path)
    assert '<link name="left"/>' in found.text
    assert '<wheel side="left"/>' in found.text
    assert [one.code for one in told] == ["xacro.unprefixed", "xacro.not-expanded"]


def test_under_ros2_they_stay_in_the_result(old: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_VERSION", "2")
    path = old.with_name("block.xacro")
    path.write_text(f'{_HEAD}<property name="a" value="1"/></robot>', encoding="utf-8")
    found, told = _expanded(path)
    assert '<property name="a" value="1"/>' in found.text
    assert {one.code for one in told} == {"xacro.not-expanded"}
