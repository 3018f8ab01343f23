// What nearly every node of ROS 1 includes, compiled once.
#pragma once

#include <ros/ros.h>
