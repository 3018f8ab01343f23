"""``libgazebo_ros2_control`` and gz-sim's ``gz_ros2_control``: the robot of ROS 2."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.description.model import Model
from gazelle.documents.files import exists
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.control_loop import (
    check_controllers,
    control_period,
    run_control_loop,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

if TYPE_CHECKING:
    from gazelle.control.hardware.gazebo_system import SystemOptions
    from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource

__all__ = ["GZ_TABLE", "TABLE", "load", "load_gz"]


_MSGS = "controller_manager_msgs"

_SERVICES = tuple(
    Topic(f"{{controller_manager_name}}/{verb}", f"{_MSGS}/{kind}", kind="service")
    for verb, kind in (
        ("configure_controller", "ConfigureController"),
        ("list_controllers", "ListControllers"),
        ("list_controller_types", "ListControllerTypes"),
        ("list_hardware_components", "ListHardwareComponents"),
        ("list_hardware_interfaces", "ListHardwareInterfaces"),
        ("load_controller", "LoadController"),
        ("reload_controller_libraries", "ReloadControllerLibraries"),
        ("switch_controller", "SwitchController"),
        ("unload_controller", "UnloadController"),
    )
)

_COMMON = (
    "Hardware comes from the `<ros2_control>` blocks of the model; `initial_value` of position and "
    "velocity states sets joints when the model is spawned.",
    "`mock_components/GenericSystem` mirrors commands into states, with its parameters, and moves "
    "nothing; Gazebo would not load it here.",
    "A class of other hardware is reported; nothing takes its place.",
    "Commands are kept within `min` and `max` of their `<command_interface>`, as ros2_control does "
    'since Jazzy, unless `<limits enable="false"/>`.',
    "Joints with a `<mimic>` follow in the physics. The parameters `mimic`, `multiplier` and "
    "`offset` of a block's joint make it follow where the description has no `<mimic>`.",
    "Of the joints' `<limit>` the effort acts, in the physics, and no effort drives a joint beyond "
    "the velocity; on other commands of ROS 2's simulated hardware velocity limits do not act, nor "
    "do `<transmission>` elements, as in Gazebo.",
    "IMU and force-torque sensors of the model are states by the sensor's name.",
    "A command that was never given (NaN) leaves the joint as it is: held.",
)

_HOLD = Parameter("hold_joints", "flag", True, "joints without a claimed command stand still")

_PARAMETERS = (
    Parameter("parameters", "text", "", "parameter file; may be repeated, later ones win"),
    Parameter("controller_manager_name", "text", "controller_manager", "node name of the manager"),
)

_DESCRIPTION = (
    Parameter(
        "robot_param",
        "text",
        "robot_description",
        "parameter whose `<ros2_control>` blocks count for a model without any, as from SDF",
    ),
    Parameter(
        "robot_param_node",
        "text",
        "robot_state_publisher",
        "node whose parameter it is; else it is searched upwards from the namespace",
    ),
)

_SIM_TYPE = "the class stands in the `<ros2_control>` block"

TABLE = PluginTable(
    ParameterTable(
        "ros2_control",
        "Simulated hardware and the controller manager of ROS 2 in Gazebo Classic.",
        ("gazebo_ros2_control",),
        (
            *_PARAMETERS,
            _HOLD,
            *_DESCRIPTION,
            Parameter("robot_sim_type", "refused", "", _SIM_TYPE, aliases=("robotSimType",)),
        ),
    ),
    services=_SERVICES,
    behaviour=(
        *_COMMON,
        "`position` puts the joint where it is told and `velocity` moves it so, whatever it takes; "
        "`effort` acts on the joint, at most its limit (`SetPosition`, `SetVelocity`, `SetForce`).",
        "With `pos_kp`, `pos_ki`, `pos_kd` or `vel_kp` … in the joint, or "
        "`pid_gains.position.<joint>.kp` … of the plug-in's node, PIDs make efforts of the errors, "
        "at every step.",
        "Of several claimed commands of a joint position counts, then velocity, then effort.",
    ),
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim ros2_control",
        "Simulated hardware and the controller manager of ROS 2 in gz-sim.",
        (
            "gz_ros2_control-system",
            "ign_ros2_control-system",
            "gz_ros2_control::GazeboSimROS2ControlPlugin",
            "ign_ros2_control::IgnitionROS2ControlPlugin",
        ),
        (
            *_PARAMETERS,
            _HOLD,
            Parameter(
                "position_proportional_gain",
                "number",
                0.1,
                "share of a position error that is made up for in one control period",
            ),
            *_DESCRIPTION,
        ),
    ),
    services=_SERVICES,
    behaviour=(
        *_COMMON,
        "Joints have motors with the joint's effort limit. `position` asks for the speed "
        "`position_proportional_gain` · error · update rate, `velocity` for its own; `effort` acts "
        "on the joint.",
        "Of several claimed commands of a joint velocity counts, then position, then effort.",
    ),
)

_UPDATE_RATE_HZ = 100

"""Default of the controller manager's ``update_rate``."""


def load(context: PluginContext) -> None:
    """Start the plug-in of Gazebo Classic."""
    _load(context, context.reader(TABLE), is_gz=False)


def load_gz(context: PluginContext) -> None:
    """Start the plug-in of gz-sim."""
    _load(context, context.reader(GZ_TABLE), is_gz=True)


