"""``ros2 control`` and ``controller_manager`` against a manager in a paused world."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.control.manager_world import manager_world
from tests.patience import stretched

from gazelle.cli import controller_manager
from gazelle.cli.ros2 import control
from gazelle.cli.ros2 import main as ros2
from gazelle.errors import GraphError
from gazelle.graph import Graph
from gazelle.nodes.controller_manager import client as controller_manager_client

Run = Callable[..., tuple[int, str]]


@pytest.fixture
def graph(free_port: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Graph]:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    for name in ("ROS_NAMESPACE", "ROS_DOMAIN_ID", "ROS_MASTER_URI"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "0")
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        # The manager's log belongs to the simulator's terminal.
        graph.console = lambda *_record, **_options: None
        yield graph


@pytest.fixture
def manager(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """A ros2_control manager called /controller_manager."""
    with manager_world(graph, monkeypatch, 2, namespace="/") as manager:
        yield manager


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs ``ros2 control WORDS…``; gives exit code and both outputs."""

    def run(*words: str) -> tuple[int, str]:
        code = ros2(["control", *words])
        captured = capsys.readouterr()
        return code, captured.out + captured.err

    return run


def test_controllers_are_listed_in_columns(manager, run):
    assert run("list_controllers") == (0, "No controllers are currently loaded!\n")
    for name in ("left", "right"):
        manager.load(name)
    manager.configure("left")
    manager.switch(start=["left"])
    code, text = run("list_controllers")
    assert (code, text.splitlines()) == (
        0,
        [
            "left  test_controllers/Recorder  active      ",
            "right test_controllers/Recorder  unconfigured",
        ],
    )
    _, text = run("list_controllers", "-v")
    assert (
        "\tupdate_rate: 100 Hz\n\tis_async: False\n\tclaimed interfaces:\n\t\tleft/effort\n" in text
    )
    _, text = run("list_controllers", "--required-state-interfaces")
    assert "\trequired state interfaces:\n\t\tleft/position\n" in text


def test_states_are_coloured_where_that_is_asked_for(manager, run, monkeypatch):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    manager.load("left")
    assert "\033[93munconfigured\033[0m" in run("list_controllers")[1]


def test_types_are_listed_with_their_base_class(manager, run):
    line = f"{'test_controllers/Recorder':70s} controller_interface::ControllerInterface\n"
    assert run("list_controller_types") == (0, line)


def test_hardware_is_listed_with_what_is_claimed(manager, run):
    manager.load("left")
    manager.configure("left")
    manager.switch(start=["left"])
    _, text = run("list_hardware_interfaces")
    assert text.startswith("command interfaces\n\tleft/effort [available] [claimed]\n")
    assert "\tleft/position [available] [unclaimed]\n" in text
    assert "\nstate interfaces\n\tleft/effort\n" in text
    _, text = run("list_hardware_components", "-v")
    assert text.startswith(
        "Hardware Component 1\n\tname: block\n\ttype: system\n\tplugin name: test/Hardware\n"
        "\tstate: id=3 label=active\n\tread/write rate: 100 Hz\n\tis_async: False\n"
        "\tcommand interfaces\n"
    )
    assert "\t\tleft/effort [double] [available] [claimed]\n" in text
    assert "\tstate interfaces\n\t\tleft/position [double] [available]\n" in text


def test_a_controller_goes_through_its_states(manager, run):
    assert run("load_controller", "left") == (0, "Successfully loaded controller left\n")
    for state, word in (
        ("inactive", "configured"),
        ("active", "activated"),
        ("inactive", "deactivated"),
        ("unconfigured", "cleaned up"),
    ):
        assert run("set_controller_state", "left", state) == (0, f"Successfully {word} left\n")
        assert manager.controllers["left"].state == state
    assert run("unload_controller", "left") == (0, "Successfully unloaded controller left\n")
    assert not manager.controllers


def test_a_controller_is_loaded_into_a_state_with_its_file(manager, run, tmp_path):
    file = tmp_path / "third.yaml"
    file.write_text(
        "third:\n  ros__parameters:\n    type: test_controllers/Recorder\n    joint: right\n"
    )
    code, text = run("load_controller", "--set-state", "active", "third", str(file))
    assert code == 0, text
    assert "Successfully loaded controller third into state active" in text
    assert manager.controllers["third"].commands == ("right/effort",)
    assert "already loaded, skipping load_controller!" in run("load_controller", "third")[1]
    code, text = run("load_controller", "fourth", "/no/such.yaml")
    assert (code, text) == (
        1, "Controller parameter file : /no/such.yaml does not exist, Aborting!\n")  # fmt: skip


