#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/spinner.h>

namespace ros {

namespace init_options {
/// Flags of ros::init().
enum InitOption {
  NoSigintHandler = 1 << 0,
  AnonymousName = 1 << 1,
  NoRosout = 1 << 2,
};
}  // namespace init_options
typedef init_options::InitOption InitOption;

/// Gives the process its name; takes the arguments that are ROS' out of argv.
ROSCPP_DECL void init(int& argc, char** argv, const std::string& name, uint32_t options = 0);
ROSCPP_DECL void init(const M_string& remappings, const std::string& name, uint32_t options = 0);
ROSCPP_DECL void init(const VP_string& remapping_args, const std::string& name,
                      uint32_t options = 0);

ROSCPP_DECL bool isInitialized();
ROSCPP_DECL bool isShuttingDown();
ROSCPP_DECL bool isStarted();
ROSCPP_DECL bool ok();

ROSCPP_DECL void spin();
ROSCPP_DECL void spin(Spinner& spinner);
ROSCPP_DECL void spinOnce();
ROSCPP_DECL void waitForShutdown();

/// Opens the node in the graph; the first NodeHandle does it by itself.
ROSCPP_DECL void start();
ROSCPP_DECL void shutdown();
/// Asks for the end, from wherever; the thread that spins does it.
ROSCPP_DECL void requestShutdown();

ROSCPP_DECL CallbackQueue* getGlobalCallbackQueue();
ROSCPP_DECL CallbackQueue* getInternalCallbackQueue();

ROSCPP_DECL std::string getROSArg(int argc, const char* const* argv, const std::string& arg);
ROSCPP_DECL void removeROSArgs(int argc, const char* const* argv, V_string& args_out);
ROSCPP_DECL const std::string& getDefaultMasterURI();

}  // namespace ros
