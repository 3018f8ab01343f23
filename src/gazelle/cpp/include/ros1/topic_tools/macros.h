#pragma once
#include <ros/macros.h>
#define TOPIC_TOOLS_DECL ROS_HELPER_EXPORT
