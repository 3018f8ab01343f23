#pragma once

#include "moveit_visual_tools/moveit_visual_tools.h"
