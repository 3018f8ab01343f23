from __future__ import annotations

import pytest

from gazelle.node_specs.registry import node_spec


@pytest.mark.parametrize("package", ["actionlib", "actionlib_tools"])
@pytest.mark.parametrize("name", ["axclient.py", "axserver.py"])
def test_windows_of_actionlib_are_told_not_missing(package: str, name: str) -> None:
    found = node_spec(package, name)
    assert found is not None
    assert found.entry == "gazelle.studio.windows.window_nodes:action_caller"
