#pragma once

#include "rclcpp/type_adapter.hpp"
