"""``libgazebo_ros_control``: hardware and controller manager of ROS 1."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.compiled_controllers import compiled_controllers
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.control_loop import (
    check_controllers,
    control_period,
    run_control_loop,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

if TYPE_CHECKING:
    from gazelle.control.controller_manager import ControllerManager
    from gazelle.control.hardware.control_description import ControlDescription
    from gazelle.control.hardware.default_robot_hw_sim import DefaultRobotHWSim
    from gazelle.control.resource_manager import Robot

__all__ = ["DEFAULT_ROBOT_SIM", "OF_2011", "TABLE", "load"]


OF_2011 = "gazebo_ros_controller_manager"

"""The library of the PR2's time."""

DEFAULT_ROBOT_SIM = "gazebo_ros_control/DefaultRobotHWSim"

_MSGS = "controller_manager_msgs"

TABLE = PluginTable(
    ParameterTable(
        "ros_control",
        "Simulated hardware and the controller manager of ROS 1. Joints come from the "
        "`<transmission>` elements; controllers and their parameters are on the controllers page.",
        ("gazebo_ros_control", OF_2011),
        (
            Parameter(
                "robotNamespace",
                "text",
                "",
                "namespace of manager, controllers and parameters; the model's name when absent",
            ),
            Parameter(
                "controlPeriod", "number", 0.0, "control period; a physics step when absent", "s"
            ),
            Parameter("robotParam", "text", "robot_description", "parameter with the URDF"),
            Parameter(
                "robotSimType",
                "text",
                DEFAULT_ROBOT_SIM,
                "class of the hardware; others are compiled code, and the default is used instead",
            ),
            Parameter(
                "eStopTopic",
                "text",
                "",
                "emergency stop: while true, no effort, no speed, positions stay; on release the "
                "controllers restart",
            ),
            Parameter(
                "legacyModeNS",
                "flag",
                False,
                "true reads PID gains from `/gazebo_ros_control/pid_gains`, without the"
                " namespace, as "
                "Kinetic and Melodic do; when absent both places are looked at",
            ),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
            Parameter("updateRate", "refused", "", "the control period is `controlPeriod`"),
            Parameter("interface:audio", "refused", "", "a placeholder that Gazebo of 2011 needed"),
        ),
    ),
    topics=(Topic("{eStopTopic}", "std_msgs/msg/Bool", kind="listens"),),
    services=tuple(
        Topic(f"controller_manager/{verb}", f"{_MSGS}/{kind}", kind="service")
        for verb, kind in (
            ("list_controllers", "ListControllers"),
            ("list_controller_types", "ListControllerTypes"),
            ("load_controller", "LoadController"),
            ("reload_controller_libraries", "ReloadControllerLibraries"),
            ("switch_controller", "SwitchController"),
            ("unload_controller", "UnloadController"),
        )
    ),
    behaviour=(
        "The description is read from the parameter `robotParam`, searched upwards from "
        "`robotNamespace`; without that parameter the model's own is used (Gazebo would wait for "
        "it for ever).",
        "Joints are driven directly: mechanical reductions of transmissions do not act "
        "(`DefaultRobotHWSim`). Transmissions of several joints, which Gazebo leaves out, drive "
        "each of their joints.",
        "`EffortJointInterface`: the effort acts on the joint, at most its limit, from controller "
        "to controller until the next command; where a position or velocity limit is passed, none "
        "acts further outwards (`EffortJointSaturationHandle`).",
        "`PositionJointInterface`: the joint is put to the commanded position whatever it takes, "
        "at most as fast as its velocity limit; with gains in "
        "`<namespace>/gazebo_ros_control/pid_gains/<joint>` a PID makes an effort of the error.",
        "`VelocityJointInterface`: a motor with the joint's effort limit; with gains a PID makes "
        "an effort of the error. An effort limit of 0 stops it, as in Gazebo.",
        "PIDs run at every step on the states of the last control period.",
        "`<safety_controller>` and `joint_limits/<joint>` parameters act as in "
        "joint_limits_interface. Limits count per physics step.",
        "Joints that a configured controller names hold where they were spawned until a controller "
        "claims them; of continuous joints those that a controller of positions or trajectories "
        "names. Gazebo lets them fall.",
        "Stopped controllers leave their last command behind, as in Gazebo.",
        "IMUs and force-torque sensors of the model are there for controllers; DefaultRobotHWSim "
        "has none.",
        "A joint that is not in the model is reported and left out; Gazebo would start nothing.",
        "`gazebo_ros_controller_manager` of 2011 (PR2) means the same; its namespace is the root.",
    ),
)


