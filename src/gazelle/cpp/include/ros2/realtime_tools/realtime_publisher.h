#pragma once

#include "realtime_tools/realtime_publisher.hpp"
