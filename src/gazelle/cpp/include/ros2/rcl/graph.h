#pragma once

#include "rcl/handles.h"
#include "rmw/topic_endpoint_info.h"
