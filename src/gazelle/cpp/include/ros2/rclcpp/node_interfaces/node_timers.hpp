#pragma once

#include "rclcpp/node_interfaces/node_timers_interface.hpp"
