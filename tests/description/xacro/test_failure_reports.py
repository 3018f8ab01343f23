from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan
from gazelle.workspace import Workspace

HEAD = '<robot name="f" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
LEG = '<xacro:macro name="leg" params="n"/>\n'
ROBOTS = Path(__file__).parent / "robots"

Expand = Callable[..., Diagnostics]


@pytest.fixture
def expand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Expand:
    """Expands a text between the tags of a robot; other files are given by name."""
    monkeypatch.chdir(tmp_path)

    def run(text: str, succeeds: bool = False, head: str = HEAD, **files: str) -> Diagnostics:
        for name, content in files.items():
            Path(name.replace("__", ".")).write_text(content, encoding="utf-8")
        Path("one.xacro").write_text(f"{head}{text}\n</robot>", encoding="utf-8")
        diagnostics = Diagnostics()
        workspace = Workspace.discover(environ={}, cwd=tmp_path)
        found = expand_xacro("one.xacro", workspace=workspace, diagnostics=diagnostics)
        assert (found is not None) == succeeds
        return diagnostics

    return run


@pytest.fixture
def fail(expand: Expand) -> Callable[..., Diagnostic]:
    """Expands a text that has one error."""

    def run(text: str, **options: str) -> Diagnostic:
        (error,) = expand(text, **options).errors
        return error

    return run


Fail = Callable[..., Diagnostic]


@pytest.mark.parametrize(
    ("text", "code", "words", "span"),
    [
        ('<a>\n<v a="${x}"/></a>', "xacro.undefined-name", "name 'x' is not defined", (3, 7, 4)),
        ('<v b="1"\n   a="p ${1+}"/>', "xacro.bad-expression", "invalid syntax", (3, 9, 5)),
        ("<v>\n a ${1/0} b</v>", "xacro.bad-expression", "division by zero", (3, 4, 6)),
        ('<v a="$(arg p)"/>', "xacro.argument-missing", "$(arg p) has no value", (2, 7, 8)),
        ('<v a="$(find np)"/>', "xacro.package-missing", "package 'np' not found", (2, 7, 10)),
        ('\n<xacro:include filename="no.xacro"/>', "xacro.file-missing", "No such", (3, 26, 8)),
        ("<v a=\"${xacro.load_yaml('n.yml')}\"/>", "xacro.file-missing", "No such", (2, 7, 27)),
        ("<xacro:legg/>", "xacro.unknown-macro", "unknown macro name: xacro:legg", (2, 1, 11)),
        (f"{LEG}<xacro:leg/>", "xacro.bad-call", "Undefined parameters [n]", (3, 1, 10)),
        (f'{LEG}<xacro:leg n="1" m="2"/>', "xacro.bad-call", 'parameter "m"', (3, 18, 5)),
        ('<v a="$(env NO_IT)"/>', "xacro.bad-substitution", "'NO_IT' is not set", (2, 7, 12)),
        ('<v a="$(fin x)"/>', "xacro.bad-substitution", "there is no $(fin …)", (2, 7, 8)),
        ('<xacro:if value="yes"/>', "xacro.bad-condition", "not a boolean", (2, 18, 3)),
        ('<xacro:arg name="a"/>', "xacro.bad-element", "needs the attribute", (2, 1, 10)),
        ('<v a="&lt; ${x" b=""/>', "xacro.bad-expression", "no closing '}'", (2, 12, 3)),
        ("<a>\n</b>", "xml.malformed", "mismatched tag", (3, 1, 0)),
    ],
)
def test_failures_are_explained_at_their_place(
    text: str, code: str, words: str, span: tuple[int, int, int], fail: Fail
) -> None:
    error = fail(text)
    assert words in error.message
    assert (error.code, error.span) == (code, SourceSpan("one.xacro", *span))


def test_expression_names_the_values_in_it(fail: Fail) -> None:
    text = '<xacro:property name="radius" value="0.1m"/>\n<xacro:property name="mass" value="2.0"/>'
    error = fail(f'{text}\n<v a="${{radius * mass}}"/>')
    assert error.message == (
        "cannot evaluate '${radius * mass}': can't multiply sequence by non-int of type 'float'; "
        "here radius = '0.1m' (one.xacro:2), mass = 2.0 (one.xacro:3)"
    )
    assert error.fix == "radius is a text; write the number alone: 0.1"


