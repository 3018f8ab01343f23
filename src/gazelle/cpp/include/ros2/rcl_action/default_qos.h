#pragma once

#include "rcl_action/types.h"
