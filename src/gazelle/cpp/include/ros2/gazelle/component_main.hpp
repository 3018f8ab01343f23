// The program of one component (rclcpp_components_register_node).
#pragma once

namespace gazelle {

/// Make a component of this process' libraries by its name and run it until the end.
int component_main(int argc, char** argv, const char* plugin, const char* executor);

}  // namespace gazelle
