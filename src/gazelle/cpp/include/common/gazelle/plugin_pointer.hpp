#pragma once

#include <memory>

namespace gazelle {
// What class_loader and pluginlib hand out in this generation of ROS.
template <class T>
using PluginPointer = std::shared_ptr<T>;
}  // namespace gazelle
