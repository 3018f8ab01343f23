#pragma once
#include "tf2_ros/visibility_control.h"
