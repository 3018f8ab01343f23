#pragma once

#include "rclcpp/detail/interface_of.hpp"
