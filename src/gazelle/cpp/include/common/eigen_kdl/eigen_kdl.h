#pragma once
#include "tf2_eigen_kdl/tf2_eigen_kdl.hpp"
