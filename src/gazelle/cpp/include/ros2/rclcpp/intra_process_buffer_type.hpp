#pragma once

#include "rclcpp/detail/endpoint_options.hpp"
