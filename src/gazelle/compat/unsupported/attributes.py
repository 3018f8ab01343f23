"""Single names of ROS's Python packages that Gazelle does not have, though it has their module.

A part is a dotted name of the original: an attribute of a module or class (``*`` at the end of a
module's), or a callable with a keyword in brackets.
"""

from __future__ import annotations

from typing import NamedTuple

from gazelle.compat.unsupported.attributes_ros1 import ROS1_GROUPS

__all__ = ["UNSUPPORTED_ATTRIBUTES", "UnsupportedAttribute"]


class UnsupportedAttribute(NamedTuple):
    """Why a name is not here.

    Attributes:
        part: the name.
        reason: what it is, and what to do.
    """

    part: str
    reason: str


def _of(reason: str, *owners: str) -> list[UnsupportedAttribute]:
    """Return rows of ``owner: name name …``; a name that begins with a bracket is a keyword."""
    rows = []
    for line in owners:
        owner, _, names = line.partition(": ")
        rows += [
            UnsupportedAttribute(f"{owner}{name}" if name[0] == "(" else f"{owner}.{name}", reason)
            for name in names.split()
        ]
    return rows


_HANDLE = (
    "belongs to rclpy's C library, which is not here: Gazelle's graph has no handles; the public"
    " methods of Node, Publisher, Subscription, Client and Service do their work"
)
_MADE = (
    "is filled in by rclpy itself; make these objects with a node's create_publisher,"
    " create_subscription, create_client, create_service, create_timer"
)
_WAIT = "is how rclpy's executor waits for objects; rclpy.spin and the executors call callbacks"
_GRAMMAR = (
    "is the inside of the reader of $(…); use launch.frontend.parse_substitution.parse_substitution"
)
_PLUGIN = (
    "is the inside of the pytest plug-in; use launch_pytest.fixture, @pytest.mark.launch and"
    " launch_pytest.tools"
)
_TESTS = "is the inside of launch_testing's runner; run tests with launch_test or pytest"
_BY_POSITION = (
    "is this argument's name in some distributions and another in others; give it by position"
)
_LEFT_OUT = "has no meaning here; leave it out"
_REWRITE = "is a step inside of the substitution; use RewrittenYaml(...).perform(context)"
_EXTENSION = "loads extensions of launch_ros from entry points; Gazelle's Node has none"
_NAV2 = (
    "needs a Nav2 server that is not among Gazelle's; goToPose, goThroughPoses, followWaypoints,"
    " followPath, spin, backup and driveOnHeading are"
)
_NAV2_KEYWORD = "is a field of newer Nav2 goals that Gazelle's servers do not read; leave it out"
_BAG = (
    "is part of rosbag2's C++ transport; use SequentialReader and SequentialWriter, or run ros2 bag"
    " record, play and convert"
)
_FILTER = (
    "is the inside of message_filters; use registerCallback, getInterval, getElemAfterTime,"
    " getElemBeforeTime, and the synchronizers' queue_size and slop"
)
_LISTENER = "is the inside of tf2_ros; use Buffer, TransformListener and their lookup_transform"

