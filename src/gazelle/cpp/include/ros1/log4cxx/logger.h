#pragma once
// What old programs set log levels with: loggers of rosconsole under log4cxx's names.

#include <ros/console.h>

#include <boost/shared_ptr.hpp>
#include <string>

namespace log4cxx {

class Level {
 public:
  explicit Level(ros::console::levels::Level level) : level_(level) {}
  static boost::shared_ptr<Level> getDebug() { return made(ros::console::levels::Debug); }
  static boost::shared_ptr<Level> getInfo() { return made(ros::console::levels::Info); }
  static boost::shared_ptr<Level> getWarn() { return made(ros::console::levels::Warn); }
  static boost::shared_ptr<Level> getError() { return made(ros::console::levels::Error); }
  static boost::shared_ptr<Level> getFatal() { return made(ros::console::levels::Fatal); }
  ros::console::levels::Level level() const { return level_; }

 private:
  static boost::shared_ptr<Level> made(ros::console::levels::Level level) {
    return boost::shared_ptr<Level>(new Level(level));
  }
  ros::console::levels::Level level_;
};
typedef boost::shared_ptr<Level> LevelPtr;

class Logger {
 public:
  explicit Logger(const std::string& name) : name_(name) {}
  static boost::shared_ptr<Logger> getLogger(const std::string& name) {
    return boost::shared_ptr<Logger>(new Logger(name));
  }
  static boost::shared_ptr<Logger> getRootLogger() { return getLogger("ros"); }
  void setLevel(const LevelPtr& level) { ros::console::set_logger_level(name_, level->level()); }
  const std::string& getName() const { return name_; }

 private:
  std::string name_;
};
typedef boost::shared_ptr<Logger> LoggerPtr;

}  // namespace log4cxx

namespace ros {
namespace console {
/// rosconsole's levels as log4cxx's, by their number.
static const log4cxx::LevelPtr g_level_lookup[] = {
    log4cxx::Level::getDebug(), log4cxx::Level::getInfo(), log4cxx::Level::getWarn(),
    log4cxx::Level::getError(), log4cxx::Level::getFatal()};
}  // namespace console
}  // namespace ros
