#pragma once

#include "rmw/types.h"

#define RMW_TOPIC_VALID 0
