"""``rosbag filter``."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import CodeType
from typing import Any

from gazelle.bag import (
    BagMessage,
    Connection,
    Encoding,
    bag_types,
    create_bag,
    open_bag,
    ros1_name_of,
    storage_of,
)
from gazelle.bag.conversion import copy_bag
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.cli.ros_tool import ToolError, option_parser
from gazelle.cli.rosbag.compress import ProgressMeter
from gazelle.diagnostics import Diagnostics, render
from gazelle.errors import GazelleError
from gazelle.interfaces import AnyMsg, Time, TypeStore, default_types, from_cdr, from_ros1

__all__ = ["run"]

_SAME_FILE = 3


def run(argv: list[str]) -> int:
    """Write the messages into another bag that a Python expression is true for."""
    usage = "filter [options] INBAG OUTBAG EXPRESSION"
    parser = option_parser("rosbag", usage)
    parser.set_description(
        "EXPRESSION can be any Python-legal expression of topic (name of topic), m (message) and "
        "t (time of message: t.secs, t.nsecs)."
    )
    add = parser.add_option
    add("-p", "--print", dest="shown", metavar="PRINT-EXPRESSION", help="expression to print")
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("You must specify an in bag, an out bag, and an expression.")
    if len(args) == 1:
        parser.error("You must specify an out bag and an expression.")
    if len(args) == 2:
        parser.error("You must specify an expression.")
    if len(args) > 3:
        parser.error("Too many arguments.")
    source_path, target_path, text = args
    if Path(source_path).resolve() == Path(target_path).resolve():
        print(f"Cannot use same file as input and output [{source_path}]", file=sys.stderr)
        return _SAME_FILE
    return _filter(source_path, target_path, _Filter(text, options.shown))


def _filter(source_path: str, target_path: str, wanted: _Filter) -> int:
    source = open_bag(source_path)
    wanted.types = bag_types(source.connections).store
    total = sum(pack.uncompressed for pack in source.summary.packs.values())
    target = create_bag(target_path, storage_of(target_path) or source.storage)
    meter, done, diagnostics = ProgressMeter(target_path, total), [0], Diagnostics()

    def step(message: BagMessage) -> None:
        done[0] += len(message.data)
        meter.step(min(done[0], total - 1))

    try:
        copy_bag(source, target, diagnostics=diagnostics, wanted=wanted, progress=step)
    finally:
        target.close()
    meter.finish()
    sys.stdout.flush()
    warn_of_unindexed(source)
    render(diagnostics)
    return 0


class _Filter:
    """Reads a message only where the expression speaks of it.

    Attributes:
        types: of the bag; set before messages come.
    """

    def __init__(self, text: str, shown: str | None) -> None:
        self.types = default_types()
        self._code = _compiled(text)
        self._shown = _compiled(shown) if shown else None
        self._text = text
        codes = (self._code, *([self._shown] if self._shown else []))
        self._reads = any("m" in code.co_names for code in codes)
        self._readers: dict[int, Callable[[bytes], Any]] = {}

    def __call__(self, message: BagMessage) -> bool:
        one = message.connection
        names = {"topic": one.topic, "t": Time(0, message.stamp_ns), "m": None}
        if self._reads:
            names["m"] = self._read(message)
        matches = bool(self._value(self._code, names))
        if self._shown is not None:
            print("MATCH" if matches else "NO MATCH", self._value(self._shown, names))
        return matches

    def _read(self, message: BagMessage) -> Any:
        one = message.connection
        if one.id not in self._readers:
            self._readers[one.id] = _reader(one, self.types)
        return self._readers[one.id](message.data)

    def _value(self, code: CodeType, names: dict[str, Any]) -> Any:
        try:
            # The user's own words on the user's own command line, as in the original.
            return eval(code, names)  # noqa: S307
        except Exception as error:  # noqa: BLE001 - an expression may raise anything
            kind = type(error).__name__
            raise ToolError(f"'{self._text}' on {names['topic']}: {kind}: {error}") from None


def _reader(one: Connection, types: TypeStore) -> Callable[[bytes], Any]:
    try:
        view = types.ros1_message_type(ros1_name_of(one))
    except GazelleError:
        return lambda _data: AnyMsg()
    if one.encoding is Encoding.ROS1:
        return lambda data: from_ros1(view, data)
    return lambda data: from_cdr(view, data)


def _compiled(text: str) -> CodeType:
    try:
        return compile(text, "expression", "eval")
    except SyntaxError as error:
        hint = "; write == to compare" if re.search(r"[^=!<>]=[^=]", text) else ""
        raise ToolError(f"'{text}' is not a Python expression: {error.msg}{hint}") from None
