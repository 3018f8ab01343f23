#pragma once
#include "tf/LinearMath/Transform.h"
