"""``CMakeLists.txt`` with its variables replaced, as far as that is known without configuring.

The texts that ``configure_file()`` makes of templates are known as far as the variables are.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import SourceSpan
from gazelle.documents import read_limited
from gazelle.documents.files import is_file, is_folder
from gazelle.workspace.building.cmake_syntax import Argument, Command, SyntaxProblem, read_commands

__all__ = ["CMakeLists", "Step", "read_cmake_lists"]

_MAX_BYTES = 4_000_000
_AT = re.compile(r"@([\w./+-]+)@")
_BOTH = re.compile(r"@([\w./+-]+)@|\$\{([\w./+-]+)\}")
_VARIABLE = re.compile(r"\$\{([\w./+-]+)\}|\$(ENV|CACHE)\{[^}]*\}")
_MAX_STEPS = 20_000
_MAX_FILES = 5_000
_MAX_DEPTH = 8
_MAX_BLOCK_DEPTH = 50
_MAX_ROUNDS = 20_000
_MAKE_PROGRAMS = (
    "add_executable",
    "ament_auto_add_executable",
    "cs_add_executable",
    "cuda_add_executable",
    "qt_add_executable",
    "rosbuild_add_executable",
)
_ENDS = {"foreach": "endforeach", "macro": "endmacro", "function": "endfunction"}
_CLOSED_BY = {closing: opening for opening, closing in _ENDS.items()} | {"endif": "if"}
_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})
# The build folder is not known, only what lies where below it.
_BINARY = "${CMAKE_BINARY_DIR}"


class Step(NamedTuple):
    """A command with the words it gets.

    Attributes:
        folder: of the file it stands in, relative to the package, empty for its own.
        is_conditional: it stands in an ``if``.
    """

    name: str
    arguments: tuple[str, ...]
    span: SourceSpan
    folder: str = ""
    is_conditional: bool = False

    def after(self, keyword: str, keywords: Iterable[str]) -> tuple[str, ...]:
        """Return the words after a keyword, up to the next one of `keywords`."""
        if keyword not in self.arguments:
            return ()
        rest = self.arguments[self.arguments.index(keyword) + 1 :]
        known = set(keywords)
        end = next((index for index, argument in enumerate(rest) if argument in known), len(rest))
        return rest[:end]


@dataclass(slots=True)
class CMakeLists:
    """What a package's ``CMakeLists.txt`` does.

    Attributes:
        file: its path.
        project: name given to ``project()``, empty when there is none.
        project_span: where.
        steps: its commands in order, those of included files and subfolders in their places.
        problem: where its syntax is wrong.
        hidden: commands that may do more than was read: own macros and files of elsewhere.
        compiling: calls of own macros that make executables or libraries.
        programs_of_own: names of the executables that those make.
        made: texts that ``configure_file()`` writes, by their places: relative to the package, or
            below ``${CMAKE_BINARY_DIR}``. Only those in which every variable is known.
    """

    file: Path
    project: str = ""
    project_span: SourceSpan | None = None
    steps: list[Step] = field(default_factory=list)
    problem: tuple[SyntaxProblem, SourceSpan] | None = None
    hidden: list[Step] = field(default_factory=list)
    compiling: list[Step] = field(default_factory=list)
    programs_of_own: list[str] = field(default_factory=list)
    made: dict[str, str] = field(default_factory=dict)

    def called(self, *names: str) -> tuple[Step, ...]:
        """Return the calls of these commands."""
        return tuple(step for step in self.steps if step.name in names)

    def executables(self) -> tuple[str, ...]:
        """Return the names of the programs that a compiler makes, variables replaced."""
        found = [step.arguments[0] for step in self.called(*_MAKE_PROGRAMS) if step.arguments]
        found += self.programs_of_own
        for step in self.called("rclcpp_components_register_node"):
            found += step.after("EXECUTABLE", ("PLUGIN", "EXECUTOR", "RESOURCE_INDEX"))
        for step in self.called("set_target_properties"):
            found += step.after("OUTPUT_NAME", ("PREFIX", "SUFFIX"))[:1]
        return tuple(found)


class _Piece(NamedTuple):
    """Some commands of a file, from one place up to another.

    Attributes:
        commands: all of the file.
        ends: see `_ends_of`.
        first, last: of the piece; `last` does not belong to it.
        known: branches of its ``if`` commands, as far as they were looked for.
    """

    commands: Sequence[Command]
    ends: Sequence[int]
    first: int
    last: int
    known: dict[tuple[int, int], tuple[_Piece, _Piece] | None]

    def body(self, opening: int) -> _Piece:
        """Return what stands in a block; one that is not closed goes on to the piece's end."""
        return self._replace(first=opening + 1, last=min(self.ends[opening], self.last))


