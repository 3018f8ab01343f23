#pragma once
#include "image_geometry/camera_models.hpp"