def test_property_that_is_evaluated_later_is_shown_where_it_is_written(fail: Fail) -> None:
    text = (
        '<xacro:property name="a"\n  value="${1 / zero}"/>\n<xacro:property name="zero" value="0"/>'
    )
    error = fail(f'{text}\n<v a="${{a}}"/>')
    assert (error.span.line, error.span.column, error.span.length) == (3, 10, 11)
    assert error.fix == "give zero a value other than 0"


def test_decimal_comma_has_its_own_words(fail: Fail) -> None:
    error = fail('<xacro:property name="r" value="0,5"/><v a="${r * 2.5}"/>')
    assert error.code == "xacro.decimal-comma"
    assert error.message == "property 'r' is '0,5', a text: the decimal sign is a dot"
    assert error.fix == "write 0.5"
    assert fail('<v a="${sqrt(0,25)}"/>').fix == "write the decimal sign as a dot: 0.25"


def test_commas_of_lists_are_no_decimal_commas(fail: Fail) -> None:
    assert fail('<v a="${[1,2][5]}"/>').code == "xacro.bad-expression"
    assert fail('<v a="${[1,2] + 3}"/>').code == "xacro.bad-expression"


def test_include_whose_name_is_unknown_is_one_error(fail: Fail) -> None:
    error = fail('<xacro:include filename="${no}/x.xacro"/><v a="${of_x}"/>')
    assert (error.code, error.span.column) == ("xacro.undefined-name", 26)


def test_decimal_commas_that_xacro_passes_are_warned_of(expand: Expand) -> None:
    text = '<xacro:property name="r" value="0,5"/>\n<v a="${r * 2}"/>'
    (warning,) = expand(text, succeeds=True)
    assert (warning.code, warning.severity) == ("xacro.decimal-comma", Severity.WARNING)
    assert warning.message == "'0,5' is a text to xacro, not a number: '${2 * x}' of it is '0,50,5'"
    assert (warning.span.line, warning.span.column, warning.span.length) == (2, 33, 3)
    (pair,) = expand('<v>\n</v><w a="${0,5 * 2}"/>', succeeds=True)
    assert pair.message.startswith("'(0, 10)' is in the result")
    assert (pair.span.line, pair.span.column) == (3, 5)


def test_pairs_that_are_split_are_no_decimal_commas(expand: Expand) -> None:
    text = '<xacro:property name="p" value="0,5"/><v a="${xacro.tokenize(p)}" b="(0, 5)"/>'
    assert not list(expand(text, succeeds=True))


@pytest.mark.parametrize(
    ("text", "note", "fix"),
    [
        ('<xacro:property name="wheel" value="1"/><v a="${weel}"/>', "", "did you mean 'wheel'?"),
        (
            '<v a="${x}"/>\n<xacro:property name="x" value="1"/>',
            "; it is defined further down (one.xacro:3)",
            "move the property above its first use",
        ),
        (
            '<xacro:macro name="m" params=""><xacro:property name="x" value="1"/></xacro:macro>'
            '<xacro:m/><v a="${x}"/>',
            "; it is defined inside macro 'm' (one.xacro:2) and known only there",
            'define it outside of the macro, or add scope="global" to it',
        ),
        (
            '<xacro:arg name="x" default="1"/><v a="${x}"/>',
            "; one.xacro:2 has an argument of this name",
            "write $(arg x) for an argument",
        ),
        (
            '<xacro:macro name="m" params="x"/><v a="${x}"/>',
            "; it is a parameter of macro 'm' (one.xacro:2) and known only inside it",
            "define the property above its use, or correct its name",
        ),
        (
            '<xacro:property name="b"><o/></xacro:property><v a="${b}"/>',
            "; it is a block of elements here, and no value",
            'put the block in with <xacro:insert_block name="b"/>',
        ),
        ('<v a="${abs(-1)}"/>', "", "write python.abs: xacro has it there"),
    ],
)
def test_undefined_name_is_looked_for(text: str, note: str, fix: str, fail: Fail) -> None:
    error = fail(text)
    assert error.message.endswith(f"is not defined{note}")
    assert error.fix == fix


