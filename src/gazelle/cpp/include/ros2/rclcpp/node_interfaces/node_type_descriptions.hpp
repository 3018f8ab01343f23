#pragma once

#include "rclcpp/node_interfaces/node_type_descriptions_interface.hpp"
