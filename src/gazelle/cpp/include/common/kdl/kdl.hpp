// The whole of KDL that is here.
#pragma once

#include "kdl/solvers.hpp"
