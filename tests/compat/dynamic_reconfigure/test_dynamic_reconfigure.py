"""Programs with dynamic_reconfigure's Python modules, run as they stand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Node
from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    ReconfigureClient,
    ReconfigureServer,
)

Run = Callable[..., Any]

# The tutorial's file (wiki.ros.org/dynamic_reconfigure/Tutorials), with a group.
CFG = """#!/usr/bin/env python
PACKAGE = "dynamic_tutorials"

from dynamic_reconfigure.parameter_generator_catkin import *

gen = ParameterGenerator()

gen.add("int_param",    int_t,    0, "An Integer parameter", 50,  0, 100)
gen.add("double_param", double_t, 2, "A double parameter",    .5, 0,   1)
gen.add("str_param",    str_t,    0, "A string parameter",  "Hello World")
gen.add("bool_param",   bool_t,   4, "A Boolean parameter",  True)

size_enum = gen.enum([ gen.const("Small",      int_t, 0, "A small constant"),
                       gen.const("Medium",     int_t, 1, "A medium constant"),
                       gen.const("Large",      int_t, 2, "A large constant"),
                       gen.const("ExtraLarge", int_t, 3, "An extra large constant")],
                     "An enum to set size")

group = gen.add_group("Sizes and more", type="tab")
group.add("size", int_t, 8, "A size, edited via an enum", 1, 0, 3, edit_method=size_enum)
group.add("unbounded", double_t, 0, "No limits")

exit(gen.generate(PACKAGE, "dynamic_tutorials", "Tutorials"))
"""

SERVER = """
import rospy
from dynamic_reconfigure.server import Server
from dynamic_tutorials.cfg import TutorialsConfig

assert TutorialsConfig.defaults["double_param"] == 0.5 and TutorialsConfig.all_level == 14
assert TutorialsConfig.max["unbounded"] == float("inf") and TutorialsConfig.type["size"] == "int"
assert TutorialsConfig.Tutorials_ExtraLarge == 3
calls = []

def callback(config, level):
    calls.append(level)
    print("level", level, config.int_param, config["size"], sorted(config["groups"]["groups"]))
    config.str_param = config["str_param"].upper()
    return config

rospy.init_node("dynamic_tutorials")
srv = Server(TutorialsConfig, callback)
assert calls == [-1] and srv.config.str_param == "HELLO WORLD"
assert rospy.get_param("~str_param") == "HELLO WORLD"
assert srv.update_configuration({"int_param": 1000})["int_param"] == 100
inner = Server(TutorialsConfig, lambda config, level: config, "inner")
assert rospy.get_param("~inner/size") == 1
try:
    Server(TutorialsConfig, lambda config, level: None, namespace="bad")
except Exception as error:
    assert type(error).__name__ == "DynamicReconfigureCallbackException", error
print("ready")
rospy.spin()
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace with the tutorial's package, which has no Python module of its own."""
    package = tmp_path / "ws" / "src" / "dynamic_tutorials"
    (package / "cfg").mkdir(parents=True)
    (package / "cfg" / "Tutorials.cfg").write_text(CFG)
    (package / "package.xml").write_text(
        "<package format='2'><name>dynamic_tutorials</name><version>0.1.0</version>"
        "<description>d</description><maintainer email='a@b.c'>a</maintainer>"
        "<license>x</license></package>"
    )
    return tmp_path / "ws"


def test_server_of_a_cfg_file_is_seen_and_changed_by_others(
    program: Run, workspace: Path, node: Node, eventually: Run
) -> None:
    running = program(SERVER, ROS_PACKAGE_PATH=str(workspace / "src"))
    client = ReconfigureClient(node, "/dynamic_tutorials")
    group = client.wait_for_description(20.0)
    assert group is not None, running.text
    assert [row.name for row in group.parameters][:2] == ["int_param", "double_param"]
    (inner,) = group.groups
    assert (inner.name, inner.type) == ("Sizes_and_more", "tab")
    eventually(lambda: "ready" in running.lines)
    found = client.set(
        {"size": "ExtraLarge", "double_param": 3, "str_param": "bye"}, timeout_s=stretched(30)
    )
    assert found == {
        "bool_param": True,
        "int_param": 100,
        "size": 3,
        "str_param": "BYE",
        "double_param": 1.0,
        "unbounded": 0.0,
    }
    eventually(lambda: "level 10 100 3 ['Sizes_and_more']" in running.lines)


