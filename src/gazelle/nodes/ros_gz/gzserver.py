"""``ros_gz_sim/gzserver``: a world, named by parameters."""

from __future__ import annotations

import tempfile
import threading
from dataclasses import replace
from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.names import join
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.gazebo_ros import run_gzserver
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "gzserver (ros_gz_sim)",
    "Runs a world of the new Gazebo.",
    ("ros_gz_sim/gzserver",),
    (
        Parameter("world_sdf_file", "text", "", "the world: a file, or its name"),
        Parameter("world_sdf_string", "text", "", "the world itself, where no file is given"),
        Parameter(
            "publish_rate", "any", None, "how often /clock is told; at every step else", "Hz"
        ),
        *refused("time begins at 0", "initial_sim_time", unless=0.0),
        *refused("how much is told is set by --log-level", "verbosity_level", unless=4),
    ),
)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run the world of ``world_sdf_file`` or ``world_sdf_string`` until told to stop."""
    found = Diagnostics()
    own = node_reader(
        PARAMETERS, arguments.params, join(arguments.namespace, arguments.name), found
    )
    file, text = own.text("world_sdf_file"), own.text("world_sdf_string")
    own.report_unknown()

    def serve(*argv: str, falls_back: bool) -> int:
        named = replace(arguments, rest=(*argv, "--gz"))
        return run_gzserver(named, graph, stop, falls_back=falls_back, found=found)

    if file or not text:
        return serve(*filter(None, (file,)), falls_back=False)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.sdf"
        path.write_text(text, encoding="utf-8")
        return serve(str(path), falls_back=True)