def load(context: PluginContext) -> None:
    """Make the robot and its controller manager; controllers are loaded later, by spawners."""
    parameters = context.reader(TABLE)
    manager = _make(context, parameters)
    _offer_gains(context, manager, _gains_namespace(context, parameters, manager.namespace))
    _listen_for_stop(context, parameters, manager)
    parameters.report_unread()


def _make(context: PluginContext, parameters: PluginReader) -> ControllerManager:
    from gazelle.control.controller_manager import ControllerManager
    from gazelle.simulator.controller_node import make_ports, offer_manager

    host, resources = context.host, context.resources
    namespace = _namespace(context, parameters)
    robot = _robot(context, parameters, namespace)
    steps = _period(context, parameters)
    engine = host.engine
    manager = ControllerManager(
        robot,
        namespace=namespace,
        make_ports=lambda name: make_ports(host, resources, namespace, name, 1),
        source=_source(context, namespace),
        diagnostics=host.diagnostics,
        update_rate_hz=1e9 / float(steps * engine.step_ns),
        workspace=host.workspace,
        clock=lambda: engine.time_ns,
        find_compiled=compiled_controllers(
            context, lambda: _description_text(context, parameters, namespace)
        ),
    )
    offer_manager(manager, host, resources)
    run_control_loop(context, manager, steps)
    check_controllers(context, manager, steps)
    return manager


def _namespace(context: PluginContext, parameters: PluginReader) -> str:
    """Return the robot's namespace.

    Without any word on it Gazebo takes the model's name; in 2011, on the PR2, it was the root.
    """
    is_old = OF_2011 in context.plugin.filename
    fallback = context.default_namespace or ("/" if is_old else context.model.name)
    return join_names("/", parameters.text("robotNamespace", fallback))


def _robot(context: PluginContext, parameters: PluginReader, namespace: str) -> Robot:
    from gazelle.control.hardware.ros1_robot import RobotParameters, build_ros1_robot
    from gazelle.simulator.plugins.control_loop import ModelSensors

    plugin = parameters.text("robotSimType")
    if plugin != DEFAULT_ROBOT_SIM:
        text = f"<robotSimType> '{plugin}' is compiled code that Gazelle does not have;"
        text += f" '{DEFAULT_ROBOT_SIM}' is used: one command interface a joint"
        context.report("control.robot-sim-type", text)
    return build_ros1_robot(
        context.host,
        context.model,
        _source(context, namespace),
        RobotParameters(
            context.host.node.parameters,
            namespace,
            _gains_namespace(context, parameters, namespace),
        ),
        description=_description(context, parameters, namespace),
        sensors=ModelSensors(context.host, context.model),
        plugin=plugin,
    )


def _gains_namespace(context: PluginContext, parameters: PluginReader, namespace: str) -> str:
    """Return where the gains lie: in Kinetic and Melodic they are outside the namespace."""
    from gazelle.control.hardware.ros1_joint_setup import GAINS_NAME

    if parameters.has("legacyModeNS"):
        return "" if parameters.flag("legacyModeNS") else namespace
    store = context.host.node.parameters
    own = store.get(join_names(namespace, GAINS_NAME), None)
    return "" if own is None and store.get(f"/{GAINS_NAME}", None) is not None else namespace


