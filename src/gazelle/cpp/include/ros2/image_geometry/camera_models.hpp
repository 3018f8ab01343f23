// Cameras' geometry; wants OpenCV.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "sensor_msgs/msg/camera_info.hpp"

#define GAZELLE_CAMERA_INFO ::sensor_msgs::msg::CameraInfo
#define GAZELLE_CAMERA_INFO_PTR ::sensor_msgs::msg::CameraInfo::ConstSharedPtr
#define GAZELLE_STAMP builtin_interfaces::msg::Time
#define GAZELLE_D d
#define GAZELLE_K k
#define GAZELLE_R r
#define GAZELLE_P p
#include "gazelle/pinhole_camera.inc"
#undef GAZELLE_P
#undef GAZELLE_R
#undef GAZELLE_K
#undef GAZELLE_D
#undef GAZELLE_STAMP
#undef GAZELLE_CAMERA_INFO_PTR
#undef GAZELLE_CAMERA_INFO
