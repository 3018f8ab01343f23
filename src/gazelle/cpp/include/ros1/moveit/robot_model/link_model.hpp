#pragma once

#include "gazelle/moveit/robot_model.hpp"
