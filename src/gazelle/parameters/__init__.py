"""Parameters of controllers, plug-ins and nodes: tables of them, and reading values by a table.

A table (`ParameterTable`) has a row (`Parameter`) for every name that the originals read, honoured
or refused with its reason. Readers (`gazelle.parameters.reader`) take their defaults from it, the
pages of the documentation are printed from it (`gazelle.parameters.markdown`), and a name that it
lacks is told.
"""

from __future__ import annotations

from gazelle.parameters.parameter import Parameter, ParameterKind, refused
from gazelle.parameters.table import ParameterTable
from gazelle.parameters.topic import Topic, TopicKind

__all__ = ["Parameter", "ParameterKind", "ParameterTable", "Topic", "TopicKind", "refused"]
