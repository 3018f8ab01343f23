"""``ros2 interface proto``."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.interface.names import checked_name
from gazelle.cli.text.ros2_text import message_yaml
from gazelle.interfaces import action_type, message_type, service_type

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``proto`` takes."""
    text = "Show an interface definition (e.g. 'example_interfaces/msg/String')"
    parser.add_argument("type", help=text)
    text = "if true output has no outer quotes."
    parser.add_argument("--no-quotes", action="store_true", help=text)


def run(options: argparse.Namespace) -> int:
    """Print what ``pub``, ``call`` or ``send_goal`` may be given, with the fields' defaults."""
    part = checked_name(options.type)[1]
    if part == "msg":
        message = message_type(options.type)()
    elif part == "srv":
        message = service_type(options.type).Request()
    else:
        message = action_type(options.type).Goal()
    text = message_yaml(message)
    print(text if options.no_quotes else f'"{text}"')
    return 0
