"""Codes of the hardware that controllers drive: transmissions, interfaces, limits."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

_TRANSMISSIONS = (
    Entry(
        "control.no-transmissions",
        "warning",
        "A robot with ros_control has no joint to control",
        "The controller manager runs, but no controller that drives a joint can be loaded.",
        "add a <transmission> for every joint that controllers drive",
        "No valid transmissions found.",
    ),
    Entry(
        "control.transmission-idle",
        "info",
        "Reductions of transmissions do not act in simulation",
        "Gazebo's DefaultRobotHWSim drives the joints themselves, and so does Gazelle: efforts, "
        "positions and velocities are those of the joint, never of the motor.",
        "nothing; the reductions matter on the real robot",
        idle=True,
    ),
    Entry(
        "control.transmission-joints",
        "info",
        "A transmission moves more than one joint",
        "Every joint is driven directly. Gazebo leaves out such transmissions, differentials and "
        "four-bar linkages too.",
        "for Gazebo, write one SimpleTransmission for each joint",
        "has more than one joint. Currently the default robot hardware simulation interface only "
        "supports one.",
    ),
    Entry(
        "control.transmission-parts",
        "warning",
        "A transmission has too few or too many joints or actuators",
        "Joints are driven directly all the same; a real robot would refuse it.",
        "simple transmissions join one actuator and one joint, differentials and four-bar "
        "linkages two and two",
    ),
    Entry(
        "control.transmission-reduction",
        "warning",
        "A mechanical reduction is 0",
        "Joints are driven directly all the same; a real robot would refuse it.",
        "write the reduction, or 1",
        "Transmission reduction ratios cannot be zero.",
    ),
    Entry(
        "control.transmission-roles",
        "warning",
        "A transmission of two joints does not say which is which",
        "The order of the file counts; a real robot would refuse it.",
        "add <role>joint1</role>, joint2, actuator1 and actuator2",
        "does not specify a valid <role> element",
    ),
    Entry(
        "control.transmission-twice",
        "warning",
        "Two transmissions drive the same joint",
        "The first one counts.",
        "remove one of them",
    ),
    Entry(
        "control.transmission-type",
        "info",
        "The type of a transmission is not known",
        "Its joints are driven directly, as those of every transmission are in simulation.",
        "use transmission_interface/SimpleTransmission, DifferentialTransmission or "
        "FourBarLinkageTransmission",
    ),
)

_JOINTS = (
    Entry(
        "control.hardware-joint",
        "error",
        "The hardware names a joint that the simulated model does not have or cannot move",
        "The joint is left out; controllers that need it cannot be loaded.",
        "correct the joint's name",
        "which is not in the gazebo model.",
    ),
    Entry(
        "control.hardware-interface-extra",
        "info",
        "A joint has several hardware interfaces",
        "The first one is used, as in Gazebo.",
        "keep the interface that the controllers need",
        "specifies multiple hardware interfaces.",
    ),
    Entry(
        "control.hardware-interface-missing",
        "warning",
        "A hardware interface is missing or stands in the wrong place",
        "Without one the joint is driven by efforts, as on the PR2; one in <actuator> is used.",
        "write <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface> "
        "in the <joint> of the transmission",
        "does not specify any hardware interface.",
    ),
    Entry(
        "control.hardware-interface-prefix",
        "info",
        "A hardware interface lacks its package",
        "It is understood.",
        "write hardware_interface/ in front of it",
        "Deprecated syntax, please prepend 'hardware_interface/'",
    ),
    Entry(
        "control.hardware-interface-unknown",
        "error",
        "A hardware interface is not known",
        "The joint can be read, but not commanded. Real ROS would not start any controller.",
        "use hardware_interface/EffortJointInterface, PositionJointInterface or "
        "VelocityJointInterface",
        "No matching hardware interface found for",
    ),
)

_LOADING = (
    Entry(
        "control.ideal-servo",
        "info",
        "Position joints without gains are ideal servos",
        "They go where they are told whatever it takes, as in Gazebo, where the log calls it an "
        "error.",
        "nothing, or set <namespace>/gazebo_ros_control/pid_gains/<joint> to p, i and d",
        "No p gain specified for pid.",
    ),
    Entry(
        "control.period",
        "info",
        "The control period does not fit the physics step",
        "Controllers run at whole steps, when at least a period has passed, as in Gazebo.",
        "choose a period that is a multiple of the step, or change the world's step",
        "is faster than the gazebo simulation period",
    ),
    Entry(
        "control.robot-description",
        "warning",
        "The robot_description in the parameter store is not this robot's",
        "The description that the model was spawned from is used. Gazebo would start nothing.",
        "set robotParam and robotNamespace of the plug-in to this robot's description",
    ),
    Entry(
        "control.robot-sim-type",
        "info",
        "The simulated hardware is a class of its own",
        "It is compiled code. Gazebo's default takes its place: joints by their transmissions, "
        "one command interface each.",
        "nothing, when the controllers use joints only",
    ),
)

_ROS2 = (
    Entry(
        "control.hardware-parameter",
        "info",
        "A parameter of ros2_control hardware has no effect",
        "The simulated hardware does not know it.",
        "nothing, when it is for the real robot",
        idle=True,
    ),
    Entry(
        "control.hardware-mocked",
        "warning",
        "Mock hardware takes the place of a compiled class",
        "GAZELLE_MOCK_HARDWARE asks for it: commands come back as states, sensors measure nothing, "
        "and parameters of the real hardware have no effect.",
        "unset GAZELLE_MOCK_HARDWARE where the real robot is",
    ),
    Entry(
        "control.hardware-plugin",
        "error",
        "The hardware of a <ros2_control> block is not simulated",
        "Drivers of real robots are compiled code and need the robot. Nothing takes their place, "
        "as in Gazebo: controllers that need the block's joints cannot be loaded.",
        "use gazebo_ros2_control/GazeboSystem or gz_ros2_control/GazeboSimSystem in simulation, "
        "with an argument of the xacro file",
        "According to the loaded plugin descriptions the class … does not exist.",
    ),
    Entry(
        "control.hardware-plugin-other",
        "warning",
        "The hardware of a <ros2_control> block belongs to another program",
        "Gazelle runs it; the Gazebo plug-in of the model would not load it.",
        "use the hardware of the plug-in that the model names",
        "The plugin failed to load for some reason.",
    ),
    Entry(
        "control.no-parameter-file",
        "warning",
        "A ros2_control plug-in names no parameter file",
        "The controller manager runs with its defaults; controllers have no types.",
        "add <parameters>path/to/controllers.yaml</parameters> to the plug-in",
        "No parameter file provided. Configuration might be wrong",
    ),
    Entry(
        "control.ros2-control-gpio",
        "info",
        "Simulated hardware has no gpio",
        "The interfaces are left out, as in Gazebo; mock_components/GenericSystem has them.",
        "nothing, when it is for the real robot",
    ),
    Entry(
        "control.ros2-control-interface",
        "warning",
        "An interface of a <ros2_control> block is not offered in simulation",
        "Joints have position, velocity and effort; IMUs and force-torque sensors their values.",
        "correct the name, or remove the interface",
    ),
    Entry(
        "control.ros2-control-mimic",
        "error",
        "A joint of a <ros2_control> block mimics a joint that is not in the block",
        "It moves by itself.",
        "correct the name, or use <mimic> in the joint of the robot",
        "Mimicked joint not found",
    ),
    Entry(
        "control.ros2-control-missing",
        "error",
        "A robot with a ros2_control plug-in has no <ros2_control> block",
        "The controller manager runs, but has no interfaces.",
        "add a <ros2_control> block with the joints",
        "no ros2_control tag",
    ),
    Entry(
        "control.ros2-control-sensor",
        "warning",
        "A sensor of a <ros2_control> block is not in the simulated model",
        "Its states are left out.",
        "give an IMU or force-torque sensor of the model the same name",
        "which is not in the gazebo model.",
    ),
    Entry(
        "control.ros2-control-value",
        "warning",
        "A number of a <ros2_control> block cannot be read",
        "It is left out.",
        "write a plain number; decimal commas are not understood",
        "Failed converting initial_value string to real number",
    ),
)

ENTRIES = (*_TRANSMISSIONS, *_JOINTS, *_LOADING, *_ROS2)
