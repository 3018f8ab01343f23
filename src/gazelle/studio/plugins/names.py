"""Which kind of panel of the page a word means that somebody typed."""

from __future__ import annotations

import re

from gazelle.studio.plugins.panel_sources import all_sources
from gazelle.studio.plugins.rqt.plugin_xml import rqt_plugins
from gazelle.workspace import Workspace

__all__ = ["own_panel"]


def own_panel(words: str) -> str:
    """Return the kind that ``rqt -s WORDS`` means among the user's panels, empty for none.

    A panel comes before a plug-in of rqt of the same name: it is what became of it.

    Args:
        words: ``package.Class`` or ``Class`` of a panel; package, ``module.Class`` or
            ``package/module.Class`` of a plug-in of rqt.
    """
    workspace = Workspace.discover()
    for name, source in all_sources((), workspace).items():
        if words in (name, source.class_name):
            return f"plugin:{name}"
    for plugin in rqt_plugins(workspace):
        class_name = re.split(r"\.|::", plugin.type)[-1]
        if words in (plugin.name, plugin.type, plugin.package, class_name):
            return f"rqt-plugin:{plugin.name}"
    return ""
