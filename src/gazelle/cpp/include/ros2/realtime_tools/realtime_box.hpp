#pragma once

#include "gazelle/realtime/realtime_box.hpp"
