"""urdfdom 3.0.1's view of a robot description: what ROS's own tools accept, refuse and print."""

from __future__ import annotations

from gazelle.description.urdfdom_emulation.check_urdf_output import (
    EndlessTreeError,
    graphviz_text,
    tree_text,
)
from gazelle.description.urdfdom_emulation.model import (
    Robot,
    Verdict,
    urdfdom_verdict,
    verdict_of_element,
)
from gazelle.description.urdfdom_emulation.tinyxml import element_of

__all__ = [
    "EndlessTreeError",
    "Robot",
    "Verdict",
    "element_of",
    "graphviz_text",
    "tree_text",
    "urdfdom_verdict",
    "verdict_of_element",
]
