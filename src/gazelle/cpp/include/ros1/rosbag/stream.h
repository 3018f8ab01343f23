#pragma once
#include <rosbag/constants.h>
