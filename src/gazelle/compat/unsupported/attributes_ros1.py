"""Single names of ROS 1's Python packages that Gazelle does not have, by what is said of them.

Lines are ``owner: name name …``; a name in brackets is a keyword that the owner takes.
"""

from __future__ import annotations

__all__ = ["ROS1_GROUPS"]

_TOOL = "is the inside of a command; run the command itself, with subprocess where Python has to"
_CLOCK = "sets rospy's clock from inside; use_sim_time and /clock do it"
_TRANSPORT = (
    "is about rospy's TCPROS connections, which Gazelle's graph does not have; "
    "rospy.Publisher, rospy.Subscriber and rospy.Service connect by themselves"
)
_ROSPY = (
    "is kept inside of rospy while a node is set up; rospy.init_node, "
    "rospy.loginfo_throttle and their like, rospy.on_shutdown and rospy.names.get_mappings "
    "do its work"
)
_GOALS = (
    "is the bookkeeping inside of actionlib; use SimpleActionClient, ActionClient, "
    "SimpleActionServer, ActionServer and the methods of their goal handles"
)
_CFG = (
    "writes C++ and pages of a .cfg file when it is built; here .cfg files are read as they "
    "are, and ParameterGenerator's add, add_group, enum, const and generate are there"
)
_CONFIG = (
    "is a step inside of dynamic_reconfigure's messages; Client.get_configuration, "
    "Client.update_configuration and Server take and give dictionaries"
)
_REGISTER = (
    "registers with the XML-RPC master, which is not here; rospy.Publisher, "
    "rospy.Subscriber, rospy.Service and rospy.get_param_cached do it by themselves"
)
_HANDSHAKE = (
    "is about TCPROS connections, which Gazelle's graph does not have; rospy's publishers "
    "and subscribers connect by themselves"
)
_MONITOR = (
    "is roslaunch's process monitor; roslaunch.scriptapi.ROSLaunch().launch(node) returns a "
    "process with is_alive, stop and exit_code, and shutdown of ROSLaunchParent ends all"
)
_LAUNCH = (
    "is roslaunch's inside; roslaunch.parent.ROSLaunchParent and "
    "roslaunch.scriptapi.ROSLaunch start launch files and nodes, roslaunch.core has their "
    "records"
)
_NODE_ADDRESS = (
    "is about nodes' XML-RPC connections, which Gazelle's graph does not have; "
    "rosnode.get_node_names, rosnode.rosnode_ping and rosgraph.Master answer"
)
_TOPIC = (
    "is a step inside of rostopic; use rospy.Publisher and rospy.Subscriber with "
    "rostopic.get_topic_class, and get_hz of rostopic.ROSTopicHz"
)
_SERVICE = (
    "is about services' TCPROS connections, which Gazelle's graph does not have; "
    "rosservice.get_service_node, get_service_args and call_service are there"
)
_PARAM = (
    "is a step inside of rosparam; rosparam.get_param, set_param, list_params and load_str "
    "do its work"
)
_BAG = (
    "is about how rosbag writes its files; Bag's write, read_messages, "
    "get_type_and_topic_info and get_message_count are there, and bags are not encrypted "
    "here"
)
_LIB = (
    "is left of ROS before catkin; rospkg.RosPack finds packages, and ROS_PACKAGE_PATH is "
    "in os.environ"
)
_PKG = (
    "is about stacks and manifests of ROS before catkin; rospkg.RosPack().list, get_path, "
    "get_depends and get_manifest do its work"
)
_TESTS = (
    "is the inside of a test runner; write tests with unittest and rosunit.unitrun or "
    "rostest.rosrun"
)
_ARCBALL = (
    "turns things by the mouse on a screen; quaternion_about_axis and quaternion_multiply "
    "make the turns"
)
_FROM = "reads a projection back from its matrix; keep the arguments of projection_matrix"
_TWIST = (
    "looks a speed up; take the difference of two lookupTransform calls, or read "
    "nav_msgs/Odometry's twist"
)
_TF = "is not among what Gazelle has; tf.transformations' other functions and numpy do its work"
_KDL = (
    "needs PyKDL, a C++ library, or is a step around it; do_transform_pose, "
    "do_transform_point, do_transform_cloud and tf.transformations do its work"
)
_MOVE = (
    "is not among what Gazelle's MoveIt has; plan, go, execute, set_path_constraints and "
    "PlanningSceneInterface's add and attach functions are"
)
_SRDF = (
    "is the builder's inside of srdfdom; Robot.from_xml_string and Robot.from_xml_file read "
    "a file, whose lists can be appended to"
)
_IMAGE = "is this argument's name in some distributions and another in others; give it by position"
_CAMERA = (
    "needs what OpenCV's C++ part does; rectifyPoint, project3dToPixel, imgmsg_to_cv2 and "
    "cv2 itself do its work"
)
_LASER = "is a constant of the original's own masks; projectLaser takes channel_options"
_NUMPY = "is a table inside of ros_numpy; numpify and msgify do its work"
_REST = "is an inner part of its package; what is public of it does its work"

