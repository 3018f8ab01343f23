#pragma once

#include "pluginlib/class_desc.hpp"
