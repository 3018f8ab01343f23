#pragma once
#include <ros/macros.h>
#define IMAGE_TRANSPORT_DECL ROS_HELPER_EXPORT
