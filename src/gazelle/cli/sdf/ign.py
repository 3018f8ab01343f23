"""``ign``: the front of Ignition's commands, of which Gazelle has ``ign sdf``."""

from __future__ import annotations

from gazelle.cli.sdf.ign_sdf import USAGE, run_sdf
from gazelle.cli.sdf.other_commands import IGN_INSTEAD
from gazelle.cli.sdf.sdf_file import say

__all__ = ["main"]

_VERSION = "12.3.0"
_FAILED = 255
_HELP = """The 'ign' command provides a command line interface to the ignition tools.

  ign <command> [options]

List of available commands:

  help:          Print this help text.
  sdf:           Utilities for SDF files.

Options:

  --force-version <VERSION>  Use a specific library version.
  --versions                 Show the available versions.
  --commands                 Show the available commands.
Use 'ign help <command>' to print help for a command."""


def main(argv: list[str]) -> int:
    """Run a command of ``ign``; the exit code is the original's, 255 for what it refuses."""
    words, version = _without_version(argv)
    if version is not None and not _VERSION.startswith(version):
        print(f"Version error: I cannot find this command in version [{version}].")
        return _FAILED
    name = words[0] if words else ""
    if name == "help" and words[1:] == ["sdf"]:
        print(USAGE)
        return 0
    if name in ("help", "--help", "-h"):
        print(_HELP)
        return 0
    if name == "--commands":
        print("sdf")
        return 0
    if name == "--versions" or (name == "sdf" and "--versions" in words):
        print(_VERSION)
        return 0
    if name == "sdf":
        return run_sdf(words[1:])
    if name in IGN_INSTEAD:
        say([f"gazelle: ign {name} is not here; use {IGN_INSTEAD[name]}"])
        return _FAILED
    print(_HELP)
    return _FAILED


def _without_version(argv: list[str]) -> tuple[list[str], str | None]:
    """Return the words without ``--force-version V``, and V."""
    if "--force-version" not in argv:
        return argv, None
    index = argv.index("--force-version")
    version = argv[index + 1] if len(argv) > index + 1 else ""
    return [*argv[:index], *argv[index + 2 :]], version
