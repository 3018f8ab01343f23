"""``eval "$(gazelle env)"``: the ROS commands and modules in this shell.

Also roscd and its kin, and completion, as functions of the shell.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.commands import COMMANDS
from gazelle.launch.environment import ROS_COMMANDS, node_environment
from gazelle.workspace import Workspace

__all__ = [
    "main",
]

_SHELLS = ("sh", "bash", "zsh", "fish")
# What dash cannot read stands in eval, behind the question which shell this is.
_POSIX = """\
_gazelle_path() {
  _gazelle_found=$(rospack find "${2%%/*}") ||
    { echo "$1: No such package/stack '$2'" >&2; return 1; }
  case "$2" in */*) _gazelle_found="$_gazelle_found/${2#*/}" ;; esac
}
_gazelle_file() {
  _gazelle_path "$1" "$2" || return 1
  _gazelle_found=$(find "$_gazelle_found/" -name "$3" -type f | head -n 1)
  [ -n "$_gazelle_found" ] || { echo "$1: No file '$3' in package '$2'" >&2; return 1; }
}
roscd() {
  if [ $# -eq 0 ]; then cd "${ROS_WORKSPACE:-${ROS_PACKAGE_PATH%%:*}}"; return; fi
  _gazelle_path roscd "$1" && cd "$_gazelle_found"
}
rosls() {
  if [ $# -eq 0 ]; then ls "${ROS_WORKSPACE:-${ROS_PACKAGE_PATH%%:*}}"; return; fi
  _gazelle_path rosls "$1" && shift && ls "$@" "$_gazelle_found"
}
rosed() {
  [ $# -eq 2 ] || { echo "usage: rosed PACKAGE FILE" >&2; return 1; }
  _gazelle_file rosed "$1" "$2" && ${EDITOR:-vim} "$_gazelle_found"
}
roscp() {
  [ $# -eq 3 ] || { echo "usage: roscp PACKAGE FILE TARGET" >&2; return 1; }
  _gazelle_file roscp "$1" "$2" && cp "$_gazelle_found" "$3"
}
"""
_BASH = """\
_gazelle_complete() {
  local IFS=$'\\n'
  COMPREPLY=($(@GAZELLE@ complete "${COMP_WORDS[@]:0:COMP_CWORD+1}" 2>/dev/null))
  case "${COMPREPLY[0]}" in *:=) compopt -o nospace ;; esac
}
complete -o default -F _gazelle_complete @NAMES@
"""
_ZSH = """\
_gazelle_complete() {
  local -a found
  found=("${(@f)$(@GAZELLE@ complete "${(@)words[1,CURRENT]}" 2>/dev/null)}")
  if [[ -n "$found[1]" ]]; then compadd -a found; else _files; fi
}
(( $+functions[compdef] )) || { autoload -Uz compinit && compinit -i; }
compdef _gazelle_complete @NAMES@
"""
_FISH = """\
function _gazelle_path
  set -g _gazelle_found (rospack find (string split -m 1 / -- $argv[2])[1])
  or begin; echo "$argv[1]: No such package/stack '$argv[2]'" >&2; return 1; end
  set -l parts (string split -m 1 / -- $argv[2])
  if set -q parts[2]; set -g _gazelle_found $_gazelle_found/$parts[2]; end
end
function _gazelle_file
  _gazelle_path $argv[1] $argv[2]; or return 1
  set -g _gazelle_found (find $_gazelle_found/ -name $argv[3] -type f | head -n 1)
  test -n "$_gazelle_found"
  or begin; echo "$argv[1]: No file '$argv[3]' in package '$argv[2]'" >&2; return 1; end
end
function roscd; _gazelle_path roscd $argv[1]; and cd $_gazelle_found; end
function rosls; _gazelle_path rosls $argv[1]; and ls $argv[2..-1] $_gazelle_found; end
function rosed; _gazelle_file rosed $argv[1] $argv[2]; and $EDITOR $_gazelle_found; end
function roscp; _gazelle_file roscp $argv[1] $argv[2]; and cp $_gazelle_found $argv[3]; end
for name in @NAMES@
  complete -c $name -a '(@GAZELLE@ complete (commandline -opc) (commandline -ct) 2>/dev/null)'
end
"""
_FUNCTIONS = ("roscd", "rosls", "rosed", "roscp")
_ABOUT = """Prints shell lines that put the ROS-named commands on PATH and the drop-in modules
(rospy, tf, …) on PYTHONPATH, and define roscd, rosls, rosed, roscp and completion.
A real ROS keeps its own commands in other shells."""


def main(argv: list[str]) -> int:
    """Print the lines; of the variables, only what differs from the environment now."""
    parser = argparse.ArgumentParser(
        prog="gazelle env",
        usage='eval "$(gazelle env)"        (fish: gazelle env --shell fish | source)',
        description=_ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    own = Path(os.environ.get("SHELL", "")).name
    parser.add_argument(
        "--shell", choices=_SHELLS, default=own if own in _SHELLS else "sh", help="(yours: $SHELL)"
    )
    try:
        shell = parser.parse_args(argv).shell
    except SystemExit as stop:
        return int(stop.code or 0)
    environment = node_environment(os.environ, Workspace.discover())
    environment.pop("PYTHONUNBUFFERED", None)
    for name, value in sorted(environment.items()):
        if os.environ.get(name) != value:
            word = shlex.quote(value)
            print(f"set -gx {name} {word}" if shell == "fish" else f"export {name}={word}")
    print(_shell_lines(shell, [name for name in ROS_COMMANDS if name in COMMANDS]), end="")
    return 0


def _shell_lines(shell: str, commands: Sequence[str]) -> str:
    """Return the text for a shell; ``sh``, ``bash`` and ``zsh`` take the same one.

    Args:
        shell: one of `_SHELLS`.
        commands: names to complete.
    """
    gazelle = f"{shlex.quote(sys.executable)} -m gazelle.cli"
    names = " ".join([*commands, "gazelle", *_FUNCTIONS])

    def filled(text: str) -> str:
        return text.replace("@GAZELLE@", gazelle).replace("@NAMES@", names)

    if shell == "fish":
        return filled(_FISH)
    guarded = [
        f'if [ -n "${{{name}:-}}" ]; then eval {shlex.quote(filled(text))}; fi\n'
        for name, text in (("BASH_VERSION", _BASH), ("ZSH_VERSION", _ZSH))
    ]
    return _POSIX + "".join(guarded)