def test_name_and_macro_of_a_file_nobody_includes_are_found(expand: Expand) -> None:
    other = f'{HEAD}<xacro:property name="len_m" value="1"/>{LEG}</robot>'
    name, macro = expand('<v a="${len_m}"/><xacro:leg n="1"/>', legs__xacro=other)
    line = '<xacro:include filename="legs.xacro"/>'
    assert name.fix == f"include that file above: {line}"
    assert macro.fix == f"legs.xacro:2 defines it; include that file above: {line}"


def test_unknown_macro_gets_a_hint(fail: Fail) -> None:
    assert fail(f'{LEG}<xacro:legs n="1"/>').fix == "did you mean 'leg'?"
    assert fail('<xacro:propery name="x" value="1"/>').fix == "did you mean 'property'?"
    late = fail(f'<xacro:leg n="1"/>\n{LEG}')
    assert late.message.endswith("; it is defined further down (one.xacro:3)")


def test_macro_of_a_namespace_is_named_in_full(fail: Fail) -> None:
    text = '<xacro:include filename="legs.xacro" ns="N"/><xacro:leg n="1"/>'
    assert fail(text, legs__xacro=f"{HEAD}{LEG}</robot>").fix == (
        "it is in a namespace here: write <xacro:N.leg …>"
    )


MACRO = '<xacro:macro name="m" params="a b:=1 *c"/>\n'
TAKES = 'it is defined with params="a b:=1 *c" (one.xacro:2)'


@pytest.mark.parametrize(
    ("call", "message", "fix"),
    [
        (
            '<xacro:m b="2"><o/></xacro:m>',
            f"Undefined parameters [a]: macro 'm' needs a; given: b; {TAKES}",
            'add a="…"',
        ),
        (
            '<xacro:m aa="2"/>',
            f"Invalid parameter \"aa\": macro 'm' does not have it; {TAKES}",
            "did you mean 'a'?",
        ),
        (
            '<xacro:m a="2"/>',
            f"Not enough blocks: macro 'm' takes 1 block(s) (*c); {TAKES}",
            "put one child element for each block into the call",
        ),
        (
            '<xacro:m a="2"><o/><p/></xacro:m>',
            f"Unused block \"p\": macro 'm' takes 1 block(s) (*c); {TAKES}",
            'remove the child element, or add a block to the macro: params="… *p"',
        ),
    ],
)
def test_call_that_does_not_fit_shows_what_the_macro_takes(
    call: str, message: str, fix: str, fail: Fail
) -> None:
    error = fail(MACRO + call)
    assert (error.code, error.message, error.fix) == ("xacro.bad-call", message, fix)


def test_blocks_and_forwarded_parameters_that_are_not_there(expand: Expand) -> None:
    text = '<xacro:macro name="m" params="*hub"><xacro:insert_block name="hubb"/></xacro:macro>'
    (block,) = expand(f"{text}<xacro:m><o/></xacro:m>").errors
    assert block.message == 'Undefined block "hubb"; blocks known here: hub'
    assert block.fix == "did you mean 'hub'?"
    (forward,) = expand('<xacro:macro name="m" params="x:=^"/>\n<xacro:m/>').errors
    assert forward.message == (
        "macro 'm' takes 'x' from its caller (x:=^), and there is no property 'x' there"
    )
    assert (forward.span.line, forward.span.column) == (3, 1)


def test_default_of_a_parameter_is_shown_in_params(fail: Fail) -> None:
    error = fail('<xacro:macro name="m" params="a b:=${no * 2}"/>\n<xacro:m a="1"/>')
    assert (error.span.line, error.span.column, error.span.length) == (2, 36, 9)
    assert [item.line for item in error.span.via] == [3]


def test_yaml_errors_are_shown_in_the_yaml_file(expand: Expand) -> None:
    load = "<xacro:property name='c' value=\"${xacro.load_yaml('c.yaml')}\"/>\n"
    (broken,) = expand(f'{load}<v a="${{c.a}}"/>', c__yaml="a: 1\nb: [1\nc: 3\n").errors
    assert (broken.code, str(broken.span)) == ("xacro.bad-yaml", "c.yaml:2:4")
    assert [str(item) for item in broken.span.via] == ["one.xacro:2:33"]
    (key,) = expand(f'{load}<v a="${{c.wheel.radus}}"/>', c__yaml="wheel: {radius: 1}").errors
    assert key.message.endswith("the yaml dictionary has no key 'radus'; it has radius")
    assert key.fix == "did you mean 'radius'?"


