#pragma once
#include <ros/macros.h>
#define ACTIONLIB_DECL ROS_HELPER_EXPORT
