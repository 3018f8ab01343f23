from __future__ import annotations

import pytest

from gazelle.description.model import PluginTag
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.parameters import Parameter, ParameterTable
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

TABLE = PluginTable(
    ParameterTable(
        "test",
        "A table.",
        ("test",),
        (
            Parameter("topicName", "text", "odom", "a topic", "", aliases=("topic_name",)),
            Parameter("updateRate", "number", 50.0, "a rate", "Hz"),
            Parameter("publishTf", "flag", True, "a switch"),
            Parameter("xyz", "vector", (0.0, 0.0, 1.0), "a place", "m"),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
)


def reader(inner: str) -> tuple[PluginReader, Diagnostics]:
    diagnostics = Diagnostics()
    text = f"<plugin name='p' filename='libtest.so'>{inner}</plugin>"
    tag = parse_xml(text, "robot.urdf", diagnostics)
    assert tag is not None
    return PluginReader(PluginTag("p", "libtest.so", tag), TABLE, diagnostics), diagnostics


def test_absent_keys_have_the_tables_defaults() -> None:
    keys, _ = reader("")
    assert keys.text("topicName") == "odom"
    assert keys.number("updateRate") == 50.0
    assert keys.flag("publishTf") is True
    assert keys.vector("xyz") == (0.0, 0.0, 1.0)
    assert not keys.has("topicName")


def test_both_spellings_are_read() -> None:
    assert reader("<topicName> a </topicName>")[0].text("topicName") == "a"
    assert reader("<topic_name>b</topic_name>")[0].text("topicName") == "b"


@pytest.mark.parametrize(("word", "value"), [("1", True), ("true", True), ("0", False)])
def test_flags_take_words_and_digits(word: str, value: bool) -> None:
    assert reader(f"<publishTf>{word}</publishTf>")[0].flag("publishTf") is value


def test_a_bad_number_is_reported_with_its_place() -> None:
    keys, diagnostics = reader("\n<updateRate>fast</updateRate>")
    assert keys.number("updateRate") == 50.0
    (found,) = diagnostics
    assert "<updateRate>: 'fast' is not a finite number" in found.message
    assert str(found.span) == "robot.urdf:2:1"


def test_unknown_keys_are_reported_with_the_nearest() -> None:
    keys, diagnostics = reader("<topicNme>a</topicNme><alwaysOn>true</alwaysOn>")
    keys.report_unread()
    (unknown,) = diagnostics.by_code("parameter.unknown")
    assert unknown.message == "plug-in 'p' (libtest.so) has no key <topicNme>; it has no effect"
    assert unknown.fix.startswith("did you mean 'topicName'")
    (idle,) = diagnostics.by_code("parameter.idle")
    assert "<alwaysOn> (a model plug-in always runs)" in idle.message


def test_a_ros_block_gives_namespace_and_remappings() -> None:
    keys, diagnostics = reader(
        "<ros><namespace>/r1</namespace><remapping>~/out:=scan</remapping>"
        "<argument>--ros-args -r odom:=wheel_odom</argument><remaping>a:=b</remaping></ros>"
    )
    assert keys.ros.namespace == "/r1"
    assert keys.ros.remapped("~/out") == "scan"
    assert keys.ros.remapped("odom") == "wheel_odom"
    assert keys.ros.remapped("cmd_vel") == "cmd_vel"
    (found,) = diagnostics.by_code("parameter.unknown")
    assert "<ros> has no element <remaping>" in found.message


def test_arguments_of_a_ros_block_are_the_words_of_a_command_line() -> None:
    keys, diagnostics = reader(
        "<ros><argument>--ros-args</argument><argument>--params-file</argument>"
        "<argument>/etc/gains.yaml</argument><argument>-r a:=b --remap</argument>"
        "<argument>c:=d</argument><argument>-p use_sim_time:=true</argument></ros>"
    )
    assert keys.ros.parameter_files == ("/etc/gains.yaml",)
    assert keys.ros.remappings == (("a", "b"), ("c", "d"))
    (found,) = diagnostics.by_code("parameter.unknown")
    assert found.message == "argument '-p use_sim_time' of <ros> has no effect"
    keys.report_unread()
    (idle,) = diagnostics.by_code("parameter.idle")
    assert "--params-file /etc/gains.yaml" in idle.message
