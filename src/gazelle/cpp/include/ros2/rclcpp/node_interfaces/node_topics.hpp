#pragma once

#include "rclcpp/node_interfaces/node_topics_interface.hpp"