class _Own(NamedTuple):
    """What a macro or function of the file does."""

    installs: bool
    compiles: bool
    parameters: tuple[str, ...] = ()
    programs: tuple[str, ...] = ()

    def programs_of(self, arguments: Sequence[str]) -> list[str]:
        """Return the names of programs that a call makes, with its arguments in their places."""
        values = dict(zip(self.parameters, arguments, strict=False))
        values |= {f"ARGV{index}": value for index, value in enumerate(arguments)}
        values["ARGN"] = ";".join(arguments[len(self.parameters) :])
        return [
            _VARIABLE.sub(lambda found: values.get(found[1] or "", found[0]), name)
            for name in self.programs
        ]


class _Walker:
    def __init__(
        self, folder: Path, lists: CMakeLists, name: str, definitions: Mapping[str, str]
    ) -> None:
        self.lists = lists
        self._root = folder
        self._name = name
        self._given = frozenset(definitions)
        self._variables = {**_known_variables(folder, name), **definitions}
        self._own: dict[str, _Own] = {}
        self._options: set[str] = set()
        # Set in a branch that may not be taken: what they hold afterwards is a guess.
        self._doubtful: set[str] = set()
        self._depth = 0
        self._blocks = 0
        self._rounds = 0
        self._ifs = 0

    def read(self, file: Path, folder: str) -> None:
        """Follow a file's commands."""
        if self._depth >= _MAX_DEPTH:
            return
        self._depth += 1
        commands, problem = read_commands(file.read_text(encoding="utf-8-sig", errors="replace"))
        if problem is not None and self.lists.problem is None:
            span = SourceSpan(str(file), problem.line, problem.column)
            self.lists.problem = (problem, span)
        here = self._variables.get("CMAKE_CURRENT_SOURCE_DIR", "")
        built = self._variables.get("CMAKE_CURRENT_BINARY_DIR", "")
        self._variables["CMAKE_CURRENT_SOURCE_DIR"] = str(self._root / folder)
        self._variables["CMAKE_CURRENT_BINARY_DIR"] = f"{_BINARY}/{folder}".rstrip("/")
        self._variables["CMAKE_CURRENT_LIST_DIR"] = str(file.parent)
        whole = _Piece(commands, _ends_of(commands), 0, len(commands), {})
        self._follow(whole, file, folder)
        self._variables["CMAKE_CURRENT_SOURCE_DIR"] = here
        self._variables["CMAKE_CURRENT_BINARY_DIR"] = built
        self._depth -= 1

    def _follow(self, piece: _Piece, file: Path, folder: str) -> None:
        """Follow commands, unless blocks are nested too deep or loops go on for too long."""
        self._rounds += 1
        if self._blocks >= _MAX_BLOCK_DEPTH or self._rounds > _MAX_ROUNDS:
            return
        self._blocks += 1
        self._follow_all(piece, file, folder)
        self._blocks -= 1

    def _follow_all(self, piece: _Piece, file: Path, folder: str) -> None:
        index = piece.first
        while index < piece.last and len(self.lists.steps) < _MAX_STEPS:
            command = piece.commands[index]
            if command.name in _ENDS:
                body = piece.body(index)
                self._block(command, body, file, folder)
                index = body.last + 1
                continue
            taken = self._is_taken(command)
            if taken is not None:
                body = piece.body(index)
                branches = _branches(body)
                if branches is not None:
                    self._follow(branches[0 if taken else 1], file, folder)
                    index = body.last + 1
                    continue
            self._command(command, file, folder)
            index += 1

    def _is_taken(self, command: Command) -> bool | None:
        """Decide an ``if`` that asks for an option of this file alone; None for all others."""
        arguments = [argument.text for argument in command.arguments]
        turned = arguments[:1] == ["NOT"]
        if (
            command.name != "if"
            or len(arguments) != 1 + turned
            or arguments[-1] not in self._options
        ):
            return None
        if arguments[-1] in self._doubtful:
            return None
        return (self._variables[arguments[-1]].upper() in _TRUE) is not turned

    def _block(self, command: Command, body: _Piece, file: Path, folder: str) -> None:
        arguments = self._arguments(command.arguments)
        if command.name != "foreach":
            if arguments:
                self._own[arguments[0].lower()] = _own_of(body, arguments[1:])
            return
        if not arguments:
            return
        for item in self._looped(arguments[1:]):
            self._variables[arguments[0]] = item
            self._follow(body, file, folder)

    def _looped(self, arguments: Sequence[str]) -> list[str]:
        if not arguments or arguments[0] not in {"IN", "RANGE"}:
            return list(arguments)
        found: list[str] = []
        is_list = False
        for argument in arguments[1:] if arguments[0] == "IN" else ():
            if argument in {"LISTS", "ITEMS"}:
                is_list = argument == "LISTS"
            elif is_list:
                found += filter(None, self._variables.get(argument, "").split(";"))
            else:
                found.append(argument)
        return found

    def _command(self, command: Command, file: Path, folder: str) -> None:
        span = SourceSpan(str(file), command.line, command.column, len(command.name))
        arguments = tuple(self._arguments(command.arguments))
        self._ifs += {"if": 1, "endif": -1}.get(command.name, 0)
        step = Step(command.name, arguments, span, folder, self._ifs > 0)
        self.lists.steps.append(step)
        handler = _HANDLERS.get(command.name)
        if handler is not None and arguments:
            handler(self, step)
        elif command.name in self._own:
            own = self._own[command.name]
            if own.installs:
                self.lists.hidden.append(step)
            if own.compiles:
                self.lists.compiling.append(step)
                programs = own.programs_of(arguments)
                self.lists.programs_of_own += [self._replaced(name) for name in programs]

    def _arguments(self, arguments: Iterable[Argument]) -> list[str]:
        found: list[str] = []
        for argument in arguments:
            text = self._replaced(argument.text)
            found += [text] if argument.quoted else filter(None, text.split(";"))
        return found

    def _replaced(self, text: str) -> str:
        for _ in range(2):  # once, and once more for ${${name}}
            new = _VARIABLE.sub(lambda found: self._variables.get(found[1] or "", found[0]), text)
            if new == text or len(new) > _MAX_STEPS:
                break
            text = new
        return text

    # -- commands that change what later ones mean ------------------------------------------

    def _project(self, step: Step) -> None:
        self.lists.project = self.lists.project or step.arguments[0]
        self.lists.project_span = self.lists.project_span or step.span
        for key in ("PROJECT_NAME", "CMAKE_PROJECT_NAME"):
            self._variables[key] = step.arguments[0]

    def _set(self, step: Step) -> None:
        if step.arguments[0] in self._given and "CACHE" in step.arguments:
            return
        values = step.after(step.arguments[0], ("CACHE", "PARENT_SCOPE"))
        self._assign(step.arguments[0], ";".join(values), step)

    def _assign(self, name: str, value: str, step: Step) -> None:
        self._variables[name] = value
        if step.is_conditional:
            self._doubtful.add(name)
        else:
            self._doubtful.discard(name)

    def _option(self, step: Step) -> None:
        name = step.arguments[0]
        self._options.add(name)
        if name not in self._variables:
            self._assign(name, step.arguments[2] if len(step.arguments) > 2 else "OFF", step)

    def _configure_file(self, step: Step) -> None:
        if len(step.arguments) < 2:
            return
        source, output = self._root / step.folder / step.arguments[0], step.arguments[1]
        if not output.startswith(("/", _BINARY)):
            output = f"{self._variables['CMAKE_CURRENT_BINARY_DIR']}/{output}"
        if output.startswith(f"{self._root}/"):
            output = output[len(f"{self._root}/") :]
        elif not output.startswith(_BINARY):
            return
        known = {
            name: value
            for name, value in self._variables.items()
            if name not in self._doubtful and "${" not in value
        }
        text = _configured_text(source, known, frozenset(step.arguments[2:]))
        if text is not None:
            self.lists.made[output] = text

    def _list(self, step: Step) -> None:
        if step.arguments[0] in {"APPEND", "PREPEND"} and len(step.arguments) > 1:
            name = step.arguments[1]
            parts = [self._variables.get(name, ""), *step.arguments[2:]]
            self._variables[name] = ";".join(part for part in parts if part)
            if step.is_conditional:
                self._doubtful.add(name)

    def _file(self, step: Step) -> None:
        if not step.arguments[0].startswith("GLOB") or len(step.arguments) < 2:
            return
        rest = [argument for argument in step.arguments[2:] if argument != "CONFIGURE_DEPENDS"]
        base = self._root / step.folder
        relative: Path | None = None
        if rest and rest[0] == "RELATIVE":
            relative, rest = Path(rest[1]) if len(rest) > 1 else base, rest[2:]
        found: list[str] = []
        for pattern in rest:
            for path in _globbed(base, pattern, recursive=step.arguments[0] == "GLOB_RECURSE"):
                is_below = relative is not None and path.is_relative_to(relative)
                found.append(
                    str(path.relative_to(relative)) if is_below and relative else str(path)
                )
        self._variables[step.arguments[1]] = ";".join(sorted(found))

    def _subdirectory(self, step: Step) -> None:
        folder = str(Path(step.folder) / step.arguments[0])
        file = self._root / folder / "CMakeLists.txt"
        if is_file(file):
            self.read(file, folder)

    def _include(self, step: Step) -> None:
        path = self._root / step.folder / step.arguments[0]
        if is_file(path):
            self.read(path, step.folder)
        elif "/" in step.arguments[0] or step.arguments[0].endswith(".cmake"):
            self.lists.hidden.append(step)


