#pragma once

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/function_traits.hpp"
