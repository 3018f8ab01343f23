"""``ros2 bag list``."""

from __future__ import annotations

import argparse

__all__ = ["main"]

_PLUGINS = {
    "storage": ("mcap", "sqlite3"),
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
    print("\n".join(_PLUGINS[options.plugin_type]))
    return 0
