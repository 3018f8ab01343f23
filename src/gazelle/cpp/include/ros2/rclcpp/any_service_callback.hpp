#pragma once

#include "rclcpp/service.hpp"
