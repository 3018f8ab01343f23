"""Shell functions that ``gazelle env`` prints: roscd and its kin, and completion."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence

__all__ = ["SHELLS", "shell_lines"]

SHELLS = ("sh", "bash", "zsh", "fish")

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


def shell_lines(shell: str, commands: Sequence[str]) -> str:
    """Return the text for a shell; ``sh``, ``bash`` and ``zsh`` take the same one.

    Args:
        shell: one of `SHELLS`.
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
