#pragma once
#include <ros/macros.h>
#define ROSBAG_DECL ROS_HELPER_EXPORT
#define ROSBAG_STORAGE_DECL ROS_HELPER_EXPORT
