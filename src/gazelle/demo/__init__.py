"""Demos that come in the wheel: workspaces of our own packages, a command each."""

from gazelle.demo.demo import Demo, Panel, Step
from gazelle.demo.demos import DEMOS, find_demo
from gazelle.demo.workspaces import copy_demo, panel_params, picture, workspace_folder

__all__ = [
    "DEMOS",
    "Demo",
    "Panel",
    "Step",
    "copy_demo",
    "find_demo",
    "panel_params",
    "picture",
    "workspace_folder",
]
