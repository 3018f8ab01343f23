"""Launch files in XML and YAML: every element, its types, and what is refused."""

from __future__ import annotations

import io
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.launch.ros2 import LaunchContext, LaunchDescription
from gazelle.launch.ros2 import actions as a
from gazelle.launch.ros2.frontend import (
    Entity,
    Parser,
    expose,
    expose_action,
    expose_substitution,
    type_utils,
)
from gazelle.launch.ros2.frontend.xml import Parser as XmlParser
from gazelle.launch.ros2.frontend.yaml import Parser as YamlParser
from gazelle.launch.ros2.utilities import perform_substitutions

Run = Callable[..., Any]
_Elements = list[tuple[str, dict[str, Any], list[Any]]]


def _parsed(text: str, kind: type[Parser] = XmlParser) -> LaunchDescription:
    root, parser = kind.load(io.StringIO(text))
    return parser.parse_description(root)


def _xml(body: str) -> Any:
    (action,) = _parsed(f"<launch>{body}</launch>").entities
    return action


def _yaml(element: dict[str, Any]) -> Any:
    (action,) = _parsed(yaml.safe_dump({"launch": [element]}), YamlParser).entities
    return action


def _said(ran: Any) -> list[str]:
    head = "[INFO] [launch.user]: "
    return [line.removeprefix(head) for line in ran.lines if line.startswith(head)]


# Each element in both spellings, and what the launch then says.
_ROWS: dict[str, tuple[str, list[dict[str, Any]], list[str]]] = {
    "arg": (
        '<arg name="x" default="1" description="d"><choice value="1"/><choice value="2"/></arg>'
        '<log message="$(var x)"/>',
        [
            {
                "arg": {
                    "name": "x",
                    "default": "1",
                    "description": "d",
                    "choice": [{"value": "1"}, {"value": "2"}],
                }
            },
            {"log": {"message": "$(var x)"}},
        ],
        ["1"],
    ),
    "let": (
        '<let name="x" value="a $(env PATH)"/><log message="$(var x)"/>',
        [
            {"let": {"name": "x", "value": "a $(env PATH)"}},
            {"log": {"message": "$(var x)"}},
        ],
        [f"a {os.environ.get('PATH')}"],
    ),
    "set_env": (
        '<set_env name="GZ_X" value="1"/><log message="$(env GZ_X)"/>',
        [{"set_env": {"name": "GZ_X", "value": "1"}}, {"log": {"message": "$(env GZ_X)"}}],
        ["1"],
    ),
    "append_env": (
        '<append_env name="GZ_X" value="1"/>'
        '<append_env name="GZ_X" value="2" prepend="$(var yes)" separator="|"/>'
        '<log message="$(env GZ_X)"/>',
        [
            {"append_env": {"name": "GZ_X", "value": "1"}},
            {"append_env": {"name": "GZ_X", "value": "2", "prepend": True, "separator": "|"}},
            {"log": {"message": "$(env GZ_X)"}},
        ],
        ["2|1"],
    ),
    "unset_env": (
        '<set_env name="GZ_X" value="1"/><unset_env name="GZ_X"/><log message="$(env GZ_X no)"/>',
        [
            {"set_env": {"name": "GZ_X", "value": "1"}},
            {"unset_env": {"name": "GZ_X"}},
            {"log": {"message": "$(env GZ_X no)"}},
        ],
        ["no"],
    ),
    "reset_env": (
        '<set_env name="GZ_X" value="1"/><reset_env/><log message="$(env GZ_X no)"/>',
        [
            {"set_env": {"name": "GZ_X", "value": "1"}},
            {"reset_env": {}},
            {"log": {"message": "$(env GZ_X no)"}},
        ],
        ["no"],
    ),
    "group": (
        '<group scoped="true"><let name="x" value="in"/><log message="$(var x)"/></group>'
        '<group if="$(var no)"><log message="never"/></group>'
        '<group unless="$(var no)" forwarding="false"><keep name="y" value="$(var yes)"/>'
        '<log message="$(var y) $(var yes gone)"/></group><log message="$(var x out)"/>',
        [
            {
                "group": {
                    "scoped": True,
                    "children": [
                        {"let": {"name": "x", "value": "in"}},
                        {"log": {"message": "$(var x)"}},
                    ],
                }
            },
            {"group": {"if": "$(var no)", "children": [{"log": {"message": "never"}}]}},
            {
                "group": {
                    "unless": "$(var no)",
                    "forwarding": False,
                    "keep": [{"name": "y", "value": "$(var yes)"}],
                    "children": [{"log": {"message": "$(var y) $(var yes gone)"}}],
                }
            },
            {"log": {"message": "$(var x out)"}},
        ],
        ["in", "true gone", "out"],
    ),
    "reset": (
        '<reset><keep name="a" value="$(var yes)"/></reset><log message="$(var a)$(var yes -)"/>',
        [
            {"reset": {"keep": [{"name": "a", "value": "$(var yes)"}]}},
            {"log": {"message": "$(var a)$(var yes -)"}},
        ],
        ["true-"],
    ),
    "timer": (
        '<timer period="$(var period)" cancel_on_shutdown="false"><log message="t"/></timer>',
        [
            {
                "timer": {
                    "period": 0.0,
                    "cancel_on_shutdown": True,
                    "children": [{"log": {"message": "t"}}],
                }
            }
        ],
        ["t"],
    ),
    "shutdown": (
        '<timer period="60.0"><log message="never"/></timer><shutdown reason="$(var yes)"/>',
        [{"shutdown": {"reason": "enough"}}],
        [],
    ),
    "log": ('<log message="a \\$(b)"/>', [{"log": {"message": "a \\$(b)"}}], ["a $(b)"]),
}
_TESTED_APART = {
    *("executable", "include", "for", "for_each"),
    *("log_debug", "log_error", "log_info", "log_warning"),
}