@pytest.mark.parametrize(
    ("expression", "fix"),
    [
        ("${{'a': 1}['a']}", "xacro ends ${…} at the first '}'"),
        ("${1 &amp;&amp; 0}", "Python writes 'and' and 'or'"),
        ("${1 ? 2 : 3}", "Python writes 'A if CONDITION else B'"),
        ("${ }", "write an expression between the braces"),
        ("${2 * 5cm}", "write the number alone, without 'cm'"),
    ],
)
def test_expressions_of_other_languages_get_python(expression: str, fix: str, fail: Fail) -> None:
    assert fail(f'<v a="{expression}"/>').fix.startswith(fix)


def test_eval_that_ends_too_soon_is_told_so(fail: Fail) -> None:
    error = fail("<v a=\"$(eval arg('p') * 2)\"/>")
    assert error.message == "'$(eval arg('p')' is incomplete: xacro ends $(…) at the first ')'"
    assert error.fix == "write ${…} with xacro.arg('name') in place of $(eval …)"


@pytest.mark.parametrize(
    ("value", "fix"),
    [
        ("yes", "write true"),
        ("none", "write false"),
        ("TRUE", "write true"),
        ("1 &lt; 2", "put it into braces: ${1 < 2}"),
        ("has_arm", "write ${has_arm} for a property, $(arg has_arm) for an argument"),
        ("1.0", "write ${1.0 != 0}"),
    ],
)
def test_conditions_that_are_none_get_one(value: str, fix: str, fail: Fail) -> None:
    assert fail(f'<xacro:if value="{value}"/>').fix == fix


def test_property_names_that_python_does_not_take(fail: Fail) -> None:
    error = fail('<xacro:property name="base-link" value="1"/>')
    assert error.message.startswith("Property names must be valid python identifiers")
    assert error.fix == "write 'base_link'"
    twice = fail('<xacro:property name="a" value="1" default="2"/>')
    assert twice.message == "property 'a' has more than one of value, default and remove"


def test_number_in_an_attribute_element_is_explained(fail: Fail) -> None:
    """The official program ends with a traceback here."""
    error = fail('<a>\n  <b><xacro:attribute name="mass" value="${2 * 1.5}"/></b></a>')
    assert (error.code, str(error.span)) == ("xacro.failed", "one.xacro:3:3")
    assert error.message.startswith("'float' object has no attribute 'replace'")
    assert error.fix == 'write value="${str(…)}" in <xacro:attribute>'


def test_missing_argument_says_how_to_give_it(fail: Fail) -> None:
    fix = fail('<v a="$(arg p)"/>').fix
    assert fix == 'pass p:=… or write <xacro:arg name="p" default="…"/>'
    fix = fail('<xacro:property name="p" value="1"/><v a="$(arg p)"/>').fix
    assert fix == "p is a property (one.xacro:2:1): write ${p}"


def test_argument_whose_default_comes_too_late_is_told_so(fail: Fail) -> None:
    """Robots use $(arg name) in <robot name> and declare it below."""
    text = '<v a="$(arg p)"/><xacro:arg name="p" default="1"/>'
    assert "with the default comes after this use" in fail(text).fix


def test_error_in_a_macro_of_an_include_shows_the_way_there(fail: Fail) -> None:
    bad = (
        f'{HEAD}<xacro:macro name="bad" params="n">\n<link name="${{nn}}"/>\n</xacro:macro></robot>'
    )
    error = fail(
        '<xacro:include filename="inc.xacro"/>\n<xacro:macro name="outer" params="">'
        '<xacro:bad n="1"/></xacro:macro>\n<xacro:outer/>',
        inc__xacro=bad,
    )
    assert str(error.span) == "inc.xacro:3:13"
    assert [str(item) for item in error.span.via] == ["one.xacro:3:37", "one.xacro:4:1"]


def test_malformed_include_names_its_own_line_and_who_includes_it(fail: Fail) -> None:
    error = fail('<xacro:include filename="inc.xacro"/>', inc__xacro=f"{HEAD}<a>\n</robot>")
    assert (error.code, error.span.file, error.span.line) == ("xml.malformed", "inc.xacro", 2)
    assert [item.line for item in error.span.via] == [2]


