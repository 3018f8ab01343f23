#pragma once

#include <pr2_controller_interface/controller.h>