CLIENT = """
import rospy
import dynamic_reconfigure, dynamic_reconfigure.client
from dynamic_reconfigure.encoding import Config, decode_config, encode_config, extract_params
from dynamic_reconfigure.msg import Config as ConfigMsg
rospy.init_node("tuner")
assert dynamic_reconfigure.find_reconfigure_services() == ["/camera"]
got = []
client = dynamic_reconfigure.client.Client("camera", timeout=30, config_callback=got.append)
config = client.get_configuration(timeout=30)
assert (config.p, config["groups"]["groups"]["More"]["on"]) == (1.0, False), config
names = [row["name"] for row in client.get_parameter_descriptions()]
rows = extract_params(client.get_group_descriptions())
assert names == ["p", "on"] == [row["name"] for row in rows]
answer = client.update_configuration({"p": "2.5", "on": "yes", "groups": {"More": False}})
assert (answer.p, answer.on, answer.groups.groups.More.state) == (2.5, True, False), answer
while not any(config["p"] == 2.5 for config in got):
    rospy.rostime.wallsleep(0.005)
wrong = (({"q": 1}, "don't know parameter: q"), ({"p": "x"}, "can't set parameter 'p'"))
for changes, text in wrong:
    try:
        client.update_configuration(changes)
    except dynamic_reconfigure.DynamicReconfigureParameterException as error:
        assert text in str(error), error
    else:
        raise AssertionError(changes)
message = encode_config(Config(p=1.5, on=True, n=3, s="x"))
assert isinstance(message, ConfigMsg) and message.ints[0].value == 3
assert decode_config(message) == {"p": 1.5, "on": True, "n": 3, "s": "x"}
client.close()
try:
    dynamic_reconfigure.client.Client("nobody", timeout=0.05)
except rospy.ROSException as error:
    assert "timeout exceeded while waiting for service /nobody/set_parameters" in str(error)
else:
    raise AssertionError("nobody answers")
"""


def test_client_sees_and_changes_a_server_of_gazelle(passes: Run, node: Node) -> None:
    group = DynamicGroup(
        "Default",
        (DynamicParameter("p", "double", 1.0, "Gain."),),
        (DynamicGroup("More", (DynamicParameter("on", "bool", False, "Switch."),)),),
    )
    server = ReconfigureServer(node, "/camera", group, lambda values, level: None)
    passes(CLIENT)
    assert server.values == {"p": 2.5, "on": True}
    assert server.states == {"Default": True, "More": False}


WRONG = """
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
def raises(kind, text, function, *words, **more):
    try:
        function(*words, **more)
    except kind as error:
        assert text in str(error), error
    else:
        raise AssertionError(text)
raises(TypeError, "'a' has type int, but default is 1.5", gen.add, "a", int_t, 0, "d", 1.5)
raises(ValueError, "naming conventions", gen.add, "1a", int_t, 0, "d")
raises(ValueError, "Max or min specified for a", gen.add, "a", str_t, 0, "d", "x", max="y")
raises(ValueError, "Inconsistent types in enum", gen.enum,
       [gen.const("A", int_t, 1, ""), gen.const("B", str_t, "b", "")], "mixed")
for name, text in (("Nothing", "No module named 'dynamic_tutorials.cfg.NothingConfig'"),
                   ("Silent", "does not call generate()"), ("Failing", "ended with 3")):
    try:
        __import__("dynamic_tutorials.cfg." + name + "Config")
    except ImportError as error:
        assert text in str(error), error
    else:
        raise AssertionError(name)
"""


def test_mistakes_in_cfg_files_are_said(passes: Run, workspace: Path) -> None:
    folder = workspace / "src" / "dynamic_tutorials" / "cfg"
    (folder / "Silent.cfg").write_text("print('nothing')\n")
    (folder / "Failing.cfg").write_text("exit(3)\n")
    passes(WRONG, ROS_PACKAGE_PATH=str(workspace / "src"))
