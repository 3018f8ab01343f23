#pragma once

#include "moveit/move_group_interface/move_group_interface.hpp"
