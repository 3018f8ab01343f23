#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "interactive_markers/interactive_marker_server.hpp"

namespace interactive_markers {

#include "gazelle/interactive_markers/menu_handler.inc"

}  // namespace interactive_markers
