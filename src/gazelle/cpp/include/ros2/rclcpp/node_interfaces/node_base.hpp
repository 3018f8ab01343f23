#pragma once

#include "rclcpp/node_interfaces/node_base_interface.hpp"
