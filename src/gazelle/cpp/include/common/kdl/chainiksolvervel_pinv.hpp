#pragma once
#include "kdl/solvers.hpp"