_HANDLERS: dict[str, Callable[[_Walker, Step], None]] = {
    "project": _Walker._project,
    "set": _Walker._set,
    "option": _Walker._option,
    "configure_file": _Walker._configure_file,
    "list": _Walker._list,
    "file": _Walker._file,
    "add_subdirectory": _Walker._subdirectory,
    "include": _Walker._include,
}


def _configured_text(
    template: Path, variables: Mapping[str, str], options: frozenset[str]
) -> str | None:
    """Return what a template becomes; None when that is known only to CMake.

    Args:
        template: the ``.in`` file.
        variables: those whose values are known where the call stands.
        options: the call's words after its two files, such as ``@ONLY``.
    """
    try:
        text = read_limited(template, _MAX_BYTES).decode("utf-8")
    except (OSError, UnicodeDecodeError):
        return None
    if "COPYONLY" in options:
        return text
    if "#cmakedefine" in text:  # a header for a compiler
        return None
    pattern = _AT if "@ONLY" in options else _BOTH
    names = {next(filter(None, found.groups())) for found in pattern.finditer(text)}
    # CMake takes a variable without a value as empty. Here it may be one that find_package() or
    # the compiler's tests would have set.
    if not names <= variables.keys():
        return None

    def value(found: re.Match[str]) -> str:
        text = variables[next(filter(None, found.groups()))]
        return text.replace('"', '\\"') if "ESCAPE_QUOTES" in options else text

    return pattern.sub(value, text)


