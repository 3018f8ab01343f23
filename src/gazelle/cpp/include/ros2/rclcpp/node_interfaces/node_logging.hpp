#pragma once

#include "rclcpp/node_interfaces/node_logging_interface.hpp"
