"""ament_index_python.cli: the command ``ament_index``."""

from __future__ import annotations

import argparse
import sys

from gazelle.workspace.ament_index import get_resource, get_resource_types, get_resources

__all__ = ["main"]


def main(argv: list[str] | None = None) -> str | None:
    """Print kinds of entries, the entries of a kind, or one entry; returns what went wrong."""
    parser = argparse.ArgumentParser(description="Query the ament resource index.")
    parser.add_argument("resource_type", nargs="?", metavar="TYPE", help="a kind of entries")
    parser.add_argument("resource_name", nargs="?", metavar="NAME", help="an entry")
    options = parser.parse_args(sys.argv[1:] if argv is None else argv)
    if options.resource_type is None:
        _say("\n".join(sorted(get_resource_types())))
        return None
    if options.resource_name is None:
        for name, prefix in sorted(get_resources(options.resource_type).items()):
            _say(f"{name}\t{prefix}")
        return None
    try:
        content, prefix = get_resource(options.resource_type, options.resource_name)
    except (LookupError, OSError, ValueError) as error:
        return str(error)
    _say(prefix)
    if content:
        _say(f"<<<\n{content}\n>>>")
    return None


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")


if __name__ == "__main__":
    sys.exit(main())
