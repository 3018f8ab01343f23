#pragma once

#include "rclcpp/node_interfaces/node_time_source_interface.hpp"