def _offer_gains(context: PluginContext, manager: ControllerManager, namespace: str) -> None:
    """Let the gains of joints be changed while the robot runs, by dynamic_reconfigure."""
    from gazelle.control.controllers.controller import ControllerContext
    from gazelle.control.hardware.ros1_joint_setup import gains_parameters
    from gazelle.control.pid import offer_live_gains
    from gazelle.simulator.controller_node import make_ports

    host = context.host
    hardware: DefaultRobotHWSim = manager.robot.components[0]  # type: ignore[assignment]
    with_pids = [section for section in hardware.sections if section.pids is not None]
    if not with_pids:
        return
    parameters = gains_parameters(host.node.parameters, namespace.rstrip("/"), host.diagnostics)
    ports = make_ports(host, context.resources, namespace, "gazebo_ros_control", 1)
    rate_hz = 1e9 / host.engine.step_ns
    owner = ControllerContext(
        "gazebo_ros_control", hardware.plugin, manager.robot, parameters, ports, rate_hz
    )
    for section in with_pids:
        assert section.pids is not None
        for place, name in enumerate(section.names):
            offer_live_gains(owner, f"pid_gains/{name}", (section.pids, place))


def _source(context: PluginContext, namespace: str) -> Any:
    from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource

    return StoreSource(context.host.node.parameters, namespace)


def _description_text(context: PluginContext, parameters: PluginReader, namespace: str) -> str:
    """Return the first description that the parameter store has, upwards from the namespace."""
    name = parameters.text("robotParam")
    parts = [part for part in namespace.split("/") if part]
    places = [join_names("/", *parts[:count], name) for count in range(len(parts), -1, -1)]
    texts = (context.host.node.parameters.get(place, None) for place in places)
    return next((text for text in texts if isinstance(text, str) and text.strip()), "")


def _description(
    context: PluginContext, parameters: PluginReader, namespace: str
) -> ControlDescription | None:
    """Return the description in the parameter store; None when it is not this robot's."""
    from gazelle.control.hardware.control_description import read_description

    name = parameters.text("robotParam")
    parts = [part for part in namespace.split("/") if part]
    places = [join_names("/", *parts[:count], name) for count in range(len(parts), -1, -1)]
    store = context.host.node.parameters
    for place in places:
        text = store.get(place, None)
        if isinstance(text, str) and text.strip():
            found = read_description(text)
            if found is not None and _fits(context, found):
                return found
            what = "is of another robot" if found is not None else "is not a URDF"
            message = f"parameter '{place}' {what}; the description that model"
            message += f" '{context.model.name}' was spawned from is used"
            context.report("control.robot-description", message)
            return None
    return None


def _fits(context: PluginContext, description: ControlDescription) -> bool:
    """Tell whether a description shares joints with the model."""
    names = {joint.name for joint in context.model.joints}
    return not names or not names.isdisjoint(description.joints)


def _period(context: PluginContext, parameters: PluginReader) -> Fraction:
    wanted_ns = round(parameters.number("controlPeriod") * 1e9)
    return control_period(context, wanted_ns, "<controlPeriod>") if wanted_ns else Fraction(1)


def _listen_for_stop(
    context: PluginContext, parameters: PluginReader, manager: ControllerManager
) -> None:
    topic = parameters.text("eStopTopic")
    if not topic:
        return
    hardware: DefaultRobotHWSim = manager.robot.components[0]  # type: ignore[assignment]
    engine = context.host.engine
    active = False

    def take(message: Any) -> None:
        nonlocal active
        was, active = active, bool(message.data)
        hardware.set_stop(active)
        hardware.write(engine.time_ns, engine.step_ns)
        if was and not active:
            manager.reset()

    context.resources.subscription(join_names(manager.namespace, topic), "std_msgs/Bool", take)
