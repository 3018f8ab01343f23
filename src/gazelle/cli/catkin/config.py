"""``catkin init`` and ``catkin config``."""

from __future__ import annotations

import argparse
from pathlib import Path

from gazelle.cli.catkin.profile import Profile, load_profile, make_workspace, save_profile

__all__ = ["run", "summary"]

_RULE = "-" * 62
_SPACES = ("source", "build", "devel", "install")


def run(words: list[str]) -> int:
    """Run the verb that the first word names."""
    parser = argparse.ArgumentParser(prog=f"catkin {words[0]}")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    if words[0] == "init":
        folder = parser.parse_args(words[1:]).workspace or Path.cwd()
        root = folder.absolute()
        made = make_workspace(root)
        what = "Initializing" if made else "already initialized:"
        print(f"{what} catkin workspace in `{root}`.")
        print(summary(load_profile(root)))
        return 0
    return _config(parser, words[1:])


def _config(parser: argparse.ArgumentParser, words: list[str]) -> int:
    installs = parser.add_mutually_exclusive_group()
    installs.add_argument("--install", action="store_true", default=None, dest="installs")
    installs.add_argument("--no-install", action="store_false", default=None, dest="installs")
    for name in _SPACES:
        parser.add_argument(f"--{name}-space", metavar="FOLDER")
    parser.add_argument("--init", action="store_true", help="make the workspace first")
    options = parser.parse_args(words)
    folder = options.workspace or Path.cwd()
    if options.init:
        make_workspace(folder.absolute())
    profile = load_profile(folder)
    values = dict(profile.values)
    if options.installs is not None:
        values["install"] = options.installs
    for name in _SPACES:
        given = getattr(options, f"{name}_space")
        if given is not None:
            values[f"{name}_space"] = given
    profile = Profile(profile.root, values)
    save_profile(profile)
    print(summary(profile))
    return 0


def summary(profile: Profile) -> str:
    """Return the table that catkin tools print before a build."""
    lines = [_RULE, "Profile:                     default"]
    lines += [f"Workspace:                   {profile.root}", _RULE]
    for label, path in zip(("Build", "Devel", "Install", "Source"), _in_table_order(profile),
                           strict=True):  # fmt: skip
        state = "exists" if path.is_dir() else "missing"
        if label == "Install" and not profile.installs:
            state = "unused"
        lines.append(f"{label + ' Space:':<20}[{state}]".ljust(30) + str(path))
    lines += [_RULE, f"Install Space Used:          {profile.installs}", _RULE]
    return "\n".join(lines)


def _in_table_order(profile: Profile) -> tuple[Path, Path, Path, Path]:
    spaces = profile.spaces
    return spaces.build, spaces.devel, spaces.install, spaces.source
