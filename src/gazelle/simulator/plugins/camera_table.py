"""Names, keys and topics of the camera and depth camera plug-ins."""

from __future__ import annotations

import math
from dataclasses import replace

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.plugin_parameters import PluginTable

__all__ = ["CAMERA_TABLE", "DEPTH_TABLE", "OPENNI_TABLE", "TRIGGERED_TABLE"]

_COMMON = (
    Parameter("robotNamespace", "text", "", "namespace of all topics", ros_versions=(1,)),
    Parameter("cameraName", "text", "", "namespace within it", "", aliases=("camera_name",)),
    Parameter("frameName", "text", "/world", "frame of the data", "", aliases=("frame_name",)),
    Parameter(
        "updateRate",
        "number",
        0.0,
        "largest publish rate, 0 for the sensor's",
        "Hz",
        aliases=("update_rate",),
        ros_versions=(1,),
    ),
    Parameter(
        "hackBaseline", "number", 0.0, "stereo baseline in P[3]", "m", aliases=("hack_baseline",)
    ),
    Parameter(
        "focalLength",
        "number",
        0.0,
        "fx = fy of camera_info, 0 computes it",
        "px",
        aliases=("focal_length",),
    ),
    Parameter("Cx", "number", 0.0, "principal point, 0 is (width + 1)/2", "px", aliases=("cx",)),
    Parameter("Cy", "number", 0.0, "principal point, 0 is (height + 1)/2", "px", aliases=("cy",)),
    Parameter("distortionK1", "number", 0.0, "camera_info only, as in Gazebo"),
    Parameter("distortionK2", "number", 0.0, "camera_info only, as in Gazebo"),
    Parameter("distortionK3", "number", 0.0, "camera_info only, as in Gazebo"),
    Parameter("distortionT1", "number", 0.0, "camera_info only, as in Gazebo"),
    Parameter("distortionT2", "number", 0.0, "camera_info only, as in Gazebo"),
    Parameter("autoDistortion", "flag", False, "camera_info's D from the sensor's <distortion>"),
    Parameter("CxPrime", "refused", "", "no release of the plug-in publishes it"),
    Parameter(
        "borderCrop",
        "refused",
        "",
        "the renderer distorts the whole picture",
        "",
        aliases=("border_crop",),
    ),
    Parameter("alwaysOn", "refused", "", "pictures are rendered while somebody subscribes"),
    Parameter("baseline", "refused", "", "no release of the plug-in reads it"),
    Parameter(
        "triggerTopicName",
        "text",
        "image_trigger",
        "of the triggered camera (ROS 1)",
        ros_versions=(1,),
    ),
    Parameter("rightFrameName", "refused", "", "no release of the plug-in reads it"),
)
_DEPTH = (
    Parameter("imageTopicName", "text", "ir/image_raw", "colour picture"),
    Parameter("cameraInfoTopicName", "text", "ir/camera_info", "its camera_info"),
    Parameter("depthImageTopicName", "text", "depth/image_raw", "depth picture"),
    Parameter("depthImageCameraInfoTopicName", "text", "depth/camera_info", "its camera_info"),
    Parameter("pointCloudTopicName", "text", "points", "cloud"),
    Parameter(
        "pointCloudCutoff", "number", 0.4, "nearest depth that is kept", "m", aliases=("min_depth",)
    ),
    Parameter("useDepth16UC1Format", "flag", False, "depth as 16UC1 millimetres"),
)
_RECONFIGURE = Topic(
    "{cameraName}/set_parameters", "dynamic_reconfigure/srv/Reconfigure", kind="service"
)
_SET_INFO = Topic("{cameraName}/set_camera_info", "sensor_msgs/srv/SetCameraInfo", kind="service")
_DEPTH_TOPICS = (
    Topic(
        "{cameraName}/{imageTopicName}",
        "sensor_msgs/msg/Image",
        rate="sensor's `update_rate`",
        frame="`frameName`",
    ),
    Topic(
        "{cameraName}/{cameraInfoTopicName}",
        "sensor_msgs/msg/CameraInfo",
        rate="sensor's `update_rate`",
        frame="`frameName`",
    ),
    Topic(
        "{cameraName}/{depthImageTopicName}",
        "sensor_msgs/msg/Image",
        rate="sensor's `update_rate`",
        frame="`frameName`",
    ),
    Topic(
        "{cameraName}/{depthImageCameraInfoTopicName}",
        "sensor_msgs/msg/CameraInfo",
        rate="sensor's `update_rate`",
        frame="`frameName`",
    ),
    Topic(
        "{cameraName}/{pointCloudTopicName}",
        "sensor_msgs/msg/PointCloud2",
        rate="sensor's `update_rate`",
        frame="`frameName`",
    ),
    Topic("{cameraName}/parameter_updates", "dynamic_reconfigure/msg/Config", rate="latched"),
    Topic(
        "{cameraName}/parameter_descriptions",
        "dynamic_reconfigure/msg/ConfigDescription",
        rate="latched",
    ),
)
_CLOUD = (
    "Depth is 32FC1, planar z in metres, NaN outside the cutoffs; the cloud is x y z at 0, 4, 8"
    " and rgb at 16 of 32 bytes, with the colour bytes in the order readers expect (B, G, R).",
)

