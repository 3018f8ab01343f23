#pragma once
#include <ros/macros.h>
#define CPP_COMMON_DECL ROS_HELPER_EXPORT
