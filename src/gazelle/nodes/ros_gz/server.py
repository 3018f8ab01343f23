"""``ros_gz_sim/gzserver``: a world, named by parameters."""

from __future__ import annotations

import tempfile
import threading
from dataclasses import replace
from pathlib import Path

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.gzserver import run as run_server

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run the world of ``world_sdf_file`` or ``world_sdf_string`` until told to stop."""
    file = str(arguments.params.get("world_sdf_file") or "")
    text = str(arguments.params.get("world_sdf_string") or "")
    if file or not text:
        named = replace(arguments, rest=(file, "--gz") if file else ("--gz",))
        return run_server(named, graph, stop, falls_back=False)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.sdf"
        path.write_text(text, encoding="utf-8")
        return run_server(replace(arguments, rest=(str(path), "--gz")), graph, stop)