def test_all_problems_of_a_file_are_reported(expand: Expand) -> None:
    text = (
        '<v a="${one}" b="${1/0}" c="${one}"/>\n<xacro:nope/>\n<v>${two + one}</v>\n'
        '<xacro:property name="p" value="${three}"/>\n<v a="${p}"/>\n<xacro:if value="x"/>\n'
        '<xacro:include filename="gone.xacro"/>\n<v a="${of_gone}"/>\n<xacro:of_gone/>\n'
        "<v a=\"$(env NOT_SET)\"/><v a='${abs(1)}'/>"
    )
    found = [(item.span.line, item.code.partition(".")[2]) for item in expand(text).errors]
    assert found == [
        (2, "undefined-name"),
        (2, "bad-expression"),
        (3, "unknown-macro"),
        (7, "bad-condition"),
        (8, "file-missing"),
        (11, "bad-substitution"),
        (11, "undefined-name"),
    ]


def test_files_that_include_each_other_are_named(fail: Fail) -> None:
    other = f'{HEAD}<xacro:include filename="one.xacro"/></robot>'
    error = fail('<xacro:include filename="other.xacro"/>', other__xacro=other)
    assert error.code == "xacro.recursion"
    circle = "one.xacro → other.xacro → one.xacro"
    assert error.message == f"files include each other without end: {circle}"


def test_endless_recursion_ends_with_an_error(fail: Fail) -> None:
    error = fail('<xacro:macro name="m" params=""><xacro:m/></xacro:macro>\n<xacro:m/>')
    assert error.code == "xacro.recursion"
    assert error.message == "macros call each other without end: m"


def test_properties_that_need_each_other_are_named(fail: Fail) -> None:
    text = '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/>'
    error = fail(f'{text}<v a="${{a}}"/>')
    assert error.code == "xacro.recursion"
    assert "circular variable definition: a -> b -> a" in error.message


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
    assert (error.code, error.span) == ("xacro.file-missing", SourceSpan(str(gone)))
    assert str(gone) in error.message


def test_prefix_that_nobody_declares_is_not_called_malformed(fail: Fail) -> None:
    error = fail('  <xacro:property name="a" value="1"/>', head='<robot name="r">\n')
    assert (error.code, str(error.span)) == ("xacro.no-namespace", "one.xacro:1:1")
    assert 'xmlns:xacro="http://www.ros.org/wiki/xacro"' in error.fix
    other = fail("<sensor:x/>", head='<robot name="r">\n')
    assert (other.code, other.fix[:36]) == ("xml.malformed", "declare it in the outermost element:")


def test_include_from_a_missing_package_is_left_out(expand: Expand) -> None:
    text = '<link name="a"/>\n<xacro:include filename="$(find lidars)/x.xacro"/>'
    (finding,) = expand(text, succeeds=True)
    assert finding.code == "xacro.include-left-out"
    assert finding.message == (
        "package 'lidars' not found: this include is left out; the real xacro stops here"
    )
    assert (finding.span.line, finding.span.column) == (3, 1)


def test_macro_of_a_missing_package_says_which_package(fail: Fail) -> None:
    error = fail('<xacro:include filename="$(find lidars)/x.xacro"/>\n<xacro:spinner/>')
    assert error.code == "xacro.unknown-macro"
    assert error.message.endswith("; missing packages may define it: lidars")


def test_include_of_a_missing_file_in_a_package_stays_an_error(fail: Fail, tmp_path: Path) -> None:
    folder = tmp_path / "src/lidars"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package><name>lidars</name><version>1.0.0</version></package>", encoding="utf-8"
    )
    assert fail('<xacro:include filename="$(find lidars)/x.xacro"/>').code == "xacro.file-missing"


