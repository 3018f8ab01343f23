#pragma once
#include <ros/macros.h>
#define NODELETLIB_DECL ROS_HELPER_EXPORT
