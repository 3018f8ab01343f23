#pragma once

#include "moveit/planning_scene_interface/planning_scene_interface.hpp"