def read_cmake_lists(
    folder: Path, name: str, definitions: Mapping[str, str] | None = None
) -> CMakeLists | None:
    """Read a package's ``CMakeLists.txt``; None when it has none.

    Args:
        folder: of the package.
        name: of the package, for catkin's variables.
        definitions: variables given on the command line (``-D``); a ``set(… CACHE …)`` of the
            file leaves them as they are.
    """
    file = folder / "CMakeLists.txt"
    if not file.is_file():
        return None
    walker = _Walker(folder, CMakeLists(file), name, definitions or {})
    walker.read(file, "")
    return walker.lists


def _known_variables(folder: Path, name: str) -> dict[str, str]:
    """Return what catkin, GNUInstallDirs and CMake itself set; catkin's are relative to prefix."""
    root = str(folder)
    return {
        "PROJECT_NAME": name,
        "PROJECT_SOURCE_DIR": root,
        "CMAKE_SOURCE_DIR": root,
        "CMAKE_CURRENT_SOURCE_DIR": root,
        "PROJECT_BINARY_DIR": _BINARY,
        "CMAKE_CURRENT_BINARY_DIR": _BINARY,
        "CMAKE_INSTALL_PREFIX": "",
        "CMAKE_INSTALL_BINDIR": "bin",
        "CMAKE_INSTALL_DATADIR": "share",
        "CMAKE_INSTALL_DATAROOTDIR": "share",
        "CMAKE_INSTALL_INCLUDEDIR": "include",
        "CMAKE_INSTALL_LIBDIR": "lib",
        "CATKIN_GLOBAL_BIN_DESTINATION": "bin",
        "CATKIN_GLOBAL_LIB_DESTINATION": "lib",
        "CATKIN_GLOBAL_SHARE_DESTINATION": "share",
        "CATKIN_PACKAGE_BIN_DESTINATION": f"lib/{name}",
        "CATKIN_PACKAGE_ETC_DESTINATION": f"etc/{name}",
        "CATKIN_PACKAGE_INCLUDE_DESTINATION": f"include/{name}",
        "CATKIN_PACKAGE_LIB_DESTINATION": "lib",
        "CATKIN_PACKAGE_PYTHON_DESTINATION": f"lib/python3/dist-packages/{name}",
        "CATKIN_PACKAGE_SHARE_DESTINATION": f"share/{name}",
    }


