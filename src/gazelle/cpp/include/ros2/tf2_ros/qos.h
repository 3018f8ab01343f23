#pragma once
#include "tf2_ros/qos.hpp"
