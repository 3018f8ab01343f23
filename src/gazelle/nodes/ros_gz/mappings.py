"""Which messages of ROS and Gazebo stand for each other (the table in ros_gz_bridge's README)."""

from __future__ import annotations

from gazelle.diagnostics import did_you_mean

__all__ = ["bare_type", "full_ros_type", "is_pair", "pair_error"]

_SPACES = ("gz.msgs.", "ignition.msgs.", "gz::msgs::")
_PAIRS = """
actuator_msgs/Actuators Actuators
builtin_interfaces/Time Time
geometry_msgs/Point Vector3d
geometry_msgs/Pose Pose
geometry_msgs/PoseArray Pose_V
geometry_msgs/PoseStamped Pose
geometry_msgs/PoseWithCovariance PoseWithCovariance
geometry_msgs/PoseWithCovarianceStamped PoseWithCovariance
geometry_msgs/Quaternion Quaternion
geometry_msgs/Transform Pose
geometry_msgs/TransformStamped Pose
geometry_msgs/Twist Twist
geometry_msgs/TwistStamped Twist
geometry_msgs/TwistWithCovariance TwistWithCovariance
geometry_msgs/TwistWithCovarianceStamped TwistWithCovariance
geometry_msgs/Vector3 Vector3d
geometry_msgs/Wrench Wrench
geometry_msgs/WrenchStamped Wrench
gps_msgs/GPSFix NavSat
nav_msgs/Odometry Odometry OdometryWithCovariance
rcl_interfaces/ParameterValue Any
ros_gz_interfaces/Altimeter Altimeter
ros_gz_interfaces/Contact Contact
ros_gz_interfaces/Contacts Contacts
ros_gz_interfaces/Dataframe Dataframe
ros_gz_interfaces/Entity Entity
ros_gz_interfaces/EntityWrench EntityWrench
ros_gz_interfaces/Float32Array Float_V
ros_gz_interfaces/GuiCamera GUICamera
ros_gz_interfaces/JointWrench JointWrench
ros_gz_interfaces/Light Light
ros_gz_interfaces/ParamVec Param Param_V
ros_gz_interfaces/SensorNoise SensorNoise
ros_gz_interfaces/StringVec StringMsg_V
ros_gz_interfaces/TrackVisual TrackVisual
ros_gz_interfaces/VideoRecord VideoRecord
rosgraph_msgs/Clock Clock
sensor_msgs/BatteryState BatteryState
sensor_msgs/CameraInfo CameraInfo
sensor_msgs/FluidPressure FluidPressure
sensor_msgs/Image Image
sensor_msgs/Imu IMU
sensor_msgs/JointState Model
sensor_msgs/Joy Joy
sensor_msgs/LaserScan LaserScan
sensor_msgs/MagneticField Magnetometer
sensor_msgs/NavSatFix NavSat
sensor_msgs/PointCloud2 PointCloudPacked
std_msgs/Bool Boolean
std_msgs/ColorRGBA Color
std_msgs/Empty Empty
std_msgs/Float32 Float
std_msgs/Float64 Double
std_msgs/Header Header
std_msgs/Int32 Int32
std_msgs/String StringMsg
std_msgs/UInt32 UInt32
tf2_msgs/TFMessage Pose_V
trajectory_msgs/JointTrajectory JointTrajectory
vision_msgs/Detection2D AnnotatedAxisAligned2DBox
vision_msgs/Detection2DArray AnnotatedAxisAligned2DBox_V
vision_msgs/Detection3D AnnotatedOriented3DBox
vision_msgs/Detection3DArray AnnotatedOriented3DBox_V
"""
_BY_ROS = {
    name.replace("/", "/msg/"): frozenset(others)
    for name, *others in map(str.split, _PAIRS.strip().splitlines())
}


def full_ros_type(name: str) -> str:
    """Return ``pkg/msg/Name`` of a type that may be written ``pkg/Name``."""
    package, _, rest = name.partition("/")
    return name if "/" in rest else f"{package}/msg/{rest}"


def bare_type(gz_type: str) -> str:
    """Return a type of Gazebo without ``gz.msgs.`` or ``ignition.msgs.``."""
    return next((gz_type.removeprefix(one) for one in _SPACES if gz_type.startswith(one)), gz_type)


def is_pair(ros_type: str, gz_type: str) -> bool:
    """Tell whether ros_gz_bridge has a bridge between two types."""
    return bare_type(gz_type) in _BY_ROS.get(full_ros_type(ros_type), ())


def pair_error(ros_type: str, gz_type: str) -> str:
    """Return what is wrong with a pair that has no bridge."""
    known = _BY_ROS.get(full_ros_type(ros_type))
    if known is not None:
        hint = f"{ros_type} goes with {' or '.join(f'gz.msgs.{one}' for one in sorted(known))}"
    else:
        others = [ros for ros, names in _BY_ROS.items() if bare_type(gz_type) in names]
        near = did_you_mean(full_ros_type(ros_type), _BY_ROS)
        hint = f"{gz_type} goes with {' or '.join(others)}" if others else near
    text = f"no bridge between [{ros_type}] and [{gz_type}]; {hint}".rstrip("; ")
    return f"{text}\n  ROS says: No template specialization for the pair"
