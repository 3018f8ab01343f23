"""What roslaunch elements may have, what is in force where they stand, and how they are read."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.documents import scaled
from gazelle.documents.files import is_folder
from gazelle.documents.yaml import ROSPARAM, load_yaml
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.ros1.substitution_args import Substitution, SubstitutionError, directory_of
from gazelle.workspace import Workspace

__all__ = [
    "ELEMENTS",
    "PARAM_TYPES",
    "Element",
    "Reading",
    "Scope",
    "TagError",
    "bool_value",
    "param_value",
]

_NODE_OPTIONS = ("args", "machine", "ns", "clear_params", "cwd", "launch-prefix")


class Element(NamedTuple):
    """Attributes of an element; ``if`` and ``unless`` go with every one."""

    required: tuple[str, ...]
    optional: tuple[str, ...] = ()

    @property
    def attributes(self) -> tuple[str, ...]:
        """All attributes the element may have."""
        return (*self.required, *self.optional, "if", "unless")


ELEMENTS: dict[str, Element] = {
    "arg": Element(("name",), ("default", "value", "doc")),
    "env": Element(("name", "value")),
    "group": Element((), ("ns", "clear_params")),
    "include": Element(("file",), ("ns", "clear_params", "pass_all_args")),
    "machine": Element(
        ("name", "address"),
        ("env-loader", "ssh-port", "user", "password", "default", "timeout"),
    ),
    "node": Element(
        ("pkg", "type", "name"),
        (*_NODE_OPTIONS, "respawn", "respawn_delay", "required", "output"),
    ),
    "param": Element(("name",), ("value", "type", "textfile", "binfile", "command")),
    "remap": Element(("from", "to")),
    "rosparam": Element((), ("command", "file", "param", "ns", "subst_value")),
    "test": Element(("test-name", "pkg", "type"), ("name", *_NODE_OPTIONS, "time-limit", "retry")),
}  # fmt: skip
PARAM_TYPES = ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml")
_MAX_INCLUDES = 2000


@dataclass(slots=True)
class Scope:
    """The state of one element's children; `child` copies it, so nothing leaks upwards.

    Attributes:
        file: the file being read.
        namespace: absolute, ends with ``/``.
        args: arguments declared so far; None for one without value.
        given: arguments passed to this file and not yet declared.
        fixed: arguments declared with a fixed value.
        remaps: pairs (from, to), later ones win.
        remap_spans: their places, in the same order.
        env: environment for the nodes that follow.
        private_params: ``~name`` parameters for the nodes that follow.
        stack: places of the includes that led here, outermost first.
        given_at: where the include passes each argument.
        pass_all: the include passed all its arguments, so unknown ones are fine.
        in_node: this is the inside of a ``<node>``: names are private to it.
    """

    file: str
    namespace: str = "/"
    args: dict[str, str | None] = field(default_factory=dict)
    given: dict[str, str] = field(default_factory=dict)
    fixed: set[str] = field(default_factory=set)
    remaps: tuple[tuple[str, str], ...] = ()
    remap_spans: tuple[SourceSpan, ...] = ()
    env: dict[str, str] = field(default_factory=dict)
    private_params: dict[str, Any] = field(default_factory=dict)
    stack: tuple[SourceSpan, ...] = ()
    given_at: dict[str, SourceSpan] = field(default_factory=dict)
    pass_all: bool = False
    in_node: bool = False

    def child(self, namespace: str = "") -> Scope:
        """Return a copy for a ``<group>`` or ``<node>``, one namespace deeper."""
        return replace(
            self,
            namespace=self.join(namespace),
            args=dict(self.args),
            fixed=set(self.fixed),
            env=dict(self.env),
            private_params=dict(self.private_params),
        )

    def included(
        self, file: str, namespace: str, given: dict[str, str], place: SourceSpan
    ) -> Scope:
        """Return the scope of an included file: it sees only the arguments given."""
        inner = self.child(namespace)
        return replace(
            inner, file=file, args={}, given=dict(given), fixed=set(), stack=(*self.stack, place)
        )

    def join(self, namespace: str) -> str:
        """Return a namespace resolved in this one, ending with ``/``."""
        if not namespace:
            return self.namespace
        joined = namespace if namespace.startswith("/") else self.namespace + namespace
        return joined.rstrip("/") + "/"

    def add_remap(self, source: str, target: str, span: SourceSpan) -> None:
        """Add a remap; one for the same name is replaced."""
        rows = zip(self.remaps, self.remap_spans, strict=True)
        kept = [(pair, place) for pair, place in rows if pair[0] != source]
        self.remaps = (*(pair for pair, _ in kept), (source, target))
        self.remap_spans = (*(place for _, place in kept), span)


class TagError(Exception):
    """An element cannot be used; carries what its diagnostic says."""

    def __init__(
        self,
        code: str,
        message: str,
        span: SourceSpan | None = None,
        fix: str = "",
        phrase: str = "",
    ) -> None:
        self.code = code
        self.phrase = phrase
        self.span = span
        self.fix = fix
        super().__init__(message)


@dataclass(slots=True)
class Reading:
    """One run over launch files.

    Attributes:
        config: what has been read so far.
        environ: environment of the launch, before any ``<env>``.
        anonymous: names given by ``$(anon …)``.
        includes: how many files have been included so far.
    """

    config: LaunchConfig
    workspace: Workspace
    diagnostics: Diagnostics
    environ: dict[str, str]
    anonymous: dict[str, str] = field(default_factory=dict)
    includes: int = 0

    def count_include(self) -> None:
        """Note that a file is about to be included.

        Raises:
            TagError: files that include others twice and more make too many of it.
        """
        self.includes += 1
        if self.includes > (most := scaled(_MAX_INCLUDES)):
            raise TagError("limits.expansion", f"more than {most} files are included")

    def substitution(self, scope: Scope) -> Substitution:
        """Return the evaluator for a place."""
        directory = directory_of(scope.file)
        return Substitution(self.workspace, scope.args, directory, self.environ, self.anonymous)

    def substitute(self, text: str, tag: Tag, scope: Scope) -> str:
        """Return a text with every ``$(…)`` replaced.

        Raises:
            TagError: one of them has no value.
        """
        try:
            return self.substitution(scope).apply(text)
        except SubstitutionError as error:
            file = f"included file [{scope.file}]" if scope.stack else f"[{scope.file}]"
            phrase = error.phrase.replace("requires", f"{file} requires", 1)
            raise TagError(error.code, str(error), tag.span, error.fix, phrase) from error

    def text(self, tag: Tag, name: str, scope: Scope, default: str = "") -> str:
        """Return a substituted attribute, `default` when it is absent."""
        value = tag.attributes.get(name)
        return default if value is None else self.substitute(value, tag, scope)

    def required(self, tag: Tag, name: str, scope: Scope) -> str:
        """Return a substituted attribute that must be there and not empty.

        Raises:
            TagError: it is absent or empty.
        """
        value = self.text(tag, name, scope)
        if not value:
            message = f"<{tag.name}> tag is missing required attribute '{name}'"
            near = nearest_names(name, tag.attributes, count=1)
            fix = f"did you mean '{name}' for '{near[0]}'?" if near and name != near[0] else ""
            raise TagError("xml.missing-attribute", message, tag.span, fix)
        return value

    def flag(self, tag: Tag, name: str, scope: Scope, default: bool = False) -> bool:
        """Return a truth value attribute.

        Raises:
            TagError: the value is none of true, 1, false, 0.
        """
        if name not in tag.attributes:
            return default
        value = self.text(tag, name, scope)
        try:
            return bool_value(value)
        except ValueError as error:
            message = f"<{tag.name} {name}>: {error}; write true or false"
            raise TagError("launch.bad-attribute", message, tag.span) from error

    def number(self, tag: Tag, name: str, scope: Scope, default: float) -> float:
        """Return a number attribute.

        Raises:
            TagError: the value is not a number.
        """
        if name not in tag.attributes:
            return default
        value = self.text(tag, name, scope)
        try:
            return float(value)
        except ValueError as error:
            message = f"<{tag.name} {name}>: '{value}' is not a number"
            raise TagError("launch.bad-attribute", message, tag.span) from error

    def positive(self, tag: Tag, name: str, scope: Scope, default: float) -> float:
        """Return a number attribute that must be above zero where it is written.

        Raises:
            TagError: it is no number, or not above zero.
        """
        value = self.number(tag, name, scope, default)
        if name in tag.attributes and not value > 0.0:
            message = f"<{tag.name} {name}>: '{name}' must be a positive number, found {value:g}"
            raise TagError(
                "launch.bad-attribute", message, tag.span, f"remove {name}= for the default"
            )
        return value

    def namespace(self, tag: Tag, scope: Scope) -> str:
        """Return ``ns``, empty where it is not written.

        Raises:
            TagError: it is written and empty.
        """
        value = self.text(tag, "ns", scope)
        if not value and "ns" in tag.attributes:
            message = f"<{tag.name}> tag has an empty 'ns' attribute"
            raise TagError("launch.bad-attribute", message, tag.span, "remove ns=, or write a name")
        return value

    def choice(self, tag: Tag, name: str, scope: Scope, choices: tuple[str, ...]) -> str:
        """Return an attribute that has to be one of a few words; the first is the default.

        Raises:
            TagError: it is none of them.
        """
        value = self.text(tag, name, scope) or choices[0]
        by_folded = {word.casefold(): word for word in choices}
        if value.casefold() not in by_folded:
            message = f"<{tag.name} {name}>: '{value}' is none of {', '.join(choices)}"
            raise TagError("launch.bad-attribute", message, tag.span, did_you_mean(value, choices))
        return by_folded[value.casefold()]

    def condition(self, tag: Tag, scope: Scope) -> bool:
        """Return whether ``if`` and ``unless`` let the element through.

        Raises:
            TagError: both are there, or one has no truth value.
        """
        if "if" in tag.attributes and "unless" in tag.attributes:
            message = "cannot set both 'if' and 'unless' on the same tag"
            raise TagError("launch.if-and-unless", message, tag.span)
        if "if" in tag.attributes:
            return self.flag(tag, "if", scope)
        return not self.flag(tag, "unless", scope)

    def check_attributes(self, tag: Tag, scope: Scope) -> None:
        """Report attributes that the element does not know."""
        known = ELEMENTS[tag.name].attributes
        for name in tag.attributes:
            if name not in known:
                what = f"attribute '{name}' of <{tag.name}>"
                self.unknown("xml.unknown-attribute", what, name, known, tag, scope)

    def unknown(
        self, code: str, what: str, name: str, known: Iterable[str], tag: Tag, scope: Scope
    ) -> None:
        """Report something that has no effect, with the nearest known name."""
        hint = did_you_mean(name, known)
        message = f"{what} is not known to roslaunch; it has no effect"
        self.diagnostics.report(code, message, self.located(tag.span, scope), fix=hint)

    def clear_params(self, tag: Tag, scope: Scope, *, needs_namespace: bool = False) -> None:
        """Note ``clear_params="true"`` for the namespace of `scope`.

        Raises:
            TagError: the element needs a namespace of its own for that, and has none.
        """
        if self.flag(tag, "clear_params", scope):
            if needs_namespace and "ns" not in tag.attributes:
                message = f"<{tag.name}>: 'ns' attribute must be set in order to use 'clear_params'"
                fix = 'add ns="…": without one every parameter would be cleared'
                raise TagError("launch.bad-attribute", message, tag.span, fix)
            self.config.clear_params.append(scope.namespace)

    def located(self, span: SourceSpan, scope: Scope) -> SourceSpan:
        """Return the span with the includes that led to it."""
        return replace(span, via=tuple(reversed(scope.stack)))

    def missing_file(self, path: Path) -> tuple[str, None, str]:
        """Return message, no place and fix for an included file that is not there."""
        message = f"[Errno 2] No such file or directory: '{path}'"
        if not is_folder(path.parent):
            return f"{message}; the folder does not exist either", None, ""
        here = sorted(item.name for item in path.parent.iterdir() if item.suffix == path.suffix)
        return (
            f"{message}; the folder has: {', '.join(here) or 'no such files'}",
            None,
            did_you_mean(path.name, here),
        )


def param_value(text: str, type_name: str) -> Any:
    """Return the typed value of a ``<param>``.

    ``auto`` tries int, float (only with a dot: ``1e-3`` stays a string, as in roslaunch), bool.

    Raises:
        ValueError: the text does not fit the type, or the type is unknown.
        YamlError: it is no YAML, for the type ``yaml``.
    """
    if type_name == "auto":
        return _auto_value(text)
    if type_name in {"str", "string"}:
        return text
    if type_name == "int":
        return int(text)
    if type_name == "double":
        return float(text)
    if type_name in {"bool", "boolean"}:
        return bool_value(text)
    if type_name == "yaml":
        return load_yaml(text, ROSPARAM)
    raise ValueError(f"type '{type_name}' is unknown; known are {', '.join(PARAM_TYPES)}")


def bool_value(text: str) -> bool:
    """Return roslaunch's truth value: true, 1, false or 0.

    Raises:
        ValueError: it is none of these.
    """
    lowered = text.lower().strip()
    if lowered in {"true", "1"}:
        return True
    if lowered in {"false", "0"}:
        return False
    raise ValueError(f"{text} is not a 'bool' type")


def _auto_value(text: str) -> Any:
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        lowered = text.lower()
        return lowered == "true" if lowered in {"true", "false"} else text
