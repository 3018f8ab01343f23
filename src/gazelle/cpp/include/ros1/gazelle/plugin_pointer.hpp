#pragma once

#include <boost/shared_ptr.hpp>

namespace gazelle {
// What class_loader and pluginlib hand out in this generation of ROS.
template <class T>
using PluginPointer = boost::shared_ptr<T>;
}  // namespace gazelle
