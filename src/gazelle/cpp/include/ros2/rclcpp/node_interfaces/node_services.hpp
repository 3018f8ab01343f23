#pragma once

#include "rclcpp/node_interfaces/node_services_interface.hpp"