@pytest.mark.parametrize("name", _ROWS)
def test_element(name: str, run: Run) -> None:
    xml, elements, expected = _ROWS[name]
    given = {"yes": "true", "no": "0", "period": "0.1"}
    environment = dict(os.environ)
    assert _said(run(_parsed(f"<launch>{xml}</launch>"), **given)) == expected
    os.environ.clear()
    os.environ.update(environment)
    text = yaml.safe_dump({"launch": elements}, sort_keys=False)
    assert _said(run(_parsed(text, YamlParser), **given)) == expected


def test_every_element_of_launch_is_tested() -> None:
    Parser.load_launch_extensions()
    own = {
        name
        for name, method in expose.action_parse_methods.items()
        if method.__module__.startswith("gazelle.launch.ros2.actions")
    }
    # launch_ros's timer inherits this one's way to be read.
    assert own - {"ros_timer"} == {*_ROWS, *_TESTED_APART}


def _words(cmd: Any) -> list[str]:
    context = LaunchContext()
    context.launch_configurations["x"] = "X Y"
    return [perform_substitutions(context, word) for word in cmd]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ls -l", ["ls", "-l"]),
        ("ls -l -a  '/a b'", ["ls", "-l", "-a", "/a b"]),
        ("a/$(var x)/b c", ["a/X Y/b", "c"]),
        ("$(var x)", ["X Y"]),
        ("$(var x) $(var x)", ["X Y", "X Y"]),
        ("a $(var x)$(var x) b", ["a", "X YX Y", "b"]),
        ("a b $(var x)c d", ["a", "b", "X Yc", "d"]),
    ],
)
def test_command_lines_are_cut_at_blanks_of_their_own(text: str, expected: list[str]) -> None:
    assert _words(_xml(f'<executable cmd="{text}"/>').cmd) == expected


def test_executable_with_everything(run: Run) -> None:
    attributes = (
        'name="me" cwd="/" launch-prefix="nice" output="screen" respawn="$(var again)" '
        'respawn_delay="0.5" respawn_max_retries="1" sigterm_timeout="1" sigkill_timeout="2.5" '
        'shell="false" emulate_tty="true" on_exit="shutdown"'
    )
    found = _xml(
        f'<executable cmd="env" {attributes}>'
        '<env name="GZ_$(var n)" value="$(var v)"/></executable>'
    )
    assert (found.shell, found.emulate_tty) == (False, True)
    assert [one.text for one in found.sigterm_timeout] == ["1.0"]
    assert [one.text for one in found.sigkill_timeout] == ["2.5"]
    assert isinstance(found.get_sub_entities()[0], a.Shutdown)
    ran = run(found, n="X", v="1", again="false")
    assert f"[{found.name}] GZ_X=1" in ran.lines
    assert (found.cmd, found.cwd) == (["nice", "env"], "/")


def test_executable_in_yaml() -> None:
    found = _yaml(
        {
            "executable": {
                "cmd": "env",
                "respawn": True,
                "shell": True,
                "env": [{"name": "a", "value": "b"}],
            }
        }
    )
    assert found.shell
    assert found.additional_env[0][1][0].text == "b"


@pytest.mark.parametrize("tag", ["arg", "let"])
def test_include_passes_arguments(tag: str, run: Run, tmp_path: Path) -> None:
    inner = tmp_path / "inner.launch.xml"
    text = '<launch><arg name="x"/><log message="$(var x) $(dirname)"/></launch>'
    inner.write_text(text, encoding="utf-8")
    given = f'<{tag} name="x" value="$(var y)"/>'
    file = "$(var folder)/inner.launch.xml"
    entities = {"include": {"file": file, tag: [{"name": "x", "value": "$(var y)"}]}}
    text = yaml.safe_dump({"launch": [entities]})
    for include in (_xml(f'<include file="{file}">{given}</include>'), _parsed(text, YamlParser)):
        ran = run(include, folder=str(tmp_path), y="1")
        assert _said(ran) == [f"1 {tmp_path}"]


