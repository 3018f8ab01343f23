#pragma once
#include "kdl/chain.hpp"