def _ends_of(commands: Sequence[Command]) -> list[int]:
    """Return for each command that opens a block the place of the one that closes it.

    Only its own kind counts, so a block that is not closed goes on to the file's end.
    """
    ends = [len(commands)] * len(commands)
    opened: dict[str, list[int]] = {name: [] for name in _CLOSED_BY.values()}
    for index, command in enumerate(commands):
        if command.name in opened:
            opened[command.name].append(index)
        elif (opening := _CLOSED_BY.get(command.name)) is not None and opened[opening]:
            ends[opened[opening].pop()] = index
    return ends


def _own_of(body: _Piece, parameters: Sequence[str]) -> _Own:
    commands = body.commands[body.first : body.last]
    compiles = any(item.name in {"add_executable", "add_library"} for item in commands)
    programs = [item for item in commands if item.name in _MAKE_PROGRAMS and item.arguments]
    names = tuple(item.arguments[0].text for item in programs)
    return _Own(_installs(commands), compiles, tuple(parameters), names)


def _branches(body: _Piece) -> tuple[_Piece, _Piece] | None:
    """Return what an ``if`` runs when true and when not; None with an ``elseif`` between."""
    # In a loop it is asked for again and again.
    key = body.first, body.last
    if key not in body.known:
        body.known[key] = _found_branches(body)
    return body.known[key]


def _found_branches(body: _Piece) -> tuple[_Piece, _Piece] | None:
    depth = 0
    for index in range(body.first, body.last):
        name = body.commands[index].name
        depth += {"if": 1, "endif": -1}.get(name, 0)
        if depth == 0 and name == "elseif":
            return None
        if depth == 0 and name == "else":
            return body._replace(last=index), body._replace(first=index + 1)
    return body, body._replace(first=body.last)


def _installs(body: Iterable[Command]) -> bool:
    """Tell whether commands install something besides what a compiler makes."""
    return any(
        command.name == "catkin_install_python"
        or (command.name == "install" and not _is_of_targets(command))
        for command in body
    )


def _is_of_targets(command: Command) -> bool:
    return bool(command.arguments) and command.arguments[0].text == "TARGETS"


def _globbed(base: Path, pattern: str, *, recursive: bool) -> list[Path]:
    folder, _, name = (str(base / pattern)).rpartition("/")
    if "*" in folder or "${" in folder:
        return []
    search = Path(folder).rglob if recursive else Path(folder).glob
    return list(islice(search(name or "*"), _MAX_FILES)) if is_folder(Path(folder)) else []
