"""``ros2 bag``: recordings in rosbag2's formats; ``ros2 bag list`` is here."""

from __future__ import annotations

import argparse
import sys
import time
from importlib import import_module

from gazelle.cli.error_text import error_text
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError

__all__ = ["log_line", "main"]

_PLUGINS = {
    "storage": (),
    "compressor": ("zstd", "lz4"),
    "decompressor": ("zstd", "lz4"),
    "converter": ("cdr", "ros1"),
}
_WORDS = {"warning": "WARN", "warn": "WARN", "error": "ERROR"}
_VERBS = {
    "convert": ("gazelle.cli.ros2.bag.convert:convert", "Given an input bag, write out a new bag"),
    "info": ("gazelle.cli.ros2.bag.info:main", "Print information about a bag to the screen"),
    "list": ("gazelle.cli.ros2.bag:_list_plugins", "Print information about available plugins"),
    "play": ("gazelle.cli.ros2.bag.play:main", "Play back ROS data from a bag"),
    "record": ("gazelle.cli.ros2.bag.record:main", "Record ROS data to a bag"),
    "reindex": ("gazelle.cli.ros2.bag.convert:reindex", "Reconstruct metadata file for a bag"),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 bag``."""
    verb = argv[0] if argv else ""
    if verb in {"", "-h", "--help"}:
        print("usage: ros2 bag [-h] Call `ros2 bag <command> -h` for more detailed usage. ...")
        print("\nVarious rosbag related sub-commands\n\nCommands:")
        print("\n".join(f"  {name:<9} {text}" for name, (_, text) in _VERBS.items()))
        return 0
    if verb not in _VERBS:
        hint = did_you_mean(verb, _VERBS) or f"choose from {', '.join(map(repr, _VERBS))}"
        text = f"ros2 bag: error: argument Call `ros2 bag <command> -h`: invalid choice: '{verb}'"
        print(f"{text} ({hint})", file=sys.stderr)
        return 2
    try:
        module, _, function = _VERBS[verb][0].partition(":")
        return int(getattr(import_module(module), function)(argv[1:]))
    except GazelleError as error:
        sys.stdout.flush()
        print(f"[ERROR] [ros2bag]: {error_text(error)}", file=sys.stderr)
        return 1


def log_line(logger: str, level: str, text: str) -> None:
    """Write a line; warnings and errors to stderr."""
    now_ns = time.time_ns()
    word = _WORDS.get(level, "INFO")
    stream = sys.stdout if word == "INFO" else sys.stderr
    stamp = f"{now_ns // 1_000_000_000}.{now_ns % 1_000_000_000:09d}"
    print(f"[{word}] [{stamp}] [{logger}]: {text}", file=stream, flush=True)


def _list_plugins(argv: list[str]) -> int:
    """Print which formats can be written and read."""
    about = "Print information about available plugins to the screen"
    parser = argparse.ArgumentParser(prog="ros2 bag list", description=about)
    parser.add_argument("plugin_type", choices=_PLUGINS, help="what kind of plugin")
    options = parser.parse_args(argv)
    if options.plugin_type == "storage":
        return _list_storages()
    print("\n".join(_PLUGINS[options.plugin_type]))
    return 0


def _list_storages() -> int:
    from gazelle.bag.formats import folder_formats, problems_of_added
    from gazelle.diagnostics import Diagnostics, SourceSpan, render

    print("\n".join(one.name for one in folder_formats()))
    sys.stdout.flush()
    diagnostics = Diagnostics()
    for text in problems_of_added():
        diagnostics.report("bag.storage-not-loaded", text, SourceSpan(""))
    render(diagnostics)
    return 0
