#pragma once

#include "rcl/handles.h"
