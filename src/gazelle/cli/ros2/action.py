"""``ros2 action``: actions of the graph, of ROS 2 and of actionlib, and goals to them."""

from __future__ import annotations

import argparse
import sys
import threading
from typing import Any

from gazelle.cli.error_text import error_text
from gazelle.cli.ros2.verbs import add_verbs
from gazelle.cli.ros_tool import ToolError
from gazelle.cli.text.fill_message import yaml_values
from gazelle.cli.text.ros2_text import message_yaml
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionClient, ActionInfo, ClientGoal, CommState
from gazelle.interfaces import action_type, fill

__all__ = ["main"]

_WAIT_S = 0.2
_CANCEL_S = 10.0


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 action``."""
    parser = _parser()
    options = parser.parse_args(argv)
    if not options.verb:
        parser.print_help()
        return 0
    try:
        with Graph.open(role="client") as graph:
            return int(_VERBS[options.verb](options, graph))
    except GazelleError as error:
        sys.stdout.flush()
        print(error_text(error), file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    about = "Various action related sub-commands"
    parser = argparse.ArgumentParser(
        prog="ros2 action",
        description=about,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    verbs = add_verbs(
        parser,
        {
            "find": "Find actions from type",
            "info": "Print information about an action",
            "list": "Output a list of action names",
            "send_goal": "Send an action goal",
            "type": "Print a action's type",
        },
    )
    find, info, listing, send, kind = (verbs[name] for name in sorted(verbs))
    for verb in (listing, info):
        verb.add_argument("-t", "--show-types", action="store_true", help="Show the types too")
    listing.add_argument("-c", "--count-actions", action="store_true", help="Show the number only")
    info.add_argument("-c", "--count", action="store_true", help="Show the numbers only")
    for verb in (info, kind, send):
        verb.add_argument("action_name", help="Name of the action, such as /fibonacci")
    for verb in (find, send):
        verb.add_argument("action_type", help="Type, such as example_interfaces/action/Fibonacci")
    send.add_argument("goal", nargs="?", default="{}", help="Goal in YAML, such as '{order: 10}'")
    send.add_argument("--stdin", action="store_true", help="Read the goal from standard input")
    send.add_argument("-f", "--feedback", action="store_true", help="Show feedback messages")
    return parser


def _list(options: argparse.Namespace, graph: Graph) -> int:
    actions = graph.actions()
    if options.count_actions:
        print(len(actions))
        return 0
    for one in actions:
        print(f"{one.name} [{one.type_name}]" if options.show_types else one.name)
    return 0


def _info(options: argparse.Namespace, graph: Graph) -> int:
    name = _global(options.action_name)
    found = [one for one in graph.actions() if one.name == name]
    one = found[0] if found else ActionInfo(name, "", 2, (), ())
    print(f"Action: {options.action_name}")
    for word, nodes in (("clients", one.clients), ("servers", one.servers)):
        print(f"Action {word}: {len(nodes)}")
        for node in nodes if not options.count else ():
            print(f"    {node} [{one.type_name}]" if options.show_types else f"    {node}")
    if not found:
        hint = did_you_mean(name, [item.name for item in graph.actions()])
        print(f"there is no action {name}; {hint}".rstrip("; "), file=sys.stderr)
    return 0


def _type(options: argparse.Namespace, graph: Graph) -> int:
    name = _global(options.action_name)
    actions = graph.actions()
    for one in actions:
        if one.name == name:
            print(one.type_name)
            return 0
    hint = did_you_mean(name, [item.name for item in actions])
    raise ToolError(f"there is no action {name}; {hint}".rstrip("; "))


def _find(options: argparse.Namespace, graph: Graph) -> int:
    for one in graph.actions():
        if one.type_name == options.action_type:
            print(one.name)
    return 0


def _send_goal(options: argparse.Namespace, graph: Graph) -> int:
    kind = action_type(options.action_type)
    goal = kind.Goal()
    text = sys.stdin.read() if options.stdin else options.goal
    values = yaml_values(text) if text.strip() else {}
    try:
        fill(goal, values)
    except GazelleError as error:
        raise ToolError(f"Failed to populate message fields: {error}") from error
    node = graph.create_node("ros2cli_send_goal", anonymous=True, rosout=False)
    client = ActionClient(node, options.action_name, kind)
    print("Waiting for an action server to become available...", flush=True)
    _wait_for_server(client, node)
    print(f"Sending goal:\n     {message_yaml(goal)}", flush=True)
    is_told = threading.Event()

    def show(feedback: Any) -> None:
        # Feedback may overtake the answer that the goal was accepted.
        is_told.wait()
        print(f"Feedback:\n    {message_yaml(feedback)}", flush=True)

    return _follow(client.send_goal(goal, on_feedback=show if options.feedback else None), is_told)


def _wait_for_server(client: ActionClient, node: Node) -> None:
    """Wait for ever, and say once what there is instead."""
    said = False
    while not client.wait_for_server(_WAIT_S):
        if node.closed or not node.graph.connected:
            raise ToolError("the graph is gone")
        if not said:
            said = True
            try:
                client.require_server()
            except GazelleError as error:
                print(str(error).partition("\n")[0], file=sys.stderr, flush=True)


def _follow(goal: ClientGoal, is_told: threading.Event) -> int:
    try:
        while not (goal.is_accepted or goal.wait(_WAIT_S / 10)):
            continue
        if not goal.is_accepted:
            print(goal.text if goal.text else "Goal was rejected.")
            return 0
        print(f"Goal accepted with ID: {goal.goal_id}\n", flush=True)
        is_told.set()
        while not goal.wait(_WAIT_S):
            continue
    except KeyboardInterrupt:
        if not goal.is_done and goal.comm_state is not CommState.DONE:
            print("Canceling goal...", flush=True)
            goal.cancel()
            if not goal.wait(_CANCEL_S):
                raise ToolError("Failed to cancel goal") from None
            print("Goal canceled.")
        return 0
    if goal.result is None:
        raise ToolError(f"Exception while getting result: {goal.text}")
    print(f"Result:\n    {message_yaml(goal.result)}")
    print(f"Goal finished with status: {goal.status.name}")
    return 0


def _global(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"


_VERBS = {"list": _list, "info": _info, "type": _type, "find": _find, "send_goal": _send_goal}
