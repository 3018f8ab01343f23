#pragma once

#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