def test_controllers_are_switched_together(manager, run):
    for name in ("left", "right"):
        manager.load(name)
        manager.configure(name)
    manager.switch(start=["left"])
    words = ("switch_controllers", "--activate", "right", "--deactivate", "left", "--strict")
    assert run(*words)[0] == 0
    assert manager.controllers["right"].is_active
    assert not manager.controllers["left"].is_active
    code, text = run(*words)
    assert code == 1
    assert "Could not deactivate controller 'left' since it is not active" in text


@pytest.mark.parametrize(
    ("words", "phrase"),
    [
        (("set_controller_state", "lefd", "active"), "does not seem to be loaded; did you mean"),
        (("set_controller_state", "left", "active"), "cannot put left in 'active' state from its "
         "current state unconfigured"),
        (("load_controller", "lefd"), "Failed loading controller lefd check controller_manager"),
        (("unload_controller", "lefd"), "Error unloading controller lefd, check controller_man"),
        (("reload_controller_libraries",), "Error reloading libraries, check controller_manager"),
        (("set_hardware_component_state", "block", "active"), "cannot activate block from its "
         "current state active"),
        (("set_hardware_component_state", "block", "unconfigured"), "cannot cleanup block from its "
         "current state active; set it inactive first"),
        (("set_hardware_component_state", "blok", "inactive"), "component blok does not seem to be "
         "loaded; did you mean 'block'"),
        (("cleanup_controller", "lefd"), "Error cleanup controllers, check controller_manager"),
    ],
)  # fmt: skip
def test_failures_have_exit_code_1_and_a_reason(manager, run, words, phrase):
    manager.load("left")
    code, text = run(*words)
    assert code == 1
    assert phrase in text


def test_hardware_goes_from_state_to_state(manager, run):
    for label, number in (("inactive", 2), ("unconfigured", 1), ("inactive", 2), ("active", 3)):
        code, text = run("set_hardware_component_state", "block", label)
        wanted = f"lifecycle_msgs.msg.State(id={number}, label='{label}')"
        assert (code, text) == (0, f"Successfully set block to state {wanted}\n")
        assert f"state: id={number} label={label}" in run("list_hardware_components")[1]


def test_an_inactive_controller_is_cleaned_up(manager, run):
    manager.load("left")
    manager.configure("left")
    assert run("cleanup_controller", "left") == (0, "Successfully cleaned up controller left\n")
    assert manager.controllers["left"].state == "unconfigured"


def test_reload_with_force_unloads_everything(manager, run):
    manager.load("left")
    assert run("reload_controller_libraries", "--force-kill") == (0, "Reload successful\n")
    assert not manager.controllers


def test_ros2_names_its_commands(capsys):
    assert ros2([]) == 0
    assert "  control    Various control related sub-commands" in capsys.readouterr().out
    assert ros2(["contrl"]) == 2
    assert "invalid choice: 'contrl' (did you mean 'control'" in capsys.readouterr().err


def test_without_a_graph_the_command_says_so(free_port, monkeypatch, run):
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    code, text = run("list_controllers")
    assert code == 1
    assert "no graph is running" in text


