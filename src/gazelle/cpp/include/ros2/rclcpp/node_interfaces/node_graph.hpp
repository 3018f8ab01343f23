#pragma once

#include "rclcpp/node_interfaces/node_graph_interface.hpp"
