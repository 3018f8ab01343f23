#pragma once
#include "tf2/visibility_control.h"
