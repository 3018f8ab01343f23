// Logging for libraries without ROS: to standard error, or to a handler of the user's.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>
#include <utility>

namespace console_bridge {

enum LogLevel {
  CONSOLE_BRIDGE_LOG_DEBUG = 0,
  CONSOLE_BRIDGE_LOG_INFO,
  CONSOLE_BRIDGE_LOG_WARN,
  CONSOLE_BRIDGE_LOG_ERROR,
  CONSOLE_BRIDGE_LOG_NONE
};

class OutputHandler {
 public:
  virtual ~OutputHandler() = default;
  virtual void log(const std::string& text, LogLevel level, const char* filename, int line) = 0;
};

namespace impl {

struct State {
  OutputHandler* handler = nullptr;
  OutputHandler* before = nullptr;
  LogLevel level = CONSOLE_BRIDGE_LOG_WARN;
};
inline State& state() {
  static State only;
  return only;
}

}  // namespace impl

inline void setLogLevel(LogLevel level) { impl::state().level = level; }
inline LogLevel getLogLevel() { return impl::state().level; }
inline OutputHandler* getOutputHandler() { return impl::state().handler; }
inline void useOutputHandler(OutputHandler* handler) {
  impl::state().before = impl::state().handler;
  impl::state().handler = handler;
}
inline void restorePreviousOutputHandler() {
  std::swap(impl::state().before, impl::state().handler);
}
inline void noOutputHandler() { useOutputHandler(nullptr); }

__attribute__((format(printf, 4, 5))) inline void log(const char* file, int line, LogLevel level,
                                                      const char* message, ...) {
  if (level < impl::state().level) return;
  char text[1024];
  std::va_list arguments;
  va_start(arguments, message);
  std::vsnprintf(text, sizeof text, message, arguments);
  va_end(arguments);
  if (impl::state().handler != nullptr) {
    impl::state().handler->log(text, level, file, line);
    return;
  }
  static const char* const names[] = {"Debug:   ", "Info:    ", "Warning: ", "Error:   ", ""};
  std::fprintf(stderr, "%s%s\n         at line %d in %s\n", names[level], text, line, file);
}

}  // namespace console_bridge

#define CONSOLE_BRIDGE_logDebug(fmt, ...)                                                    \
  ::console_bridge::log(__FILE__, __LINE__, ::console_bridge::CONSOLE_BRIDGE_LOG_DEBUG, fmt, \
                        ##__VA_ARGS__)
#define CONSOLE_BRIDGE_logInform(fmt, ...)                                                  \
  ::console_bridge::log(__FILE__, __LINE__, ::console_bridge::CONSOLE_BRIDGE_LOG_INFO, fmt, \
                        ##__VA_ARGS__)
#define CONSOLE_BRIDGE_logWarn(fmt, ...)                                                    \
  ::console_bridge::log(__FILE__, __LINE__, ::console_bridge::CONSOLE_BRIDGE_LOG_WARN, fmt, \
                        ##__VA_ARGS__)
#define CONSOLE_BRIDGE_logError(fmt, ...)                                                    \
  ::console_bridge::log(__FILE__, __LINE__, ::console_bridge::CONSOLE_BRIDGE_LOG_ERROR, fmt, \
                        ##__VA_ARGS__)
#ifndef logDebug
#define logDebug CONSOLE_BRIDGE_logDebug
#define logInform CONSOLE_BRIDGE_logInform
#define logWarn CONSOLE_BRIDGE_logWarn
#define logError CONSOLE_BRIDGE_logError
#endif
