"""Where the parameters of a launch are written: in its files, or in YAML that they load."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import reduce

from gazelle.diagnostics import Diagnostic, SourceSpan
from gazelle.documents.yaml import entries, read_yaml_file
from gazelle.graph.names import resolve
from gazelle.launch.config import LaunchConfig

__all__ = ["parameter_places", "placed"]

_NAME = re.compile(r"'(/[^'\s]+)'")


def parameter_places(config: LaunchConfig) -> dict[str, SourceSpan]:
    """Return where each parameter is set; the line of the YAML file where one is loaded."""
    places = dict(config.param_spans)
    for element, (file, target) in config.yaml_files.items():
        for name, span in _lines(file, target):
            if config.param_spans.get(name) == element:
                places[name] = replace(span, via=(element, *element.via))
    return places


def placed(item: Diagnostic, places: Mapping[str, SourceSpan]) -> Diagnostic:
    """Return a finding that names a parameter at the place where that is set."""
    if item.span is not None:
        return item
    named = (places[name] for name in _NAME.findall(item.message) if name in places)
    return replace(item, span=next(named, None))


def _lines(file: str, target: str) -> Iterator[tuple[str, SourceSpan]]:
    # Whoever loaded it has told why it cannot be read.
    root = read_yaml_file(file).root
    for path, key, *_ in entries(root) if root is not None else ():
        yield reduce(lambda above, name: resolve(name, above), path, target or "/"), key.span
