"""Nodes of installed packages are found where built-in ones are."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from tests.installed_packages import code_of_page, installed

from gazelle.diagnostics import Diagnostics
from gazelle.extensions import ExtensionError
from gazelle.launch.node_commands import find_executable
from gazelle.node_specs.registry import builtin_executables, builtin_packages, node_spec
from gazelle.workspace import Workspace

_POINTS = {"gazelle.nodes": {"far_pkg/beat": "far_parts:BEAT", "far_pkg/odd": "far_parts:run"}}


def test_a_name_is_known_before_anything_is_imported(tmp_path: Path) -> None:
    with installed(tmp_path, "far_parts", code_of_page("A node"), _POINTS):
        assert "far_pkg" in builtin_packages()
        assert builtin_executables("far_pkg") == ("beat", "odd")
        assert "far_parts" not in sys.modules
        spec = node_spec("far_pkg", "beat")
        assert spec is not None
        assert spec.does == "says that it is alive"
    assert "far_pkg" not in builtin_packages()


def test_a_row_that_is_none_is_told_where_a_launch_names_it(tmp_path: Path) -> None:
    with installed(tmp_path, "far_parts", code_of_page("A node"), _POINTS):
        text = (
            r"'far_pkg/odd = far_parts:run' of far_parts 1.2 \(gazelle.nodes\) is a function, not"
        )
        with pytest.raises(ExtensionError, match=text):
            node_spec("far_pkg", "odd")
        told, workspace = Diagnostics(), Workspace.discover(environ={}, cwd=tmp_path)
        assert find_executable("far_pkg", "odd", workspace=workspace, diagnostics=told) is None
        (finding,) = told
        assert finding.code == "launch.executable-missing"
        assert "is a function, not a gazelle.node_specs.spec.NodeSpec" in finding.message
