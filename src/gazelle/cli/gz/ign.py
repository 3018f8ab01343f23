"""``ign``: the front of Ignition's commands; those about a world are in `gazelle.cli.gz.gz_sim`."""

from __future__ import annotations

from gazelle.cli.gz.gz_sim import which_gazebo
from gazelle.cli.gz.options import IGN_INSTEAD
from gazelle.cli.sdf.ign_sdf import run_sdf, usage, version_of
from gazelle.cli.sdf.sdf_file import say
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["main", "without_version"]

_FAILED = 255
# Only Gazebo Fortress and older call their command so.
_VERSION = version_of(Release.V12)
_OF_WORLD = {"gazebo": "sim", "model": "model", "service": "service", "topic": "topic"}
_HELP = """The 'ign' command provides a command line interface to the ignition tools.

  ign <command> [options]

List of available commands:

  help:          Print this help text.
  gazebo:        Run and manage the Gazebo Simulator.
  model:         Print information about models.
  sdf:           Utilities for SDF files.
  service:       Print information about services.
  topic:         Print information about topics.

Options:

  --force-version <VERSION>  Use a specific library version.
  --versions                 Show the available versions.
  --commands                 Show the available commands.
Use 'ign help <command>' to print help for a command."""


def main(argv: list[str]) -> int:
    """Run a command of ``ign``; the exit code is the original's, 255 for what it refuses."""
    tokens, version = without_version(argv)
    if version is not None and not _VERSION.startswith(version):
        print(f"Version error: I cannot find this command in version [{version}].")
        return _FAILED
    name = tokens[0] if tokens else ""
    if name == "help" and tokens[1:] == ["sdf"]:
        print(usage("ign"))
        return 0
    if name == "help" and len(tokens) == 2 and tokens[1] in _OF_WORLD:
        which_gazebo.explain(_OF_WORLD[tokens[1]])
        return 0
    if name in ("help", "--help", "-h"):
        print(_HELP)
        return 0
    if name == "--commands":
        print("\n".join(sorted([*_OF_WORLD, "sdf"])))
        return 0
    if name == "--versions" or (name == "sdf" and "--versions" in tokens):
        print(_VERSION)
        return 0
    if name == "sdf":
        return run_sdf(tokens[1:])
    if name in _OF_WORLD:
        return which_gazebo.run(_OF_WORLD[name], tokens[1:])
    if name in IGN_INSTEAD:
        say([f"gazelle: ign {name} is not here; use {IGN_INSTEAD[name]}"])
        return _FAILED
    print(_HELP)
    return _FAILED


def without_version(argv: list[str]) -> tuple[list[str], str | None]:
    """Return the words without ``--force-version V``, and V."""
    if "--force-version" not in argv:
        return argv, None
    index = argv.index("--force-version")
    version = argv[index + 1] if len(argv) > index + 1 else ""
    return [*argv[:index], *argv[index + 2 :]], version
