"""Shell text that setup files are made of; it works in sh, bash and zsh alike."""

from __future__ import annotations

import shlex
from collections.abc import Iterable

__all__ = ["FUNCTIONS", "HEADER", "forget", "own_prefix", "prepend", "source_file"]

HEADER = "# Written by Gazelle; it is written anew by every build.\n"

FUNCTIONS = """\
# Puts a value in front of a variable with colons; elsewhere in it the value is removed.
_gazelle_prepend() {
  eval "_gazelle_list=\\":\\${$1-}:\\""
  while :; do
    case "$_gazelle_list" in
      *":$2:"*) _gazelle_list="${_gazelle_list%%":$2:"*}:${_gazelle_list#*":$2:"}" ;;
      *) break ;;
    esac
  done
  _gazelle_list="${_gazelle_list#:}"
  _gazelle_list="${_gazelle_list%:}"
  if [ -n "$_gazelle_list" ]; then
    eval "export $1=\\"\\$2:\\$_gazelle_list\\""
  else
    eval "export $1=\\"\\$2\\""
  fi
  unset _gazelle_list
}
# The names that hooks written for colcon and ament call.
_colcon_prepend_unique_value() { _gazelle_prepend "$1" "$2"; }
ament_prepend_unique_value() { _gazelle_prepend "$1" "$2"; }
ament_append_value() { eval "export $1=\\"\\${$1:+\\${$1}:}\\$2\\""; }
"""
"""Definitions that package files and hooks use."""


def prepend(variable: str, prefix: str, value: str) -> str:
    """Return the line that puts a folder below a prefix in front of a variable.

    Args:
        variable: such as ``PYTHONPATH``.
        prefix: name of the shell variable with the prefix.
        value: path relative to it, empty for itself.
    """
    path = f"${prefix}/{value}" if value else f"${prefix}"
    return f'_gazelle_prepend {variable} "{path}"\n'


def own_prefix(variable: str, shell: str, built: str) -> str:
    """Return lines that set a variable to the folder of the file being sourced.

    A plain sh cannot tell where a sourced file lies: it takes what `variable` has already, else
    the folder it was built for.
    """
    if shell == "bash":
        return f'{variable}="$(builtin cd "$(dirname "${{BASH_SOURCE[0]}}")" > /dev/null && pwd)"\n'
    if shell == "zsh":
        return f'{variable}="$(builtin cd -q "$(dirname "${{(%):-%N}}")" > /dev/null && pwd)"\n'
    quoted = shlex.quote(built)
    return f"""\
if [ -z "${{{variable}-}}" ]; then
  {variable}={quoted}
fi
if [ ! -d "${variable}" ]; then
  echo "The build time path \\"${variable}\\" does not exist. Source setup.bash or setup.zsh," 1>&2
  echo "or set {variable} to the folder that holds this file." 1>&2
  unset {variable}
  return 1
fi
"""


def source_file(path: str) -> str:
    """Return lines that source a file when it is there; `path` stands in double quotes."""
    return f'if [ -f "{path}" ]; then\n  . "{path}"\nfi\n'


def forget(variables: Iterable[str]) -> str:
    """Return the line that unsets variables."""
    return f"unset {' '.join(variables)}\n"
