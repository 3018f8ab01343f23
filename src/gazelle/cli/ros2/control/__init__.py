"""``ros2 control``: controllers and hardware of a controller manager."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.error_text import error_text
from gazelle.cli.ros2.verbs import add_verbs
from gazelle.cli.ros_tool import ToolError, join_graph
from gazelle.errors import GraphError
from gazelle.nodes.controller_manager.client import ManagerClient
from gazelle.ros_arguments import split_arguments

__all__ = ["main"]

_NAME = "Name of the controller"
_DIAGRAM = "controller_diagram.pdf"
_MANAGER = "controller_manager"
_PATIENCE_S = 10.0


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 control``."""
    from gazelle.cli.ros2.control import list_verbs, state_verbs, view_controller_chains

    parser = _parser()
    options = parser.parse_args(split_arguments(argv).own)
    if not options.verb:
        parser.print_help()
        return 0
    modules = (list_verbs, state_verbs, view_controller_chains)
    module = next(one for one in modules if options.verb in one.__all__)
    try:
        with join_graph() as graph:
            node = graph.create_node("ros2control", anonymous=True, rosout=False)
            client = ManagerClient(node, options.controller_manager)
            others = options.controller_manager == _MANAGER
            if not client.find(may_be_another=others, timeout_s=_PATIENCE_S):
                service = f"{client.name}/list_controllers"
                raise ToolError(
                    f"Could not contact service {service}; {client.other_managers_text()}"
                )
            _refuse_ros1(client)
            return int(getattr(module, options.verb)(client, options))
    except (ToolError, GraphError) as error:
        print(error_text(error), file=sys.stderr)
        return 1


def _refuse_ros1(client: ManagerClient) -> None:
    if client.ros_version == 1:
        raise ToolError(
            f"{client.name} is a controller manager of ROS 1; use: controller_manager list | load "
            "| start | stop …"
        )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ros2 control",
        description="Various control related sub-commands",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    rows = (
        ("cleanup_controller", "Cleanup a controller in a controller manager"),
        ("list_controller_types", "Output the available controller types and their base classes"),
        ("list_controllers", "Output the list of loaded controllers, their type and status"),
        ("list_hardware_components", "Output the list of available hardware components"),
        ("list_hardware_interfaces", "Output the list of available command and state interfaces"),
        ("load_controller", "Load a controller in a controller manager"),
        ("reload_controller_libraries", "Reload controller libraries"),
        ("set_controller_state", "Adjust the state of the controller"),
        ("set_hardware_component_state", "Adjust the state of the hardware component"),
        ("switch_controllers", "Switch controllers in a controller manager"),
        ("unload_controller", "Unload a controller in a controller manager"),
        ("view_controller_chains", "Generates a diagram of the loaded chained controllers"),
    )
    found = add_verbs(parser, dict(rows))
    _add_listing(found)
    _add_changing(found)
    for verb in found.values():
        verb.add_argument("-c", "--controller-manager", default=_MANAGER)
        verb.add_argument("--include-hidden-nodes", action="store_true", help=argparse.SUPPRESS)
        verb.add_argument("--spin-time", help=argparse.SUPPRESS)
        verb.add_argument("-s", "--use-sim-time", action="store_true", help=argparse.SUPPRESS)
    return parser


def _add_listing(found: dict[str, argparse.ArgumentParser]) -> None:
    verb = found["list_controllers"]
    for name in ("claimed", "required-state", "required-command", "chained", "exported"):
        verb.add_argument(f"--{name}-interfaces", action="store_true")
    found["view_controller_chains"].add_argument(
        "--save", action="store_true", help=f"save {_DIAGRAM} in the current directory"
    )
    for name in ("list_controllers", "list_hardware_components", "list_hardware_interfaces"):
        found[name].add_argument("-v", "--verbose", action="store_true")


def _add_changing(found: dict[str, argparse.ArgumentParser]) -> None:
    states = ["unconfigured", "inactive", "active"]
    verb = found["load_controller"]
    verb.add_argument("controller_name", help=_NAME)
    verb.add_argument("param_file", nargs="?", help="The YAML file with the parameters")
    # "start" and "configured" are Foxy's and Galactic's words.
    verb.add_argument("--set-state", choices=["inactive", "active", "configured", "start"])
    verb = found["set_controller_state"]
    verb.add_argument("controller_name", help=_NAME)
    verb.add_argument("state", choices=[*states, "configured", "start", "stop"])
    verb = found["set_hardware_component_state"]
    verb.add_argument("hardware_component_name")
    verb.add_argument("state", choices=states)
    for name in ("cleanup_controller", "unload_controller"):
        found[name].add_argument("controller_name", help=_NAME)
    found["reload_controller_libraries"].add_argument("--force-kill", action="store_true")
    verb = found["switch_controllers"]
    verb.add_argument("--deactivate", "--stop", nargs="*", default=[])
    verb.add_argument("--activate", "--start", nargs="*", default=[])
    verb.add_argument("--strict", action="store_true")
    verb.add_argument("--best-effort", action="store_true")
    verb.add_argument("--activate-asap", "--start-asap", action="store_true")
    verb.add_argument("--switch-timeout", type=float, default=5.0)
