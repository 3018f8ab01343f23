#pragma once

#include <ros/macros.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ros {
namespace package {

typedef std::vector<std::string> V_string;
typedef std::map<std::string, std::string> M_string;

/// Runs a command as rospack would and gives back what it printed.
ROSLIB_DECL std::string command(const std::string& command);
ROSLIB_DECL void command(const std::string& command, V_string& output);
/// The folder of a package; empty where there is none.
ROSLIB_DECL std::string getPath(const std::string& package);
ROSLIB_DECL bool getAll(V_string& packages);
/// What packages that depend on this one export for it: (package, value of the attribute).
ROSLIB_DECL void getPlugins(const std::string& package, const std::string& attribute,
                            V_string& plugins, bool force_recrawl = false);
ROSLIB_DECL void getPlugins(const std::string& package, const std::string& attribute,
                            M_string& plugins, bool force_recrawl = false);

}  // namespace package
}  // namespace ros
