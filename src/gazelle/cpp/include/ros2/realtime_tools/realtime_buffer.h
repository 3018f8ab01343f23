#pragma once

#include "gazelle/realtime/realtime_buffer.hpp"