UNSUPPORTED_ATTRIBUTES: tuple[UnsupportedAttribute, ...] = tuple(
    sorted(
        [
            *_of(
                _HANDLE,
                "rclpy.client.Client: handle configure_introspection get_pending_request",
                "rclpy.clock.Clock: handle create_jump_callback",
                "rclpy.clock: ClockHandle* JumpHandle*",
                "rclpy.clock.ROSClock: set_ros_time_override",
                "rclpy.context: ContextHandle* g_logging_*",
                "rclpy.context.Context: destroy handle track_node untrack_node",
                "rclpy.duration.Duration: get_c_duration",
                "rclpy.guard_condition.GuardCondition: handle",
                "rclpy.node.Node: handle",
                "rclpy.publisher.Publisher: handle",
                "rclpy.qos.QoSProfile: get_c_qos_profile",
                "rclpy.service.Service: configure_introspection handle send_response",
                "rclpy.subscription.Subscription: handle",
                "rclpy.timer.Timer: handle",
                "rclpy: get_rmw_implementation_identifier",
                "rclpy.time: TimeHandle",
                "rclpy.signals: SignalHandlerGuardCondition*",
            ),
            *_of(
                _MADE,
                "rclpy.action.client.ClientGoalHandle: (goal_response)",
                "rclpy.action.server.ServerGoalHandle: (goal_info) (goal_request)",
                "rclpy.client.Client: (callback_group) (client_impl) (context) (qos_profile)",
                "rclpy.guard_condition.GuardCondition: (callback_group) (context)",
                "rclpy.publisher.Publisher: (callback_group) (event_callbacks) (publisher_impl)",
                "rclpy.publisher.Publisher: (qos_profile)",
                "rclpy.service.Service: (callback_group) (qos_profile) (service_impl)",
                "rclpy.subscription.Subscription: (callback_group) (event_callbacks)",
                "rclpy.subscription.Subscription: (qos_profile) (subscription_impl)",
                "rclpy.timer.Rate: (context) (timer)",
                "rclpy.timer.Timer: (callback_group) (context) (timer_period_ns)",
            ),
            *_of(
                "is an annotation or a value of the original's own code; a user's code has no use"
                " for it",
                "rclpy.action.client: ClientGoalHandleDict",
                "rclpy.action.server: RCLError ServerGoalHandleDict",
                "rclpy.clock: TimeJumpDictionary",
                "rclpy.event_handler: QoSPublisherEventType QoSSubscriptionEventType",
                "rclpy.lifecycle.node: CallbackNames CreateLifecyclePublisherArgs"
                " LifecycleNodeArgs",
                "rclpy.qos: DeadlineBestAvailable LivelinessLeaseDurationeBestAvailable"
                " QoSPolicyEnum*",
                "rclpy.qos_overriding_options: QoSProfileAttributes QosCallbackType",
                "rclpy.node.Node: PARAM_REL_TOL",
                "rclpy.timer: TimerInfo*",
                "ament_index_python.resources: Set",
                "launch.launch_description_sources.frontend_launch_file_utilities:"
                " InvalidFrontendLaunchFileError",
                "launch_ros.utilities.namespace_utils: OptionalText",
                "tf2_ros: DEFAULT_CAN_TRANSFORM_POLLING_SCALE",
                "tf2_ros.buffer: DEFAULT_CAN_TRANSFORM_POLLING_SCALE",
                "sensor_msgs_py.point_cloud2: DUMMY_FIELD_PREFIX",
                "rclpy.utilities: g_context_lock g_default_context",
            ),
            *_of(
                "is rclpy.init's own; call rclpy.init, with the same arguments",
                "rclpy.InitContextManager: (args) (domain_id) (signal_handler_options)",
            ),
            *_of(
                "has no use here: rclpy.init handles SIGINT and SIGTERM, and does not with"
                " signal_handler_options=SignalHandlerOptions.NO",
                "rclpy: install_signal_handlers uninstall_signal_handlers",
                "rclpy.signals: install_signal_handlers uninstall_signal_handlers"
                " get_current_signal_handlers_options",
            ),
            *_of(
                _WAIT,
                "rclpy.action.client.ActionClient: add_to_wait_set execute get_num_entities"
                " is_ready take_data",
                "rclpy.action.server.ActionServer: add_to_wait_set execute get_num_entities"
                " is_ready notify_execute notify_goal_done take_data",
                "rclpy.event_handler: EventHandler* QoSEventHandler*",
                "rclpy.event_handler.PublisherEventCallbacks: create_event_handlers",
                "rclpy.event_handler.SubscriptionEventCallbacks: create_event_handlers",
                "rclpy.executors: ConditionReachedException TimeoutObject* WaitableEntityType"
                " await_or_execute",
                "rclpy.executors.Executor: can_execute wait_for_ready_callbacks",
                "rclpy.node.Node: add_waitable remove_waitable waitables",
                "rclpy.task.Task: executing",
            ),
            *_of(
                "is the inside of rclpy.logging; use rclpy.logging.get_logger and set_logger_level",
                "rclpy.logging: clear_config get_logging_directory initialize shutdown",
                "rclpy.context.Context.init: (initialize_logging)",
            ),
            *_of(
                "is the inside of rclpy.parameter_client; use"
                " rclpy.parameter_event_handler.ParameterEventHandler",
                "rclpy.parameter_client.AsyncParameterClient: on_parameter_event",
            ),
            *_of(
                _BY_POSITION,
                "rclpy.action.server.ActionServer.register_handle_accepted_callback:"
                " (handle_accepted_callback)",
                "rclpy.exceptions.InvalidParameterException: (parameter) (parameter_name)",
                "rclpy.exceptions.InvalidParameterTypeException: (desired_parameter)"
                " (expected_type)",
                "rclpy.exceptions.NotInitializedException: (message)",
                "rclpy.exceptions.ParameterImmutableException: (parameter) (parameter_name)",
                "rclpy.exceptions.ParameterUninitializedException: (parameter_name)",
                *(
                    f"launch_pytest.tools.{where}{kind}{sync}: (execute_process_action)"
                    for where in ("", "process.")
                    for kind in (
                        *("wait_for_exit", "wait_for_output", "wait_for_start"),
                        *("wait_for_stderr", "assert_output", "assert_stderr"),
                    )
                    for sync in ("", "_sync")
                ),
                "launch.utilities.type_utils.is_normalized_substitution: (x)",
                "launch.utilities.type_utils.is_substitution: (x)",
                "launch_testing.pytest.hooks.LaunchTestFailure: (message)",
                "launch_testing.pytest.hooks.pytest_pycollect_makemodule: (path)",
                "nav2_common.launch.ParseMultiRobotPose: (target_argument)",
                "nav2_common.launch.parse_multirobot_pose.ParseMultiRobotPose: (target_argument)",
                "sensor_msgs_py.point_cloud2.create_cloud: (point_step)",
            ),
            *_of(
                _LEFT_OUT,
                "launch_pytest.plugin.pytest_collection_modifyitems: (config) (session)",
                "message_filters.ApproximateTimeSynchronizer: (reset)",
                "message_filters.TimeSynchronizer: (reset)",
                "rclpy.executors.MultiThreadedExecutor.shutdown: (wait_for_threads)",
            ),
            *_of(
                "is not read: the package is that of the MoveItConfigs; build those for the"
                " package instead",
                "moveit_configs_utils.launches.generate_demo_launch: (launch_package_path)",
            ),
            *_of(
                "is not taken: write the type into the controller manager's parameters,"
                " CONTROLLER.type",
                "controller_manager.launch_utils.generate_controllers_spawner_launch_description:"
                " (controller_type)",
                "controller_manager.launch_utils.generate_load_controller_launch_description:"
                " (controller_type)",
            ),
            *_of(
                "is not taken: give the dotted keys of the values in param_rewrites; the written"
                " file is a temporary one",
                "nav2_common.launch.rewritten_yaml.RewrittenYaml: (out_dir) (value_rewrites)",
                "nav2_common.launch.RewrittenYaml: (out_dir) (value_rewrites)",
            ),
            *_of(
                "tells names in the middleware's own form, which Gazelle's graph has not",
                "rclpy.node.Node.get_publishers_info_by_topic: (no_mangle)",
                "rclpy.node.Node.get_subscriptions_info_by_topic: (no_mangle)",
            ),
            *_of(
                "completes words on the command line; gazelle's own commands do so themselves",
                "ament_index_python.cli: resource_name_completer resource_type_completer",
            ),
            *_of(
                _GRAMMAR,
                "launch.frontend.parse_substitution: ExtractSubstitution* get_grammar_path",
            ),
            *_of(
                "is the inside of launch; handlers are launch.event_handlers.OnShutdown and its"
                " like",
                "launch.event_handlers.on_shutdown: gen_handler",
                "launch.launch_introspector: indent tree_like_indent",
                "launch_ros.actions.lifecycle_transition: match_node_name_goal"
                " match_node_name_start_goal",
                "launch_ros.utilities: evaluate_parameters_dict normalize_parameters_dict",
            ),
            *_of(
                _EXTENSION,
                "launch_ros.actions.node: g_entry_points_impl get_extensions instantiate_extension",
            ),
            *_of(
                _PLUGIN,
                "launch_pytest.plugin: LaunchTestWarning from_parent generate_test_items get_*"
                " has_shutdown_kwarg is_* iterate_ready_to_test_actions need_shutdown_test_item"
                " run_until_complete transfer_markers wrap_*",
                "launch_pytest.tools.process: register_event_handler",
            ),
            *_of(
                _TESTS,
                "launch_testing.asserts.assert_exit_codes: EXIT_FORCED",
                "launch_testing.junitxml: unittestCaseToXml unittestResultToXml",
                "launch_testing.launch_test: parse_arguments",
                "launch_testing.loader: slim_formatwarning",
                "launch_testing.pytest.hooks: LaunchTestFailureRepr* find_launch_test_entrypoint",
                "launch_testing.pytest.hooks.LaunchTestModule: makeitem",
                "launch_testing.tools.output: get_default_filtered_*",
            ),
            *_of(
                _FILTER,
                "message_filters.ApproximateTimeSynchronizer.add: (my_queue) (my_queue_index)",
                "message_filters.Cache: connectInput getLatestTime",
                "message_filters.Subscriber: callback",
                "message_filters.TimeSynchronizer: connectInput",
                "message_filters.TimeSynchronizer.add: (my_queue) (my_queue_index)",
            ),
            *_of(
                _REWRITE,
                "nav2_common.launch.replace_string.ReplaceString: replace resolve_replacements",
                "nav2_common.launch.rewritten_yaml: DictItemReference* YamlValue",
                "nav2_common.launch.rewritten_yaml.RewrittenYaml: add_params convert"
                " getYamlLeafKeys pathify resolve_rewrites substitute_keys"
                " substitute_params substitute_values updateYamlPathVals",
            ),
            *_of(
                _NAV2,
                "nav2_simple_commander.robot_navigator.BasicNavigator: assistedTeleop"
                " clearCostmapAroundPose clearCostmapAroundRobot clearCostmapExceptRegion"
                " clearGlobalCostmapAroundPose clearLocalCostmapAroundPose dockRobotByID"
                " dockRobotByPose followGpsWaypoints followObjectByFrame followObjectByTopic"
                " getAndTrackRoute getRoute smoothPath toggleCollisionMonitor undockRobot",
            ),
            *_of(
                "keeps the state of Nav2's newer actions; getResult, isTaskComplete and"
                " getFeedback of BasicNavigator tell the same",
                "nav2_simple_commander.robot_navigator: RunningTask*",
                "nav2_simple_commander.robot_navigator.BasicNavigator: clearPreviousState"
                " getTaskError setTaskError",
            ),
            *_of(
                _NAV2_KEYWORD,
                *(
                    f"nav2_simple_commander.robot_navigator.BasicNavigator.{method}: {keywords}"
                    for method, keywords in {
                        "backup": "(disable_collision_checks)",
                        "driveOnHeading": "(disable_collision_checks)",
                        "spin": "(disable_collision_checks)",
                        "followPath": "(path_handler_id) (progress_checker_id)",
                        "followWaypoints": "(goal_index) (number_of_loops)",
                        "getFeedback": "(task)",
                        "isTaskComplete": "(task)",
                    }.items()
                ),
            ),
            *_of(
                "is the generator of ros_gz_bridge's C++ code; ros2 run ros_gz_bridge"
                " parameter_bridge bridges",
                "ros_gz_bridge: MAPPINGS* MessageMapping* generate_cpp generate_test_cpp",
            ),
            *_of(
                _BAG,
                "rosbag2_py: CompressionMode CompressionOptions LocalMessageDefinitionSource"
                " MessageDefinition MetadataIo PlayOptions Player ReadOrder ReadOrderSortBy"
                " RecordOptions Recorder SequentialCompressionReader SequentialCompressionWriter"
                " ServiceRequestsSource bag_rewrite compression_mode_* "
                " convert_rclcpp_qos_to_rclpy_qos to_rclcpp_qos_vector",
            ),
            *_of(
                "is the inside of rosidl_runtime_py; use rosidl_runtime_py.utilities.get_message,"
                " get_service and get_action",
                "rosidl_runtime_py: get_interface_path get_message_slot_types"
                " import_message_from_namespaced_type",
                "rosidl_runtime_py.convert: get_message_slot_types",
                "rosidl_runtime_py.get_interfaces: get_interface_path",
                "rosidl_runtime_py.utilities: get_*namespaced_type",
            ),
            *_of(
                _LISTENER,
                "tf2_ros: BufferClient FrameGraphSrv* LookupTransform* MsgStamped PKG PyKDLType"
                " Stamped TransformableObject*",
                "tf2_ros.buffer: FrameGraphSrv*",
                "tf2_ros.buffer.Buffer: time_jump_callback",
                "tf2_ros.buffer_interface: MsgStamped PyKDLType Stamped TransformableObject*",
                "tf2_ros.buffer_interface.BufferInterface: can_transform can_transform_full",
                "tf2_ros.buffer_interface.TransformRegistration: print_me",
                "tf2_ros.transform_listener.TransformListener: callback check_for_reset"
                " static_callback",
            ),
            *_of(
                "calls the controller manager's services from Python; call them with rclpy"
                " (/controller_manager/load_controller, switch_controller, list_controllers), or"
                " run ros2 control",
                "controller_manager: bcolors cleanup_controller configure_controller"
                " get_parameter_from_param_files list_* load_controller"
                " reload_controller_libraries set_* switch_controllers unload_controller",
            ),
            *(row for reason, owners in ROS1_GROUPS for row in _of(reason, *owners)),
        ]
    )
)
