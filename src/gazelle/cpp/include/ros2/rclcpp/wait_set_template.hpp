#pragma once

#include "rclcpp/wait_set.hpp"