BROKEN = [
    ("arm", "inc/common.xacro", "width**2 * length", "width**2 * lenght",
     "inc/common.xacro:16:30", "undefined-name", 2),
    ("arm", "config/joints.yaml", "effort: 20", "efort: 20",
     "inc/common.xacro:23:64", "bad-expression", 2),
    ("arm", "config/joints.yaml", "fore: 0.35}", "fore: 0.35",
     "config/joints.yaml:7:8", "bad-yaml", 2),
    ("arm", "inc/macro.xacro", "*origin config", "origin config",
     "arm.urdf.xacro:7:3", "bad-call", 0),
    ("rover", "rover.urdf.xacro", "sides[side]}", "sides[side]",
     "rover.urdf.xacro:20:24", "bad-expression", 1),
    ("rover", "rover.urdf.xacro", "names[1:]", "names",
     "rover.urdf.xacro:22:7", "recursion", 1),
    ("sensors", "sensors.urdf.xacro", 'default="true"', 'default="on"',
     "sensors.urdf.xacro:19:20", "bad-condition", 0),
    ("sensors", "sensors.urdf.xacro", "</content>", "</content><x/>",
     "sensors.urdf.xacro:20:5", "bad-call", 0),
    ("namespaces", "two.urdf.xacro", "small.gripper name", "smal.gripper name",
     "two.urdf.xacro:10:3", "unknown-macro", 0),
    ("namespaces", "gripper.xacro", "0.1 * scale", "0,1 - scale",
     "gripper.xacro:8:49", "decimal-comma", 1),
    ("scopes", "scopes.urdf.xacro", 'scope="global"', 'scope="local"',
     "scopes.urdf.xacro:17:46", "undefined-name", 0),
    ("scopes", "scopes.urdf.xacro", "count + 1", "count + '1'",
     "scopes.urdf.xacro:6:41", "bad-expression", 2),
    ("dynamic", "dynamic.urdf.xacro", "make_$(arg kind)", "make$(arg kind)",
     "dynamic.urdf.xacro:12:3", "unknown-macro", 0),
    ("dynamic", "dynamic.urdf.xacro", "['radius']", "['radus']",
     "dynamic.urdf.xacro:15:55", "bad-expression", 0),
    ("lazy", "lazy.urdf.xacro", "width + eager", "area + eager",
     "lazy.urdf.xacro:3:3", "recursion", 0),
    ("lazy", "lazy.urdf.xacro", '<xacro:shape><x area="${area}"/>', "<xacro:shape>",
     "lazy.urdf.xacro:14:3", "bad-call", 0),
    ("launchlike", "robot.urdf.xacro", "*.gazebo", "*.gazbo",
     "robot.urdf.xacro:7:3", "unknown-macro", 0),
    ("launchlike", "plugins.gazebo.xacro", "round(", "rond(",
     "plugins.gazebo.xacro:10:24", "undefined-name", 1),
    ("loops", "grid.sdf.xacro", "j + 1", "j", "grid.sdf.xacro:13:9", "recursion", 2),
    ("loops", "grid.sdf.xacro", 'n="3"', 'm="3"', "grid.sdf.xacro:22:23", "bad-call", 0),
    ("reuse", "reuse.urdf.xacro", "<xacro:inner/>", '<xacro:inner name="x"/>',
     "reuse.urdf.xacro:12:18", "bad-call", 1),
    ("reuse", "reuse.urdf.xacro", "list[-1]", "list[3]",
     "reuse.urdf.xacro:17:71", "bad-expression", 0),
]  # fmt: skip


@pytest.mark.parametrize(
    ("robot", "file", "good", "bad", "span", "code", "calls"),
    BROKEN,
    ids=lambda item: str(item)[:20],
)
def test_robots_broken_in_two_ways_each(
    robot: str, file: str, good: str, bad: str, span: str, code: str, calls: int,
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    folder = tmp_path / robot
    shutil.copytree(ROBOTS / robot, folder)
    text = (folder / file).read_text(encoding="utf-8")
    assert good in text
    (folder / file).write_text(text.replace(good, bad, 1), encoding="utf-8")
    monkeypatch.chdir(folder)
    (main,) = [*folder.glob("*.urdf.xacro"), *folder.glob("*.sdf.xacro")]
    diagnostics = Diagnostics()
    expand_xacro(main.name, workspace=None, diagnostics=diagnostics)
    found = diagnostics.by_code(f"xacro.{code}")
    assert [(str(item.span), len(item.span.via)) for item in found] == [(span, calls)]
    assert len(diagnostics.errors) == (code != "decimal-comma")
