"""Parameters of the node ``gazebo``, the simulator of a launch."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from gazelle.diagnostics import Diagnostics
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterOwner, ParameterReader, TreeSource
from gazelle.parameters.trees import nested
from gazelle.simulator.divergence_recovery import DIVERGENCE, OnDivergence

__all__ = ["CLOCK_RATE", "PARAMETERS", "ROS1_CLOCK_RATE", "read_server_parameters", "report_unread"]

CLOCK_RATE = "publish_rate"
ROS1_CLOCK_RATE = "pub_clock_frequency"

_ROS2 = 2
_ACTING = (
    ("time_step", "how long a step is", "s"),
    ("max_update_rate", "steps in a real second; 0 for as fast as possible", "Hz"),
    ("gravity_x", "gravity along x", "m/s²"),
    ("gravity_y", "gravity along y", "m/s²"),
    ("gravity_z", "gravity along z", "m/s²"),
)
_OF_ODE = (
    "auto_disable_bodies",
    "cfm",
    "contact_max_correcting_vel",
    "contact_surface_layer",
    "erp",
    "max_contacts",
    "sor_pgs_iters",
    "sor_pgs_precon_iters",
    "sor_pgs_rms_error_tol",
    "sor_pgs_w",
)

PARAMETERS = ParameterTable(
    "gazebo",
    "The simulator. Plug-ins have parameters of their own.",
    ("gazebo_ros/gzserver",),
    (
        Parameter(
            DIVERGENCE,
            "text",
            OnDivergence.PAUSE.value,
            "what becomes of a world that diverges: pause, or remove the model",
            live=True,
        ),
        Parameter(
            CLOCK_RATE,
            "number",
            None,
            "how often `/clock` is told; each step when absent",
            "Hz",
            low=0.0,
            ros_versions=(2,),
        ),
        Parameter(
            ROS1_CLOCK_RATE,
            "number",
            0.0,
            "how often `/clock` is told; 0 for each step",
            "Hz",
            low=0.0,
            ros_versions=(1,),
        ),
        *(
            Parameter(
                name,
                "number",
                None,
                f"{meaning}; the world's when absent",
                unit,
                live=True,
                ros_versions=(1,),
            )
            for name, meaning, unit in _ACTING
        ),
        *(
            Parameter(
                name,
                "any",
                None,
                "a word of ODE: kept and returned, MuJoCo does the physics",
                live=True,
                ros_versions=(1,),
            )
            for name in _OF_ODE
        ),
        *refused("topics and services are always offered", "enable_ros_network", unless=True),
    ),
)


class _Arguments(Protocol):
    @property
    def params(self) -> Mapping[str, Any]: ...
    @property
    def parameter_files(self) -> tuple[Path, ...]: ...


def read_server_parameters(
    arguments: _Arguments, node: Any, diagnostics: Diagnostics, *, ros_version: int
) -> ParameterReader:
    """Return typed access to the parameters of the simulator's node.

    The files are read again under the node's own name: launch files start ``gzserver``.

    Args:
        arguments: what the node was told when it started.
        node: on the graph; in ROS 1 the store has its parameters, also those of the command line.
        diagnostics: receives what is wrong.
        ros_version: 0 for none, or for both.
    """
    from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource

    name = node.name.rpartition("/")[2]
    source = FileSource(arguments.parameter_files, node.namespace, diagnostics, manager=name)
    stored: Mapping[str, Any] = {}
    if ros_version != _ROS2:
        for key, value in arguments.params.items():
            node.parameters.set(node.resolve_name(f"~{key}"), value)
        stored = node.parameters.get(node.name, {}) or {}
    values = nested({**stored, **source.manager_tree(), **arguments.params})
    tree = TreeSource(values, span=lambda key: source.span(name, key))
    owner = ParameterOwner(node.name, managed=frozenset({"use_sim_time", "qos_overrides"}))
    return ParameterReader(PARAMETERS, tree, owner, diagnostics, ros_version=ros_version)


def report_unread(own: ParameterReader) -> None:
    """Report what the simulator does not know, and what changes nothing.

    Branches are left out: a robot's controllers and plug-ins may have theirs there.
    """
    own.report_unknown(*(key for key, value in own.tree.items() if isinstance(value, Mapping)))
