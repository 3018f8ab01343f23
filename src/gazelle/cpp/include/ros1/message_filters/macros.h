#pragma once
#include <ros/macros.h>
#define MESSAGE_FILTERS_DECL ROS_HELPER_EXPORT
