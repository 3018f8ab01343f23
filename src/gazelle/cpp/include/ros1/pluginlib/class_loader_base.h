#pragma once

#include "pluginlib/class_loader_base.hpp"
