"""YAML: the one reader of users' texts, and the one writer.

A text becomes a `YamlDocument`: nodes with places, a value, or its problem. Length, nesting and
aliases are bounded, and nothing but plain values is made.
"""

from __future__ import annotations

from gazelle.documents.yaml.dialects import RCL, ROSPARAM, YAML_1_1, Dialect, PlacedMapping
from gazelle.documents.yaml.loader import MAX_CHARACTERS
from gazelle.documents.yaml.nodes import (
    YamlEntry,
    YamlMapping,
    YamlNode,
    YamlScalar,
    YamlSequence,
    duplicates,
    entries,
)
from gazelle.documents.yaml.problems import (
    ProblemKind,
    PyYamlError,
    YamlError,
    YamlProblem,
    problem_of,
)
from gazelle.documents.yaml.reader import (
    YamlDocument,
    load_yaml,
    load_yaml_documents,
    load_yaml_file,
    read_yaml,
    read_yaml_documents,
    read_yaml_file,
    value_of,
)
from gazelle.documents.yaml.writer import (
    MESSAGE_STYLE,
    PYTHON_STYLE,
    Layout,
    TaggedMapping,
    Writer,
    YamlStyle,
    dump_yaml,
)

__all__ = [
    "MAX_CHARACTERS",
    "MESSAGE_STYLE",
    "PYTHON_STYLE",
    "RCL",
    "ROSPARAM",
    "YAML_1_1",
    "Dialect",
    "Layout",
    "PlacedMapping",
    "ProblemKind",
    "PyYamlError",
    "TaggedMapping",
    "Writer",
    "YamlDocument",
    "YamlEntry",
    "YamlError",
    "YamlMapping",
    "YamlNode",
    "YamlProblem",
    "YamlScalar",
    "YamlSequence",
    "YamlStyle",
    "dump_yaml",
    "duplicates",
    "entries",
    "load_yaml",
    "load_yaml_documents",
    "load_yaml_file",
    "problem_of",
    "read_yaml",
    "read_yaml_documents",
    "read_yaml_file",
    "value_of",
]
