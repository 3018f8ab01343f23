#pragma once

#include "rcutils/env.h"
