#pragma once
#include "kdl/chain.hpp"
#include "kdl/jntarray.hpp"
#include "kdl/tree.hpp"
