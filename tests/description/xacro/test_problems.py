from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

HEAD = '<robot name="f" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
LEG = '<xacro:macro name="leg" params="n"/>\n'


def _fail(text: str, folder: Path):
    path = folder / "one.xacro"
    path.write_text(f"{HEAD}{text}\n</robot>", encoding="utf-8")
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=folder)
    assert expand_xacro(path, workspace=workspace, diagnostics=diagnostics) is None
    (error,) = diagnostics.errors
    return error


@pytest.mark.parametrize(
    ("text", "code", "words", "line"),
    [
        ('<a>\n<v a="${x}"/></a>', "xacro.undefined-name", "name 'x' is not defined", 3),
        ('<v a="${1+}"/>', "xacro.bad-expression", "invalid syntax", 2),
        ('<v a="${1/0}"/>', "xacro.bad-expression", "division by zero", 2),
        ('<v a="$(arg p)"/>', "xacro.argument-missing", "$(arg p) has no value", 2),
        ('<v a="$(find nopkg)"/>', "xacro.package-missing", "package 'nopkg' not found", 2),
        ('\n<xacro:include filename="no.xacro"/>', "xacro.file-missing", "No such file", 3),
        ("<v a=\"${xacro.load_yaml('no.yaml')}\"/>", "xacro.file-missing", "No such file", 2),
        ("<xacro:legg/>", "xacro.unknown-macro", "unknown macro name: xacro:legg", 2),
        (f"{LEG}<xacro:leg/>", "xacro.failed", "Undefined parameters [n]", 3),
        (f'{LEG}<xacro:leg n="1" m="2"/>', "xacro.failed", 'Invalid parameter "m"', 3),
        ('<v a="$(env NOT_THERE)"/>', "xacro.failed", "'NOT_THERE' is not set", 2),
        ("<a>\n</b>", "xml.malformed", "mismatched tag", 3),
    ],
)
def test_failures_are_explained_at_their_line(
    text: str, code: str, words: str, line: int, tmp_path: Path
) -> None:
    error = _fail(text, tmp_path)
    assert (error.code, error.span.file) == (code, str(tmp_path / "one.xacro"))
    assert words in error.message
    assert error.span.line == line


def test_undefined_name_gets_a_hint(tmp_path: Path) -> None:
    text = '<xacro:property name="wheel_radius" value="1"/><v a="${weel_radius}"/>'
    assert "did you mean 'wheel_radius'" in _fail(text, tmp_path).fix


def test_unknown_macro_gets_a_hint(tmp_path: Path) -> None:
    assert "did you mean 'leg'" in _fail(f'{LEG}<xacro:legs n="1"/>', tmp_path).fix


def test_missing_argument_says_how_to_give_it(tmp_path: Path) -> None:
    fix = _fail('<v a="$(arg p)"/>', tmp_path).fix
    assert fix == 'pass p:=… or write <xacro:arg name="p" default="…"/>'


def test_argument_whose_default_comes_too_late_is_told_so(tmp_path: Path) -> None:
    """Robots use $(arg name) in <robot name> and declare it below."""
    text = '<v a="$(arg p)"/><xacro:arg name="p" default="1"/>'
    assert "with the default comes after this use" in _fail(text, tmp_path).fix


def test_error_in_a_macro_of_an_include_shows_the_way_there(tmp_path: Path) -> None:
    (tmp_path / "inc.xacro").write_text(
        f'{HEAD}<xacro:macro name="bad" params="n">\n<link name="${{nn}}"/>\n</xacro:macro>'
        "</robot>",
        encoding="utf-8",
    )
    error = _fail('<xacro:include filename="inc.xacro"/>\n\n<xacro:bad n="1"/>', tmp_path)
    assert (Path(error.span.file).name, error.span.line, error.span.column) == ("inc.xacro", 3, 1)
    assert [(Path(item.file).name, item.line) for item in error.span.via] == [("one.xacro", 4)]


def test_malformed_include_names_its_own_line_and_who_includes_it(tmp_path: Path) -> None:
    (tmp_path / "inc.xacro").write_text(f"{HEAD}<a>\n</robot>", encoding="utf-8")
    error = _fail('<xacro:include filename="inc.xacro"/>', tmp_path)
    assert (error.code, Path(error.span.file).name, error.span.line) == (
        "xml.malformed",
        "inc.xacro",
        3,
    )
    assert [item.line for item in error.span.via] == [2]


def test_endless_recursion_ends_with_an_error(tmp_path: Path) -> None:
    text = '<xacro:macro name="m" params=""><xacro:m/></xacro:macro>\n<xacro:m/>'
    error = _fail(text, tmp_path)
    assert error.code == "xacro.recursion"
    assert "call each other without end" in error.message


def test_entities_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "e.xacro"
    path.write_text('<!DOCTYPE r [<!ENTITY x "y">]>\n<robot name="&x;"/>', encoding="utf-8")
    diagnostics = Diagnostics()
    assert expand_xacro(path, workspace=None, diagnostics=diagnostics) is None
    (error,) = diagnostics
    assert (error.code, error.span.line) == ("xml.entity", 1)


def test_missing_file_is_one_error(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    gone = tmp_path / "gone.xacro"
    assert expand_xacro(gone, workspace=None, diagnostics=diagnostics) is None
    (error,) = diagnostics
    assert error.code == "xacro.file-missing"
    assert str(gone) in error.message


def test_include_from_a_missing_package_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "one.xacro"
    path.write_text(
        f'{HEAD}<link name="a"/>\n<xacro:include filename="$(find lidars)/x.xacro"/></robot>',
        encoding="utf-8",
    )
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    expanded = expand_xacro(path, workspace=workspace, diagnostics=diagnostics)
    assert expanded is not None
    assert '<link name="a"/>' in expanded.text
    assert "xacro:include" not in expanded.text
    (finding,) = diagnostics
    assert finding.code == "xacro.include-left-out"
    assert finding.message == "package 'lidars' not found: this include is left out"
    assert (finding.span.line, finding.span.column) == (3, 1)


def test_macro_of_a_missing_package_says_which_package(tmp_path: Path) -> None:
    text = '<xacro:include filename="$(find lidars)/x.xacro"/>\n<xacro:spinner/>'
    error = _fail(text, tmp_path)
    assert error.code == "xacro.unknown-macro"
    assert error.message.endswith("; missing packages may define it: lidars")


def test_include_of_a_missing_file_in_a_package_stays_an_error(tmp_path: Path) -> None:
    folder = tmp_path / "src/lidars"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package><name>lidars</name><version>1.0.0</version></package>", encoding="utf-8"
    )
    error = _fail('<xacro:include filename="$(find lidars)/gone.xacro"/>', tmp_path)
    assert error.code == "xacro.file-missing"
