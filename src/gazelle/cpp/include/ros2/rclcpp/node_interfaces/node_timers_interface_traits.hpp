#pragma once

#include "rclcpp/detail/interface_traits.hpp"