def test_readers_of_other_packages_and_actions_of_users() -> None:
    @expose_action("say_twice")
    def _say_twice(entity: Entity, parser: Parser) -> Any:
        _, kwargs = a.LogInfo.parse(entity, parser)
        return a.GroupAction, {"actions": [a.LogInfo(**kwargs)] * 2}

    @expose_substitution("loud")
    def _loud(data: Any) -> Any:
        return a_text, {"text": data[0][0].text.upper()}

    from gazelle.launch.ros2.substitutions import TextSubstitution as a_text

    try:
        found = _xml('<say_twice message="$(loud hey)"/>')
        assert [one.msg[0].text for one in found.get_sub_entities()[2:4]] == ["HEY", "HEY"]
        with pytest.raises(RuntimeError, match="Two action parsing methods exposed with the same"):
            expose_action("say_twice")(lambda entity, parser: None)
        with pytest.raises(RuntimeError, match="Did not find a class method called 'parse'"):
            expose_action("x")(str)
    finally:
        del expose.action_parse_methods["say_twice"], expose.substitution_parse_methods["loud"]


def test_types_of_attributes() -> None:
    root, _ = XmlParser.load(
        io.StringIO('<a i="3" f="2.5" b="true" l="1;2" l-sep=";" t="[a, b]" s="text"><c/><c/></a>')
    )
    assert root.get_attr("i", data_type=int) == 3
    assert root.get_attr("f", data_type=float) == 2.5
    assert root.get_attr("b", data_type=bool) is True
    assert root.get_attr("l", data_type=list[int]) == [1, 2]
    assert root.get_attr("t", data_type=list[str]) == ["a", "b"]
    assert root.get_attr("f", data_type=None) == 2.5
    assert len(root.get_attr("c", data_type=list[Entity])) == 2
    assert root.get_attr("none", optional=True) is None
    with pytest.raises(TypeError, match="'s' of Entity 'a' expected to be of type"):
        root.get_attr("s", data_type=int, can_be_str=False)
    with pytest.raises(
        AttributeError, match=r"Attribute 'none' of type .* not found in Entity 'a'"
    ):
        root.get_attr("none")
    assert type_utils.get_data_type_from_identifier("int") is int
    with pytest.raises(ValueError, match=r"invalid type identifier 'number'"):
        type_utils.get_data_type_from_identifier("number")


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<lgo/>", "Unrecognized entity of the type: lgo \\(did you mean 'log'"),
        ('<log message="a" mesage="b"/>', "Unexpected attribute\\(s\\) found in `log`: {'mesage'}"),
        ('<log message="a"><x/></log>', "Unexpected nested tag\\(s\\) found in `log`: {'x'}"),
        ("<log/>", "Attribute 'message' of type .* not found in Entity 'log'"),
        ('<log message="a" if="1" unless="0"/>', "if and unless conditions can't be used"),
        ('<executable cmd="a" shell="$(var x)"/>', "expected to be a plain bool but got"),
        ('<executable cmd="a" respawn_delay="-1"/>', "expected to be a non-negative value"),
        ('<executable cmd="a" on_exit="restart"/>', "expected to be shutdown but got `restart`"),
        ('<log message="$(var x"/>', "is not closed"),
    ],
)
def test_wrong_xml(body: str, message: str) -> None:
    with pytest.raises((ValueError, RuntimeError, AttributeError), match=message):
        _parsed(f"<launch>{body}</launch>")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("launch: 3", "Expected a dict or list in `launch`, got int"),
        ("{a: [], b: []}", "Expected only one root"),
        ("lunch: []", "Expected 'launch' as root tag"),
        ("launch: [log]", "Subentities must be a dictionary with only one key"),
        ("launch: [{log: {message: 3}}]", "'message' of Entity 'log' expected to be of type"),
        ("launch: [{log: {message: a, x: b}}]", "Unexpected key\\(s\\) found in `log`: {'x'}"),
        ("launch: [{log: {}}]", "Can not find attribute 'message' in Entity 'log'"),
        ("launch: [{group: {}}]", "Expected entity `group` to have children entities"),
        ("launch: [{reset: {keep: 3}}]", "'keep' of Entity 'reset' expected to be a list of dict"),
        ("launch: [{arg: [a]}]", "Can not find attribute 'name' in Entity 'arg'"),
        ("launch: [{reset_env: [a]}]", "Unexpected nested entity\\(ies\\) found in `reset_env`"),
    ],
)
def test_wrong_yaml(text: str, message: str) -> None:
    kinds = (ValueError, RuntimeError, TypeError, AttributeError)
    with pytest.raises(kinds, match=message):
        _parsed(text, YamlParser)


def test_files_are_read_by_extension_then_by_trying(tmp_path: Path) -> None:
    assert Parser.is_filename_valid("a.launch.yml")
    assert not Parser.is_filename_valid("a.txt")
    assert Parser.get_file_extensions_from_parsers() >= {"launch", "launch.xml", "launch.yaml"}
    assert Parser.get_available_extensions() == ["launch_xml", "launch_yaml"]
    path = tmp_path / "unknown.txt"
    path.write_text("launch: []", encoding="utf-8")
    root, parser = Parser.load(str(path))
    assert isinstance(parser, YamlParser)
    assert root.type_name == "launch"
    with pytest.warns(UserWarning, match="deprecated"):
        assert Parser.get_parser_from_extension("xml") is XmlParser
