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

#include "sensor_msgs/CameraInfo.h"

#define GAZELLE_CAMERA_INFO ::sensor_msgs::CameraInfo
#define GAZELLE_CAMERA_INFO_PTR ::sensor_msgs::CameraInfoConstPtr
#define GAZELLE_STAMP ros::Time
#define GAZELLE_D D
#define GAZELLE_K K
#define GAZELLE_R R
#define GAZELLE_P P
#include "gazelle/pinhole_camera.inc"
#undef GAZELLE_P
#undef GAZELLE_R
#undef GAZELLE_K
#undef GAZELLE_D
#undef GAZELLE_STAMP
#undef GAZELLE_CAMERA_INFO_PTR
#undef GAZELLE_CAMERA_INFO
