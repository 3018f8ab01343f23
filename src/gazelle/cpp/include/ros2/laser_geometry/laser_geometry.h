#pragma once
#include "laser_geometry/laser_geometry.hpp"
