#pragma once

#include "rcl/types.h"
#include "rcutils/logging.h"
