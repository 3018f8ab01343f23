#pragma once
#include "kdl/jntarray.hpp"
