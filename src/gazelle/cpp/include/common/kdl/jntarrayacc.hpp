#pragma once
#include "kdl/jntarrayvel.hpp"
