"""``ros2 bag list``."""

from __future__ import annotations

import argparse
import sys

from gazelle.bag.formats import folder_formats, problems_of_added
from gazelle.diagnostics import Diagnostics, SourceSpan, render

__all__ = ["main"]

_PLUGINS = {
    "storage": (),
    "compressor": ("zstd", "lz4"),
    "decompressor": ("zstd", "lz4"),
    "converter": ("cdr", "ros1"),
}


def main(argv: list[str]) -> int:
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
    print("\n".join(one.name for one in folder_formats()))
    sys.stdout.flush()
    diagnostics = Diagnostics()
    for text in problems_of_added():
        diagnostics.report("bag.storage-not-loaded", text, SourceSpan(""))
    render(diagnostics)
    return 0
