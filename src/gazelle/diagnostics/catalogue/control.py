"""Codes of the control layer: parameters, controllers, their manager and their hardware."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_PARAMETERS = (
    Entry(
        "control.double-parameter",
        "warning",
        "A parameter file has a key twice",
        "YAML keeps the last one and says nothing.",
        "remove one of them",
    ),
    Entry(
        "control.parameters-of-others",
        "warning",
        "The parameter files are for nodes of another namespace",
        "Names of ROS 2 parameter files are full names: controller_manager is not the"
        " /robot1/controller_manager of a robot in a namespace.",
        "write /**/controller_manager",
        "The 'type' param was not defined for",
    ),
    Entry(
        "control.no-ros-parameters",
        "warning",
        "A parameter file of ROS 2 lacks ros__parameters",
        "Such files are written node by node, the parameters below ros__parameters. Gazelle reads"
        " the file as ROS 1 wrote them; real ROS 2 would refuse it.",
        "add the level: name: / ros__parameters: / parameters",
        "Cannot have a value before ros__parameters",
    ),
    Entry(
        "control.parameter-file",
        "error",
        "A parameter file cannot be read",
        "It is missing, not UTF-8, not YAML, or has a value no parameter can have.",
        "mend the file at the place given",
        "failed to parse yaml params file",
    ),
)

_CHECKS = (
    Entry(
        "control.names-disagree",
        "warning",
        "Robot, hardware, controllers and MoveIt do not mean the same joints",
        "A joint's name must be the same in the URDF, in its transmission or <ros2_control> block,"
        " in the controllers' parameters and in MoveIt's list. The table shows every name that is"
        " missing somewhere.",
        "use one name everywhere",
        "Could not find resource in hardware_interface, or: Joint not found in controller",
    ),
    Entry(
        "control.unstable-gains",
        "warning",
        "Gains are unstable with the joint's inertia and the period of control",
        "An effort that is computed at intervals overshoots when the gains are large for the"
        " inertia it moves. The check looks at the joint's own inertia in the present pose.",
        "use smaller gains, a shorter step, or a joint damping",
        "robot shakes, jitters or explodes when the controller starts",
    ),
    Entry(
        "control.zero-limit",
        "warning",
        "A joint that is controlled has a limit of 0",
        'Exporters write effort="0" velocity="0". Gazebo takes that at its word: efforts are'
        " cut to 0, and joint limits hold the joint.",
        "write the motor's real limits",
        "effort limit 0, joint does not move",
    ),
)

_MANAGER = (
    Entry(
        "control.controller-failed",
        "error",
        "A controller failed while it ran",
        "Its update, start or stop raised an error. It is stopped; the other controllers go on.",
        "see the message; for a controller of your own it has file and line",
        "update resulted in an error",
    ),
    Entry(
        "control.update-rate",
        "warning",
        "A controller's wish about when it runs cannot be met",
        "A controller runs at most as often as the controller manager, and in its loop.",
        "lower update_rate, or raise the controller manager's",
        "update rate should be less than or equal to controller manager's update rate",
    ),
)

_PID = (
    Entry(
        "control.bad-gains",
        "error",
        "The bounds of a PID contradict each other",
        "control_toolbox skips such gains; here p, i and d are used, without integral.",
        "let i_clamp_min be at most i_clamp_max, and u_clamp_min at most u_clamp_max",
        "received i_min > i_max, skip new gains",
    ),
    Entry(
        "control.integral-without-clamp",
        "info",
        "A PID has an integral gain and no i_clamp",
        "In ROS 1 and in ROS 2 up to Iron i_clamp defaults to 0, which bounds the integral's part"
        " to nothing; newer ROS 2 leaves it unbounded. Gazelle does what the robot's generation"
        " does.",
        "write i_clamp (or i_clamp_max and i_clamp_min), or leave i out",
    ),
)

_TRAJECTORY = (
    Entry(
        "control.idle-gains",
        "info",
        "Gains of a controller have no effect",
        "A controller that commands positions hands them on; nothing computes a PID with the gains."
        " How stiffly the joint follows is the hardware's business.",
        "command 'effort' or 'velocity' to use the gains, or remove them",
        "No p gain specified for pid",
        idle=True,
    ),
    Entry(
        "control.no-deceleration",
        "warning",
        "A trajectory controller cannot decelerate when it is cancelled",
        "decelerate_on_cancel needs a deceleration and a velocity limit of each joint, and measured"
        " velocities. Without them the position is held at once.",
        "give constraints.<joint>.max_deceleration_on_cancel, <limit velocity=…> and the state"
        " interface velocity",
        "Falling back to hold position on cancel",
    ),
)

_WHEELS = (
    Entry(
        "control.limit-without-value",
        "warning",
        "A limit is switched on and has no value",
        "ROS 1's controllers take 0 for it, so the robot does not move at all; ROS 2's refuse to"
        " configure or go without a limit.",
        "give the max_… of the limit",
    ),
    Entry(
        "control.limit-of-nothing",
        "warning",
        "A limit of 0 is left out",
        "Files of ROS 2 Humble have max_jerk: 0.0 where no limit was meant, since nothing switched"
        " it on. From Jazzy on such a robot does not move; here it does.",
        "write .NAN for no limit",
    ),
    Entry(
        "control.no-covariance",
        "info",
        "A base's controller has no covariances",
        "Odometry is published with covariances of 0. ROS 1's controllers end their program when"
        " pose_covariance_diagonal or twist_covariance_diagonal is missing.",
        "give six variances: x, y, z, roll, pitch, yaw",
        "ROS_ASSERT(pose_cov_list.getType() == XmlRpc::XmlRpcValue::TypeArray)",
    ),
    Entry(
        "control.wheel-measure",
        "warning",
        "A wheel's measure is taken from the robot's description",
        "ROS 2's controllers need wheel_separation and wheel_radius as parameters.",
        "give the parameter",
        "Invalid value set during initialization for parameter",
    ),
    Entry(
        "control.wheels-exchanged",
        "warning",
        "Left and right wheels are exchanged",
        "The joint named as a left wheel stands on the right side, so turns go the wrong way.",
        "exchange the names",
    ),
)

_WHEEL_GEOMETRY = (
    Entry(
        "control.wheel-geometry",
        "warning",
        "A base's wheel parameters disagree with the robot's geometry",
        "Commands and odometry are computed from the parameters, the motion comes from the wheels. "
        "Multipliers are left aside: they are for calibration.",
        "write the geometry's values, calibrate with the multipliers",
        "odometry drifts; robot turns too little or too much",
    ),
)

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
        "control.ros2-control-twice",
        "error",
        "A joint stands twice in a block of <ros2_control>",
        "Each joint has one element in a block, with all its interfaces.",
        "give one of the two elements the name that it was to have",
        "already exists",
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

ENTRIES = (
    *_PARAMETERS,
    *_CHECKS,
    *_MANAGER,
    *_PID,
    *_TRAJECTORY,
    *_WHEELS,
    *_WHEEL_GEOMETRY,
    *_TRANSMISSIONS,
    *_JOINTS,
    *_LOADING,
    *_ROS2,
)
