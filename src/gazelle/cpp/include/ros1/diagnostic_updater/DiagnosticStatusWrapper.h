#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstdarg>
#include <cstdio>
#include <functional>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace diagnostic_updater {

using Status = diagnostic_msgs::DiagnosticStatus;
using KeyValue = diagnostic_msgs::KeyValue;

#include "gazelle/diagnostics/status_wrapper.inc"

}  // namespace diagnostic_updater
