#pragma once

#include "moveit/utils/moveit_error_code.hpp"
