from __future__ import annotations

import pytest

from gazelle.nodes.registry import builtin_node


@pytest.mark.parametrize("package", ["actionlib", "actionlib_tools"])
@pytest.mark.parametrize("name", ["axclient.py", "axserver.py"])
def test_windows_of_actionlib_are_told_not_missing(package: str, name: str) -> None:
    found = builtin_node(package, name)
    assert found is not None
    assert found.target == "gazelle.studio.views.plain:action_caller"
