#pragma once

#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
