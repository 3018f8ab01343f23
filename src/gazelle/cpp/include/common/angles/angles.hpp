#pragma once
#include "angles/angles.h"
