"""The files of an install space that a shell sources, with colcon's names and layout.

Their text works in sh, bash and zsh alike.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath

from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import EnvironmentHook, Layout, Plan

__all__ = [
    "FUNCTIONS",
    "HEADER",
    "add_package_scripts",
    "forget",
    "own_prefix",
    "prepend",
    "source_file",
    "underlays",
    "write_prefix_scripts",
]

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
_PREFIX = "COLCON_CURRENT_PREFIX"
_INDEX = "share/colcon-core/packages"
_SHELLS = ("sh", "bash", "zsh")
_SAVED = "_gazelle_install"


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


def add_package_scripts(package: SourcePackage, layout: Layout, plan: Plan) -> None:
    """Plan ``share/<package>/package.*``, its hooks and colcon's index entry.

    Args:
        package: whose they are.
        layout: where its modules go.
        plan: everything else it installs; read for what the hooks have to name.
    """
    share = f"share/{package.name}"
    names = []
    for hook in _hooks_for(package, layout, plan):
        base = f"{share}/hook/{hook.name}"
        plan.write(f"{base}.dsv", f"prepend-non-duplicate;{hook.variable};{hook.value}\n")
        plan.write(f"{base}.sh", HEADER + prepend(hook.variable, _PREFIX, hook.value))
        names += [f"{base}.dsv", f"{base}.sh"]
    names += plan.scripts
    plan.write(f"{share}/package.dsv", "".join(f"source;{name}\n" for name in names))
    plan.write(f"{share}/package.sh", _package_sh(layout, names, plan))
    for shell in ("bash", "zsh"):
        own = [name for name in plan.scripts if name.endswith(f".{shell}")]
        plan.write(f"{share}/package.{shell}", _package_shell(shell, share, scripts=own))
    if package.build_type != "ament_python":
        for shell in _SHELLS:
            text = _package_shell(shell, share, built=str(layout.prefix / share), to=shell)
            plan.write(f"{share}/local_setup.{shell}", text)
    plan.write(f"{_INDEX}/{package.name}", ":".join(sorted(package.depends("run"))))


def write_prefix_scripts(
    install_base: Path, *, merged: bool, environ: Mapping[str, str]
) -> tuple[str, ...]:
    """Write ``setup.*`` and ``local_setup.*`` of an install space for all packages in it.

    Args:
        install_base: the install space.
        merged: all packages share one prefix.
        environ: environment variables; workspaces that are sourced in it are sourced first.

    Returns:
        The names of the packages, in the order they are sourced.
    """
    names = _installed(install_base, merged=merged)
    chain = "".join(source_file(f"{_quoted(path)}/local_setup.sh") for path in environ_chain(
        install_base, environ))  # fmt: skip
    for shell in _SHELLS:
        own = own_prefix(_PREFIX, shell, str(install_base))
        head = f'{own}{_SAVED}="${_PREFIX}"\n'
        body = _sourcing(names, shell, merged=merged)
        end = forget([_PREFIX, _SAVED])
        (install_base / f"local_setup.{shell}").write_text(
            HEADER + head + FUNCTIONS + body + end, encoding="utf-8"
        )
        below = f'{own}_gazelle_setup="${_PREFIX}"\nunset {_PREFIX}\n'
        after = f'{_PREFIX}="$_gazelle_setup"\n. "${_PREFIX}/local_setup.{shell}"\n'
        (install_base / f"setup.{shell}").write_text(
            HEADER + below + chain + after + forget(["_gazelle_setup"]), encoding="utf-8"
        )
    return names


def environ_chain(install_base: Path, environ: Mapping[str, str]) -> tuple[Path, ...]:
    """Return sourced workspaces that a new one is built on, lowest first."""
    return underlays(environ, ("COLCON_PREFIX_PATH", "AMENT_PREFIX_PATH"), install_base)


def underlays(environ: Mapping[str, str], variables: Sequence[str], own: Path) -> tuple[Path, ...]:
    """Return prefixes with a ``local_setup.sh`` that variables name, lowest first.

    Args:
        environ: environment variables.
        variables: names of variables with paths.
        own: the prefix that is being built; it and what lies in it are left out.
    """
    found: dict[Path, None] = {}
    for variable in variables:
        for part in filter(None, environ.get(variable, "").split(os.pathsep)):
            path = Path(part)
            inside = any(path == one or one in path.parents for one in (own, *found))
            if not inside and (path / "local_setup.sh").is_file():
                found.setdefault(path)
    return tuple(reversed(found))


def _hooks_for(package: SourcePackage, layout: Layout, plan: Plan) -> list[EnvironmentHook]:
    hooks = []
    if plan.has_below(layout.python):
        hooks.append(EnvironmentHook("pythonpath", "PYTHONPATH", layout.python))
    if plan.has_below("bin"):
        hooks.append(EnvironmentHook("path", "PATH", "bin"))
    if package.build_type != "ament_python":
        hooks.append(EnvironmentHook("cmake_prefix_path", "CMAKE_PREFIX_PATH", ""))
    if package.build_type == "catkin":
        hooks.append(EnvironmentHook("ros_package_path", "ROS_PACKAGE_PATH", "share"))
    else:
        hooks.append(EnvironmentHook("ament_prefix_path", "AMENT_PREFIX_PATH", ""))
    return hooks


def _package_sh(layout: Layout, names: Sequence[str], plan: Plan) -> str:
    lines = [HEADER, "# Extends the environment for this package.\n", FUNCTIONS]
    lines.append(own_prefix(_PREFIX, "sh", str(layout.prefix)))
    lines.append(f'AMENT_CURRENT_PREFIX="${_PREFIX}"\nCATKIN_ENV_HOOK_WORKSPACE="${_PREFIX}"\n')
    for name in names:
        if name.endswith(".sh"):
            lines.append(source_file(f"${_PREFIX}/{name}"))
        elif name.endswith(".dsv") and f"{name.removesuffix('.dsv')}.sh" not in names:
            lines += _dsv_lines(plan.items[name].text)
    lines.append(forget(["AMENT_CURRENT_PREFIX", "CATKIN_ENV_HOOK_WORKSPACE", _PREFIX]))
    return "".join(lines)


def _dsv_lines(text: str) -> list[str]:
    """Return shell lines for the rows of a ``.dsv`` file: ``type;VARIABLE;value``."""
    lines = []
    for row in text.splitlines():
        kind, _, rest = row.partition(";")
        variable, _, value = rest.partition(";")
        if not variable.isidentifier():
            continue
        path = value if value.startswith("/") else f"${_PREFIX}/{value}".rstrip("/")
        if kind in {"prepend-non-duplicate", "prepend-non-duplicate-if-exists"}:
            lines.append(f'_gazelle_prepend {variable} "{path}"\n')
        elif kind == "set":
            lines.append(f'export {variable}="{value}"\n')
        elif kind == "set-if-unset":
            lines.append(f'export {variable}="${{{variable}:-{value}}}"\n')
    return lines


def _sourcing(names: Sequence[str], shell: str, *, merged: bool) -> str:
    lines = ["# Extends the environment with the packages of this folder.\n"]
    for name in names:
        where = "" if merged else f"/{name}"
        lines.append(f'{_PREFIX}="${_SAVED}{where}"\n')
        lines.append(source_file(f"${_PREFIX}/share/{name}/package.{shell}"))
    return "".join([*lines, f'_gazelle_prepend COLCON_PREFIX_PATH "${_SAVED}"\n'])


def _package_shell(
    shell: str, share: str, *, built: str = "", to: str = "sh", scripts: Sequence[str] = ()
) -> str:
    """Return a file that finds its prefix, two folders up, and sources ``package.sh``.

    Args:
        shell: for which the file is.
        share: the package's share folder, relative to the prefix.
        built: where the file was built for; a plain sh needs it.
        to: ending of the package file that is sourced.
        scripts: hooks of this shell alone, relative to the prefix.
    """
    own = own_prefix("_gazelle_share", shell, built)
    up = "/".join(".." for _ in PurePosixPath(share).parts)
    find = f'{_PREFIX}="$(cd "$_gazelle_share/{up}" > /dev/null && pwd)"\n'
    lines = [HEADER, own, find, f'. "$_gazelle_share/package.{to}"\n']
    for script in scripts:
        lines += [find, f'AMENT_CURRENT_PREFIX="${_PREFIX}"\n', source_file(f"${_PREFIX}/{script}")]
    return "".join([*lines, forget(["_gazelle_share", "AMENT_CURRENT_PREFIX", _PREFIX])])


def _installed(install_base: Path, *, merged: bool) -> tuple[str, ...]:
    """Return the packages of an install space, each after those it needs at run time."""
    pattern = f"{_INDEX}/*" if merged else f"*/{_INDEX}/*"
    needs = {
        file.name: set(filter(None, file.read_text(encoding="utf-8").split(":")))
        for file in sorted(install_base.glob(pattern))
        if merged or file.name == file.relative_to(install_base).parts[0]
    }
    ordered: list[str] = []
    waiting = sorted(needs)
    while waiting:
        free = [name for name in waiting if not needs[name] & set(waiting) - {name}]
        # Packages that need each other are sourced by name.
        for name in free or waiting:
            ordered.append(name)
        waiting = [name for name in waiting if name not in ordered]
    return tuple(ordered)


def _quoted(path: Path) -> str:
    """Return a path as it stands between double quotes in a shell."""
    text = str(path)
    for sign in ("\\", '"', "$", "`"):
        text = text.replace(sign, "\\" + sign)
    return text
