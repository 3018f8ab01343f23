// What nearly every node of ROS 2 includes, compiled once.
#pragma once

#include <rclcpp/rclcpp.hpp>
