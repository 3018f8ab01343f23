#pragma once

#include "rclcpp/generic_publisher.hpp"
