#pragma once

#include "rcl/allocator.h"
#include "rcl/error_handling.h"
#include "rcl/handles.h"
#include "rcl/logging.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rcl/types.h"
