#pragma once

#include "ament_index_cpp/get_resource.hpp"