def _load(context: PluginContext, parameters: PluginReader, *, is_gz: bool) -> None:
    from gazelle.control.controller_manager import ControllerManager
    from gazelle.control.hardware.ros2_robot import build_ros2_robot
    from gazelle.simulator.controller_node import make_ports, offer_manager
    from gazelle.simulator.plugins.control_loop import ModelSensors

    host, resources, engine = context.host, context.resources, context.host.engine
    namespace = context.namespace(parameters)
    name = parameters.text("controller_manager_name")
    source = _source(context, parameters, namespace, name)
    rate_hz = _rate(context, source)
    steps = control_period(context, round(1e9 / rate_hz), "update_rate")
    options = _options(parameters, is_gz=is_gz, rate_hz=1e9 / float(steps * engine.step_ns))
    gains = source.tree(context.plugin.name).get("pid_gains", {})
    robot = build_ros2_robot(
        host,
        _described(context, parameters, namespace),
        options,
        gains=gains if isinstance(gains, dict) else {},
        sensors=ModelSensors(host, context.model),
    )
    remappings = parameters.ros.remappings
    manager = ControllerManager(
        robot,
        namespace=namespace,
        make_ports=lambda one: make_ports(
            host, resources, namespace, one, 2, (*source.remappings(one), *remappings)
        ),
        source=source,
        diagnostics=host.diagnostics,
        update_rate_hz=options.update_rate_hz,
        workspace=host.workspace,
        clock=lambda: engine.time_ns,
    )
    offer_manager(manager, host, resources, name=name, remappings=remappings)
    run_control_loop(context, manager, steps)
    check_controllers(context, manager, steps)
    parameters.report_unread()


def _described(context: PluginContext, parameters: PluginReader, namespace: str) -> Model:
    """Return the model, with the blocks of the parameter store where it has none, as from SDF."""
    from gazelle.control.hardware.control_description import read_ros2_controls

    model, store = context.model, context.host.node.parameters
    name, node = parameters.text("robot_param"), parameters.text("robot_param_node")
    if model.ros2_controls:
        return model
    parts = [part for part in namespace.split("/") if part]
    spaces = [join_names("/", *parts[:count]) for count in range(len(parts), -1, -1)]
    places = [join_names(space, *own, name) for own in ((node,), ()) for space in spaces]
    names = {joint.name for joint in model.joints}
    for place in places:
        text = store.get(place, None)
        blocks = read_ros2_controls(text) if isinstance(text, str) and text.strip() else ()
        named = {part.attributes.get("name") for block in blocks for part in block.element.children}
        if not names.isdisjoint(named):
            return replace(model, ros2_controls=blocks)
    return model


def _options(parameters: PluginReader, *, is_gz: bool, rate_hz: float) -> SystemOptions:
    from gazelle.control.hardware.gazebo_system import SystemOptions

    gain = parameters.number("position_proportional_gain") if is_gz else 0.0
    return SystemOptions(is_gz, parameters.flag("hold_joints"), gain, rate_hz)


def _source(
    context: PluginContext, parameters: PluginReader, namespace: str, manager: str
) -> FileSource:
    from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource

    controls = context.host.controls
    named = (*parameters.texts("parameters"), *parameters.ros.parameter_files)
    found = {text.strip(): _resolved(context, text.strip()) for text in named}
    files = [
        path for text, path in found.items() if path is not None and _is_there(path, text, context)
    ]
    given = (*named, *map(str, controls.files), *controls.overrides)
    if not any(text.strip() for text in given):
        message = f"plug-in '{context.plugin.name}' names no <parameters> file: controllers have"
        message += " no types and no parameters (No parameter file provided. Configuration might"
        message += " be wrong)"
        context.report("control.no-parameter-file", message)
    source = FileSource(
        [*files, *controls.files],
        namespace,
        context.host.diagnostics,
        manager=manager,
        overrides=controls.overrides,
    )
    _report_strangers(context, source, join_names(namespace, manager))
    return source


def _is_there(path: Path, text: str, context: PluginContext) -> bool:
    """Tell whether there is such a file; one that is not is told where it is named."""
    if exists(path):
        return True
    message = f"parameter file '{path}' cannot be read: No such file or directory"
    context.report("control.parameter-file", message, about=text)
    return False


def _report_strangers(context: PluginContext, source: FileSource, manager: str) -> None:
    strangers = source.strangers()
    if strangers:
        name = manager.rpartition("/")[2]
        text = f"the parameter files are for {', '.join(strangers)}, and the controller manager is"
        text += f" {manager}: none of their parameters counts"
        fix = f"write '/**/{name}:' and '/**/controller:' in the files, or '/**:' around all"
        context.report("control.parameters-of-others", text, fix=fix)


def _resolved(context: PluginContext, text: str) -> Path | None:
    """Return the file that ``<parameters>`` means; addresses of packages work too."""
    if not text:
        return None
    workspace = context.host.workspace
    base = context.model.file.parent if context.model.file is not None else None
    if workspace is None:
        return Path(text)
    found = workspace.resolve(text, base_dir=base)
    return found.path or Path(text)


def _rate(context: PluginContext, source: FileSource) -> float:
    value: Any = source.manager_tree().get("update_rate", _UPDATE_RATE_HZ)
    if isinstance(value, int | float) and not isinstance(value, bool) and value > 0:
        return float(value)
    text = f"update_rate of the controller manager is {value!r}, not a number above 0;"
    text += f" {_UPDATE_RATE_HZ} Hz is used"
    place = source.span("controller_manager", "update_rate") or context.plugin.span
    context.host.diagnostics.report("parameter.bad-value", text, place)
    return float(_UPDATE_RATE_HZ)