CAMERA_TABLE = PluginTable(
    ParameterTable(
        "camera",
        "Publishes the pictures of the camera it stands in; in ROS 2 of depth cameras too.",
        ("gazebo_ros_camera", "gazebo_ros_prosilica"),
        (
            *_COMMON,
            Parameter("imageTopicName", "text", "image_raw", "picture", ros_versions=(1,)),
            Parameter(
                "cameraInfoTopicName", "text", "camera_info", "camera_info", ros_versions=(1,)
            ),
            Parameter(
                "min_depth", "number", 0.4, "nearest depth that is kept", "m", ros_versions=(2,)
            ),
            Parameter(
                "max_depth",
                "number",
                math.inf,
                "farthest depth that is kept",
                "m",
                ros_versions=(2,),
            ),
            Parameter(
                "triggered",
                "flag",
                False,
                "a picture for each message on `{camera_name}/image_trigger`",
                ros_versions=(2,),
            ),
            Parameter("pollServiceName", "refused", "", "of prosilica; pictures are not polled"),
        ),
    ),
    topics=(
        Topic(
            "{cameraName}/{imageTopicName}",
            "sensor_msgs/msg/Image",
            rate="sensor's `update_rate`",
            frame="`frameName`",
            ros2="{camera_name}/image_raw",
        ),
        Topic(
            "{cameraName}/{imageTopicName}/compressed",
            "sensor_msgs/msg/CompressedImage",
            rate="sensor's `update_rate`",
            frame="`frameName`",
            ros2="{camera_name}/image_raw/compressed",
        ),
        Topic(
            "{cameraName}/{imageTopicName}/compressedDepth",
            "sensor_msgs/msg/CompressedImage",
            rate="depth pictures only",
            frame="`frameName`",
            ros2="{camera_name}/depth/image_raw/compressedDepth",
        ),
        Topic(
            "{cameraName}/{imageTopicName}/theora",
            "theora_image_transport/msg/Packet",
            rate="never",
        ),
        Topic(
            "{cameraName}/{cameraInfoTopicName}",
            "sensor_msgs/msg/CameraInfo",
            rate="sensor's `update_rate`",
            frame="`frameName`",
            ros2="{camera_name}/camera_info",
        ),
        *_DEPTH_TOPICS[5:],
        Topic(
            "{camera_name}/depth/image_raw, {camera_name}/depth/camera_info",
            "the same of depth cameras (ROS 2)",
            rate="sensor's `update_rate`",
            frame="`frame_name`",
        ),
        Topic(
            "{camera_name}/points",
            "sensor_msgs/msg/PointCloud2 of depth cameras (ROS 2)",
            rate="sensor's `update_rate`",
            frame="`frame_name`",
        ),
    ),
    services=(_SET_INFO, _RECONFIGURE),
    behaviour=(
        "`gazebo_ros_prosilica` streams, as in Gazebo unless `trigger_mode` is `polled`; pictures"
        " are not polled here.",
        "`compressed` is JPEG or PNG; `compressedDepth` encodes depth pictures; `theora` is listed"
        " as image_transport does and sends nothing.",
        "The sensor's `update_rate` governs; the plug-in's can only lower it.",
        "In ROS 2 `camera_name` is the sensor's name and `frame_name` the link's where they are"
        " absent, and only the sensor's rate counts.",
        "camera_info has the principal point at (size + 1)/2 as Gazebo's; the picture's is at"
        " (size - 1)/2.",
    ),
    in_both_ros=True,
)

TRIGGERED_TABLE = replace(
    CAMERA_TABLE,
    parameters=ParameterTable(
        "triggered_camera",
        "A camera that takes one picture for each message on its trigger topic (ROS 1).",
        ("gazebo_ros_triggered_camera",),
        CAMERA_TABLE.parameters.rows,
    ),
    in_both_ros=False,
    behaviour=(
        "Every trigger gives the picture of the next step; several give one after the other. In"
        " ROS 2 the camera plug-in does so with `triggered`.",
    ),
    topics=(
        Topic(
            "{cameraName}/{triggerTopicName}",
            "std_msgs/msg/Empty",
            rate="a trigger",
            kind="listens",
        ),
        *CAMERA_TABLE.topics,
    ),
)

OPENNI_TABLE = PluginTable(
    ParameterTable(
        "openni_kinect",
        "Colour, depth and cloud of the depth camera it stands in.",
        ("gazebo_ros_openni_kinect",),
        (
            *_COMMON,
            *_DEPTH,
            Parameter("pointCloudCutoffMax", "number", 5.0, "farthest depth that is kept", "m"),
        ),
    ),
    topics=_DEPTH_TOPICS,
    services=(_SET_INFO, _RECONFIGURE),
    behaviour=(
        *_CLOUD,
        "The sensor's `update_rate` governs; the plug-in's `updateRate` has no effect, as in"
        " Gazebo.",
        "camera_info is published even when it is the only topic subscribed.",
    ),
)

DEPTH_TABLE = PluginTable(
    ParameterTable(
        "depth_camera",
        "As openni_kinect, without a farthest depth.",
        ("gazebo_ros_depth_camera",),
        (
            *_COMMON,
            *_DEPTH,
            Parameter("reflectanceTopicName", "refused", "", "not published"),
            Parameter("normalsTopicName", "refused", "", "not published"),
            Parameter("reduceNormals", "refused", "", "normals are not published"),
        ),
    ),
    topics=_DEPTH_TOPICS,
    services=(_SET_INFO, _RECONFIGURE),
    behaviour=_CLOUD,
)
