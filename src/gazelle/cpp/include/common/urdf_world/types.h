#pragma once

#include "urdf_model/types.h"