@pytest.fixture
def ros1(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """A ros_control manager in /mira."""
    with manager_world(graph, monkeypatch) as manager:
        yield manager


def test_ros2_control_refuses_a_ros1_manager(ros1, run):
    code, text = run("list_controllers", "-c", "/mira/controller_manager")
    assert code == 1
    assert "is a controller manager of ROS 1; use: controller_manager list" in text


def _ros1(capsys: Any, *words: str) -> tuple[int, str]:
    code = controller_manager.main(list(words))
    captured = capsys.readouterr()
    return code, captured.out + captured.err


def test_controller_manager_speaks_as_ros1s(ros1, capsys):
    here = ("--namespace", "/mira")
    empty = "No controllers are loaded in mechanism control\n"
    assert _ros1(capsys, "list", *here) == (0, empty)
    assert _ros1(capsys, "spawn", "left", "right", *here) == (
        0,
        "Loaded 'left'\nLoaded 'right'\nStarted ['left'] successfully\n"
        "Started ['right'] successfully\n",
    )
    lines = _ros1(capsys, "list", "__ns:=/mira")[1].splitlines()
    assert lines[0] == "'left' - 'hardware_interface::EffortJointInterface' ( running )"
    assert _ros1(capsys, "kill", "left", *here) == (
        0, "Stopped ['left'] successfully\nUnloaded 'left' successfully\n")  # fmt: skip
    assert _ros1(capsys, "lt", *here) == (0, "test_controllers/Recorder\n")
    assert _ros1(capsys, "stop", "right", *here)[0] == 0
    assert _ros1(capsys, "unload", "left", *here) == (1, "Error when unloading 'left'\n")
    assert _ros1(capsys, "start", "x", *here) == (1, "Error when starting ['x'] and stopping []\n")


def test_controller_manager_reloads_and_restores(ros1, capsys):
    ros1.load("left")
    ros1.switch(start=["left"])
    code, text = _ros1(capsys, "reload-libraries", "--restore", "--namespace=/mira")
    assert (code, text.splitlines()) == (
        0,
        [
            "Restore: True",
            "Successfully reloaded libraries",
            "Controllers restored to original state",
        ],
    )
    assert ros1.controllers["left"].is_active


def test_controller_manager_knows_its_words(capsys):
    assert _ros1(capsys)[0] == 0
    code, text = _ros1(capsys, "--help")
    assert (code, text.startswith("Commands:\n    load <name>")) == (0, True)


def test_controller_manager_names_the_nearest_command(ros1, capsys):
    code, text = _ros1(capsys, "spwan", "left")
    assert code == 2
    assert "no command 'spwan'; did you mean 'spawn'" in text


def test_the_only_manager_is_used_and_named(ros1, capsys):
    ros1.load("left")
    code, text = _ros1(capsys, "list")
    assert code == 0
    assert "there is no /controller_manager; /mira/controller_manager, the only one there" in text
    assert "'left' - 'hardware_interface::EffortJointInterface' ( initialized )" in text


def test_a_manager_that_is_named_is_waited_for_and_said_once(ros1, capsys, monkeypatch, graph):
    monkeypatch.setattr(controller_manager_client, "_LATE_S", 0.0)
    node, stop = graph.create_node("asking"), threading.Event()
    client = controller_manager_client.ManagerClient(node, "/leg/controller_manager", stop)
    told = threading.Event()
    asking = threading.Thread(
        target=lambda: client.find(may_be_another=False, late=told.set), daemon=True
    )
    asking.start()
    assert told.wait(stretched())
    stop.wait(0.3)
    stop.set()
    asking.join(stretched())
    assert not asking.is_alive()
    line = "waiting for /leg/controller_manager; controller managers are: /mira/controller_manager"
    assert capsys.readouterr().err.splitlines() == [line]


def test_a_manager_is_given_ten_seconds_to_come(graph, run, monkeypatch):
    given = []

    def find(self, *, may_be_another, timeout_s):
        given.append(timeout_s)
        return False

    monkeypatch.setattr(controller_manager_client.ManagerClient, "find", find)
    code, text = run("list_controllers")
    assert code == 1
    assert text.startswith(
        "Could not contact service /controller_manager/list_controllers; there is no"
    )
    assert given == [10.0]


def test_without_a_manager_it_gives_up_and_says_what_is_missing(graph, run, monkeypatch):
    monkeypatch.setattr(control, "_PATIENCE_S", 0.2)
    code, text = run("list_controllers")
    assert code == 1
    assert "Could not contact service /controller_manager/list_controllers" in text
    assert "there is no controller manager at all" in text


def test_waiting_ends_with_the_graph(free_port, monkeypatch):
    monkeypatch.setattr(controller_manager_client, "_GONE_S", 0.1)
    hub = Graph.open(port=free_port, role="hub", environ={})
    with Graph.open(port=free_port, role="client", environ={}) as graph:
        client = controller_manager_client.ManagerClient(graph.create_node("asking"), "/cm")
        hub.close()
        with pytest.raises(GraphError, match="the graph has ended"):
            client.find(may_be_another=True)
        with pytest.raises(GraphError, match="the graph has ended"):
            client.wait()
