#pragma once
// Levels, loggers and the places of a program that log.

#include <ros/macros.h>

#include <atomic>
#include <cstdarg>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ros {
namespace console {

namespace levels {
enum Level { Debug, Info, Warn, Error, Fatal, Count };
}
typedef levels::Level Level;

/// Grows with every change of levels, so that places ask again.
extern ROSCONSOLE_DECL std::atomic<unsigned> logger_generation;

/// A place of the program that logs.
class ROSCONSOLE_DECL LogSite {
 public:
  LogSite(const std::string& logger, Level level) : logger_(logger), level_(level) {}
  bool isHeard() {
    if (generation_.load(std::memory_order_relaxed) !=
        logger_generation.load(std::memory_order_relaxed))
      refresh();
    return heard_.load(std::memory_order_relaxed);
  }
  /// True the first time.
  bool isFirst() { return !hit_.exchange(true); }
  /// True once in so many seconds of ros::Time; where `delayed`, not the first time.
  bool isDue(double period, bool delayed);
  const std::string& logger() const { return logger_; }
  Level level() const { return level_; }

 private:
  void refresh();

  const std::string logger_;
  const Level level_;
  std::atomic<unsigned> generation_{0};
  std::atomic<bool> heard_{false};
  std::atomic<bool> hit_{false};
  std::atomic<double> last_{-1.0};
};

struct FilterParams {
  const char* file;
  int line;
  const char* function;
  const char* message;
  void* logger;
  Level level;
  std::string out_message;
};

/// Decides of each message of a _FILTER macro.
class ROSCONSOLE_DECL FilterBase {
 public:
  virtual ~FilterBase() {}
  virtual bool isEnabled() { return true; }
  virtual bool isEnabled(FilterParams&) { return true; }
};

ROSCONSOLE_DECL void print(const LogSite& site, const char* file, int line, const char* function,
                           const char* format, ...) __attribute__((format(printf, 5, 6)));
ROSCONSOLE_DECL void print(FilterBase* filter, const LogSite& site, const char* file, int line,
                           const char* function, const char* format, ...)
    __attribute__((format(printf, 6, 7)));
ROSCONSOLE_DECL void printText(const LogSite& site, const char* file, int line,
                               const char* function, const std::string& text);

/// What other libraries' log macros go through.
class ROSCONSOLE_DECL LogAppender {
 public:
  virtual ~LogAppender() {}
  virtual void log(Level level, const char* text, const char* file, const char* function,
                   int line) = 0;
};
ROSCONSOLE_DECL void register_appender(LogAppender* appender);

ROSCONSOLE_DECL void initialize();
ROSCONSOLE_DECL void shutdown();
ROSCONSOLE_DECL bool get_loggers(std::map<std::string, levels::Level>& loggers);
/// Of a logger and those below it; false where nothing changed.
ROSCONSOLE_DECL bool set_logger_level(const std::string& name, levels::Level level);
ROSCONSOLE_DECL void notifyLoggerLevelsChanged();
ROSCONSOLE_DECL std::string formatToString(const char* format, ...)
    __attribute__((format(printf, 1, 2)));
ROSCONSOLE_DECL void setFixedFilterToken(const std::string& key, const std::string& value);

extern ROSCONSOLE_DECL bool g_initialized;

}  // namespace console
}  // namespace ros