ROS1_GROUPS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (
        _TOOL,
        (
            "rosbag: rosbagmain",
            "roslaunch: handle_exception main roslaunch_core roslaunch_param_dump",
            "rosmsg: MAX_DEFAULT_NON_FLOW_ITEMS RosMsgProtoArgsException RosMsgProtoException",
            "rosmsg: construct_ordered_mapping construct_yaml_map_with_ordered_dict",
            "rosmsg: create_names_filter fullusage get_array_type_instance get_yaml_for_msg",
            "rosmsg: init_rosmsg_proto represent_ordered_mapping rosmsg_cmd_list",
            "rosmsg: rosmsg_cmd_md5 rosmsg_cmd_package rosmsg_cmd_packages",
            "rosmsg: rosmsg_cmd_prototype rosmsg_cmd_show rosmsg_debug rosmsgmain spec_to_str",
            "rosnode: cleanup_master_blacklist cleanup_master_whitelist rosnode_cleanup",
            "rosnode: rosnode_debugnode rosnode_info rosnode_listnodes rosnodemain",
            "rosparam: construct_angle_degrees construct_angle_radians construct_yaml_binary",
            "rosparam: pattern print_params represent_foo represent_xml_binary yamlmain",
            "rosservice: rosservicemain",
            "rostest: XML_OUTPUT_FLAG deprecated rostestmain",
            "rostopic: CallbackEcho argv_publish create_value_transform file_yaml_arg long",
            "rostopic: param_publish param_publish_once rostopicmain stdin_publish",
            "rostopic: stdin_yaml_arg",
            "rosunit: XML_OUTPUT_FLAG create_xml_runner print_runner_summary",
            "rosunit: print_unittest_summary rostest_name_from_path xml_results_file",
        ),
    ),
    (
        _CLOCK,
        ("rospy.rostime: get_rostime_cond set_rostime_initialized switch_to_wallclock",),
    ),
    (
        _TRANSPORT,
        (
            "rospy.service: BIDIRECTIONAL DeadTransport INBOUND OUTBOUND ProtocolHandler",
            "rospy.service: ServiceManager Transport",
            "rospy.topics: Poller python3",
        ),
    ),
    (
        _ROSPY,
        (
            "rospy.core: LoggingIdentical LoggingOnce LoggingThrottle configure_logging",
            "rospy.core: initialize_mappings register_signals reload_mappings set_initialized",
            "rospy.core: set_node_uri xmlrpcapi",
            "rospy.names: initialize_mappings reload_mappings",
            "rospy.service: LoggingIdentical LoggingOnce LoggingThrottle configure_logging",
            "rospy.service: initialize_mappings register_signals reload_mappings",
            "rospy.service: set_initialized set_node_uri xmlrpcapi",
            "rospy.topics: LoggingIdentical LoggingOnce LoggingThrottle configure_logging",
            "rospy.topics: initialize_mappings register_signals reload_mappings",
            "rospy.topics: set_initialized set_node_uri xmlrpcapi",
        ),
    ),
    (
        _GOALS,
        (
            "actionlib.ClientGoalHandle: (comm_state_machine)",
            "actionlib: CommStateMachine GoalManager INVALID_TRANSITION NO_TRANSITION",
            "actionlib: g_goal_id get_name_of_constant nop_cb",
            "actionlib.action_client.ClientGoalHandle: (comm_state_machine)",
            "actionlib.action_client: CommStateMachine GoalManager INVALID_TRANSITION",
            "actionlib.action_client: NO_TRANSITION g_goal_id get_name_of_constant",
            "actionlib.action_server.ActionServer: initialize internal_cancel_callback",
            "actionlib.action_server.ActionServer: internal_goal_callback publish_feedback",
            "actionlib.action_server.ActionServer: publish_result publish_status_async",
            "actionlib.goal_id_generator: s_goalcount s_goalcount_lock",
            "actionlib.server_goal_handle.ServerGoalHandle: (handle_tracker) (status_tracker)",
            "actionlib.simple_action_server.SimpleActionServer: executeLoop",
            "actionlib.simple_action_server.SimpleActionServer: internal_goal_callback",
            "actionlib.simple_action_server.SimpleActionServer: internal_preempt_callback",
            "actionlib.simple_action_server: nop_cb",
        ),
    ),
    (
        _CFG,
        (
            "dynamic_reconfigure.parameter_generator: LINEDEBUG check_description check_name",
            "dynamic_reconfigure.parameter_generator: id",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: appendgroup",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: appendline",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: check_type",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: check_type_fill_default",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: crepr",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: defval",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: deleteobsolete",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: deleteoneobsolete",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: fill_type",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: generatecpp",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: generatedoc",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: generatepy",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: generateusage",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: generatewikidoc",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: maxval minval mkdir",
            "dynamic_reconfigure.parameter_generator.ParameterGenerator: mkdirabs pytype",
            "dynamic_reconfigure.parameter_generator_catkin: LINEDEBUG check_description",
            "dynamic_reconfigure.parameter_generator_catkin: check_name id",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: appendgroup",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: appendline",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: check_type",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: "
            "check_type_fill_default",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: crepr",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: defval",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: fill_type",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: generatecpp",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: generatedoc",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: generatepy",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: generateusage",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: generatewikidoc",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: maxval",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: minval",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: mkdirabs",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: pytype",
            "dynamic_reconfigure.parameter_generator_catkin.ParameterGenerator: replace_infinity",
        ),
    ),
    (
        _CONFIG,
        (
            "dynamic_reconfigure.encoding.encode_config: (flat)",
            "dynamic_reconfigure.encoding: encode_description encode_groups get_parents",
            "dynamic_reconfigure.encoding: get_tree group_dict initial_config",
        ),
    ),
    (
        _REGISTER,
        (
            "rosgraph.masterapi.Master: registerPublisher registerService registerSubscriber",
            "rosgraph.masterapi.Master: subscribeParam unregisterPublisher unregisterService",
            "rosgraph.masterapi.Master: unregisterSubscriber unsubscribeParam",
        ),
    ),
    (
        _HANDSHAKE,
        (
            "rosgraph.network: ROSHandshakeException SIOCGIFADDR SIOCGIFCONF",
            "rosgraph.network: decode_ros_handshake_header encode_ros_handshake_header",
            "rosgraph.network: python3 read_ros_handshake_header write_ros_handshake_header",
        ),
    ),
    (
        _MONITOR,
        (
            "roslaunch.Process: (args) (env) (required) (respawn) (respawn_delay)",
            "roslaunch.pmon: DeadProcess FatalProcessLaunch ProcessMonitor pmon_shutdown",
            "roslaunch.pmon: rl_signal shutdown_process_monitor start_process_monitor",
            "roslaunch.pmon.Process: (args) (env) (required) (respawn) (respawn_delay)",
            "roslaunch.pmon.Process: should_respawn start",
        ),
    ),
    (
        _LAUNCH,
        (
            "roslaunch: DEFAULT_TIMEOUT_SIGINT DEFAULT_TIMEOUT_SIGTERM Master NAME",
            "roslaunch: ROSLaunchConfig ROSLaunchRunner Test XmlLoader XmlParseException",
            "roslaunch: write_pid_file",
            "roslaunch.configure_logging: (uuid)",
            "roslaunch.core: Executable Machine Master PHASE_RUN PHASE_SETUP PHASE_TEARDOWN",
            "roslaunch.core: Param RosbinExecutable TEST_TIME_LIMIT_DEFAULT Test",
            "roslaunch.core: add_printerrlog_handler add_printlog_handler basestring",
            "roslaunch.core: clear_printerrlog_handlers clear_printlog_handlers",
            "roslaunch.core: generate_run_id get_master_uri_env get_ros_package_path",
            "roslaunch.core: get_ros_root is_child_mode is_machine_local local_machine",
            "roslaunch.core: printerrlog printlog printlog_bold remap_localhost_uri",
            "roslaunch.core: rle_wrapper set_child_mode setup_env unicode",
            "roslaunch.core.Node: to_remote_xml xmlattrs xmltype",
            "roslaunch.parent: load_config_default",
            "roslaunch.rlutil: change_terminal_name check_log_disk_usage check_roslaunch",
            "roslaunch.rlutil: print_file_list update_terminal_name",
        ),
    ),
    (
        _NODE_ADDRESS,
        (
            "rosnode: CONNECTION_PATTERN get_node_connection_info_description",
            "rosnode: get_node_info_description lookup_uri",
        ),
    ),
    (
        _TOPIC,
        (
            "rostopic.ROSTopicHz: set_last_printed_tn set_msg_t0 set_msg_tn set_times",
            "rostopic: create_field_filter create_publisher get_api msgevalgen",
            "rostopic: publish_message wait_for_subscriber",
        ),
    ),
    (
        _SERVICE,
        ("rosservice: get_service_headers get_service_uri has_service_args",),
    ),
    (
        _PARAM,
        ("rosparam: get_param_server",),
    ),
    (
        _BAG,
        (
            "rosbag.bag.Bag: chunk_threshold compression options set_encryptor",
            "rosbag.bag: ComparableMixin ROSBagEncryptException",
            "rosbag.bag: ROSBagEncryptNotSupportedException found_lz4",
        ),
    ),
    (
        _LIB,
        ("roslib: is_interactive set_interactive",),
    ),
    (
        _PKG,
        (
            "rospkg.Manifest: (filename) (is_catkin) (type_)",
            "rospkg: expand_to_packages get_stack_version_by_dir list_by_path",
            "rospkg: parse_manifest_file",
            "rospkg.rospack: ManifestManager expand_to_packages get_stack_version_by_dir",
            "rospkg.rospack: list_by_path",
            "rospkg.rospack.RosPack: get_rosdeps",
            "rospkg.rospack.RosStack: get_stack_version packages_of",
        ),
    ),
    (
        _TESTS,
        ("rostest: get_master is_publisher is_subscriber",),
    ),
    (
        _ARCBALL,
        (
            "tf.transformations: Arcball arcball_constrain_to_axis arcball_map_to_sphere",
            "tf.transformations: arcball_nearest_axis",
            "tf_transformations: Arcball arcball_constrain_to_axis arcball_map_to_sphere",
            "tf_transformations: arcball_nearest_axis",
        ),
    ),
    (
        _FROM,
        (
            "tf.transformations: projection_from_matrix",
            "tf_transformations: projection_from_matrix",
        ),
    ),
    (
        _TWIST,
        ("tf.listener.Transformer: lookupTwist lookupTwistFull",),
    ),
    (
        _TF,
        (
            "tf_transformations: ROTATION_IDENTITY SHEAR_IDENTITY TRANSLATION_IDENTITY",
            "tf_transformations: ZOOM_IDENTITY",
        ),
    ),
    (
        _KDL,
        (
            "tf2_geometry_msgs: do_transform_polygon_stamped from_msg_msg to_msg_msg",
            "tf2_geometry_msgs: transform_covariance transform_to_kdl",
            "tf2_geometry_msgs.tf2_geometry_msgs: do_transform_polygon_stamped from_msg_msg",
            "tf2_geometry_msgs.tf2_geometry_msgs: to_msg_msg transform_covariance",
            "tf2_geometry_msgs.tf2_geometry_msgs: transform_to_kdl",
            "tf2_sensor_msgs: from_msg_msg to_msg_msg transform_points transform_to_kdl",
            "tf2_sensor_msgs.tf2_sensor_msgs: from_msg_msg to_msg_msg transform_points",
            "tf2_sensor_msgs.tf2_sensor_msgs: transform_to_kdl",
            "tf_conversions: fromCameraParams fromMatrix fromMsg fromTf toMatrix toMsg toTf",
        ),
    ),
    (
        _MOVE,
        (
            "moveit_commander: MoveGroupCommandInterpreter MoveGroupInfoLevel acm_set_allowed",
            "moveit_commander: acm_set_default pyassimp",
            "moveit_commander.conversions: msg_from_string msg_to_string",
            "moveit_commander.move_group.MoveGroupCommander: clear_trajectory_constraints",
            "moveit_commander.move_group.MoveGroupCommander: get_known_constraints",
            "moveit_commander.move_group.MoveGroupCommander: get_trajectory_constraints",
            "moveit_commander.move_group.MoveGroupCommander: set_constraints_database",
            "moveit_commander.move_group.MoveGroupCommander: set_trajectory_constraints",
            "moveit_commander.move_group.MoveGroupCommander.execute: (plan_msg)",
            "moveit_commander.planning_scene_interface.PlanningSceneInterface: attach_cylinder",
            "moveit_commander.planning_scene_interface.PlanningSceneInterface.attach_object: "
            "(object)",
            "moveit_commander.planning_scene_interface: acm_set_allowed acm_set_default",
            "moveit_commander.planning_scene_interface: pyassimp",
            "moveit_commander.robot.RobotCommander: get_robot_markers",
        ),
    ),
    (
        _SRDF,
        (
            "srdfdom.srdf.Robot: add_aggregate add_chain add_disable_collisions add_group",
            "srdfdom.srdf.Robot: add_joint add_link add_link_sphere_approximation",
            "srdfdom.srdf.Robot: add_passive_joint from_parameter_server",
            "srdfdom.srdf.VirtualJoint: (joint_type) TYPES check_valid",
            "srdfdom.srdf: link_element name_attribute verbose",
        ),
    ),
    (
        _IMAGE,
        ("genpy.message.Message.deserialize: (str_)",),
    ),
    (
        _CAMERA,
        (
            "cv_bridge.core.CvBridge: cvtype2_to_dtype_with_channels encoding_to_cvtype2",
            "cv_bridge: cvtColorForDisplay",
            "image_geometry.cameramodels.PinholeCameraModel: rectifyImage",
            "image_geometry.cameramodels: mkmat",
        ),
    ),
    (
        _LASER,
        (
            "laser_geometry.laser_geometry.LaserProjection: LASER_SCAN_INVALID",
            "laser_geometry.laser_geometry.LaserProjection: LASER_SCAN_MAX_RANGE",
            "laser_geometry.laser_geometry.LaserProjection: LASER_SCAN_MIN_RANGE",
        ),
    ),
    (
        _NUMPY,
        (
            "ros_numpy.image: name_to_dtypes",
            "ros_numpy.numpy_msg: (cls)",
            "ros_numpy.point_cloud2: DUMMY_FIELD_PREFIX nptype_to_pftype pftype_sizes",
            "ros_numpy.point_cloud2: pftype_to_nptype type_mappings",
        ),
    ),
    (
        _REST,
        (
            "angles: shortest_angular_distance_with_large_limits",
            "genpy: struct_I",
            "genpy.message: RosMsgUnicodeErrors check_type get_printable_message_args isstring",
            "genpy.message: long struct_I",
        ),
    ),
)
