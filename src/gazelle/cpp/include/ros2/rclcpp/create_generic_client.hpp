#pragma once

#include "rclcpp/generic_client.hpp"
