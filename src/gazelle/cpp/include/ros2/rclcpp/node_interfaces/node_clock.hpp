#pragma once

#include "rclcpp/node_interfaces/node_clock_interface.hpp"
