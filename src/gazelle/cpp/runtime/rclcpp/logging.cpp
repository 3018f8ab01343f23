// Loggers: their levels, and what becomes of what they say.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdarg>
#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "gazelle/core.hpp"
#include "rclcpp/detail/log_arguments.hpp"
#include "rclcpp/logger.hpp"
#include "rcutils/logging.h"

namespace {

struct Levels {
  std::shared_mutex mutex;
  std::map<std::string, int> own;
  std::unordered_map<std::string, int> effective;  // what was asked for and found
  std::atomic<int> standard{RCUTILS_LOG_SEVERITY_INFO};
  std::map<std::string, std::weak_ptr<gazelle::GraphNode>> nodes;
  std::atomic<rcutils_logging_output_handler_t> handler{&rcutils_logging_console_output_handler};
};

Levels& levels() {
  static auto* all = new Levels;
  return *all;
}

std::string parent_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? std::string() : name.substr(0, dot);
}

int found_level(Levels& all, std::string name) {
  while (!name.empty()) {
    const auto found = all.own.find(name);
    if (found != all.own.end() && found->second != RCUTILS_LOG_SEVERITY_UNSET) {
      return found->second;
    }
    name = parent_of(name);
  }
  return all.standard;
}

std::shared_ptr<gazelle::GraphNode> node_of(std::string name) {
  Levels& all = levels();
  std::shared_lock<std::shared_mutex> lock(all.mutex);
  while (!name.empty()) {
    const auto found = all.nodes.find(name);
    if (found != all.nodes.end()) return found->second.lock();
    name = parent_of(name);
  }
  return nullptr;
}

bool is_level(int level) { return level >= 0 && level <= 50 && level % 10 == 0; }

std::string formatted(const char* format, va_list* arguments) {
  va_list again;
  va_copy(again, *arguments);
  char brief[512];
  const int length = vsnprintf(brief, sizeof(brief), format, again);
  va_end(again);
  if (length < 0) return format;
  if (static_cast<std::size_t>(length) < sizeof(brief)) {
    return std::string(brief, static_cast<std::size_t>(length));
  }
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  va_copy(again, *arguments);
  vsnprintf(text.data(), text.size(), format, again);
  va_end(again);
  text.pop_back();
  return text;
}

}  // namespace

extern "C" {

rcutils_ret_t rcutils_logging_initialize(void) { return RCUTILS_RET_OK; }
rcutils_ret_t rcutils_logging_shutdown(void) { return RCUTILS_RET_OK; }

int rcutils_logging_get_default_logger_level(void) { return levels().standard; }

void rcutils_logging_set_default_logger_level(int level) {
  Levels& all = levels();
  std::unique_lock<std::shared_mutex> lock(all.mutex);
  all.standard = level == RCUTILS_LOG_SEVERITY_UNSET ? RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL : level;
  all.effective.clear();
}

int rcutils_logging_get_logger_level(const char* name) {
  if (!name) return -1;
  if (!*name) return levels().standard;
  Levels& all = levels();
  std::shared_lock<std::shared_mutex> lock(all.mutex);
  const auto found = all.own.find(name);
  return found == all.own.end() ? RCUTILS_LOG_SEVERITY_UNSET : found->second;
}

rcutils_ret_t rcutils_logging_set_logger_level(const char* name, int level) {
  if (!name) return RCUTILS_RET_INVALID_ARGUMENT;
  if (!is_level(level)) {
    RCUTILS_SET_ERROR_MSG("Invalid severity level specified for logger");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (!*name) {
    rcutils_logging_set_default_logger_level(level);
    return RCUTILS_RET_OK;
  }
  Levels& all = levels();
  std::unique_lock<std::shared_mutex> lock(all.mutex);
  all.own[name] = level;
  all.effective.clear();
  return RCUTILS_RET_OK;
}

int rcutils_logging_get_logger_effective_level(const char* name) {
  if (!name) return levels().standard;
  Levels& all = levels();
  {
    std::shared_lock<std::shared_mutex> lock(all.mutex);
    const auto found = all.effective.find(name);
    if (found != all.effective.end()) return found->second;
  }
  std::unique_lock<std::shared_mutex> lock(all.mutex);
  const int level = found_level(all, name);
  // Names that programs make up as they go must not fill the memory.
  if (all.effective.size() > 1000) all.effective.clear();
  all.effective[name] = level;
  return level;
}

bool rcutils_logging_logger_is_enabled_for(const char* name, int severity) {
  return severity >= rcutils_logging_get_logger_effective_level(name);
}

rcutils_ret_t rcutils_logging_severity_level_from_string(const char* text, rcutils_allocator_t,
                                                         int* severity) {
  if (!text || !severity) return RCUTILS_RET_INVALID_ARGUMENT;
  static const char* const kWords[] = {"UNSET", "DEBUG", "INFO", "WARN", "ERROR", "FATAL"};
  std::string word = text;
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  for (int i = 0; i < 6; ++i) {
    if (word == kWords[i]) {
      *severity = i * 10;
      return RCUTILS_RET_OK;
    }
  }
  RCUTILS_SET_ERROR_MSG("invalid severity string");
  return RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID;
}

rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void) {
  return levels().handler;
}

void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t handler) {
  levels().handler = handler;
}

void rcutils_logging_console_output_handler(const rcutils_log_location_t* location, int severity,
                                            const char* name, rcutils_time_point_value_t,
                                            const char* format, va_list* arguments) {
  const std::string text = formatted(format, arguments);
  const std::string logger = name ? name : "";
  const char* file = location ? location->file_name : "";
  const int line = location ? static_cast<int>(location->line_number) : 0;
  const char* function = location ? location->function_name : "";
  const auto level = static_cast<gazelle::Level>(severity);
  if (const auto node = node_of(logger)) {
    node->log(level, text, logger, file, line, function);
  } else {
    gazelle::log(level, text, logger, file, line, function);
  }
}

void rcutils_log(const rcutils_log_location_t* location, int severity, const char* name,
                 const char* format, ...) {
  const char* logger = name ? name : "";
  if (!rcutils_logging_logger_is_enabled_for(logger, severity)) return;
  const auto handler = levels().handler.load();
  if (!handler) return;
  va_list arguments;
  va_start(arguments, format);
  handler(location, severity, logger, gazelle::clock::wall_ns(), format, &arguments);
  va_end(arguments);
}

}  // extern "C"

namespace rclcpp {

Logger get_logger(const std::string& name) { return Logger(name); }
Logger get_node_logger(const void*) { return get_logger("rclcpp"); }

Logger Logger::get_child(const std::string& suffix) {
  return name_ ? Logger(*name_ + "." + suffix) : Logger();
}

void Logger::set_level(Level level) {
  rcutils_logging_set_logger_level(name_ ? name_->c_str() : "", static_cast<int>(level));
}

Logger::Level Logger::get_effective_level() const {
  return static_cast<Level>(
      rcutils_logging_get_logger_effective_level(name_ ? name_->c_str() : ""));
}

namespace detail {

void use_log_arguments(const std::vector<std::string>& words) {
  bool inside = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--ros-args") {
      inside = true;
    } else if (words[i] == "--") {
      inside = false;
    } else if (inside && words[i] == "--log-level" && i + 1 < words.size()) {
      const std::string& rule = words[++i];
      const std::size_t at = rule.find(":=");
      const std::string name = at == std::string::npos ? "" : rule.substr(0, at);
      const std::string word = at == std::string::npos ? rule : rule.substr(at + 2);
      int level = 0;
      // A word that is no level was refused by set_arguments already.
      if (rcutils_logging_severity_level_from_string(word.c_str(), rcutils_get_default_allocator(),
                                                     &level) == RCUTILS_RET_OK) {
        rcutils_logging_set_logger_level(name.c_str(), level);
      }
    }
  }
}

void attach_logger(const std::string& name, const std::shared_ptr<gazelle::GraphNode>& node) {
  Levels& all = levels();
  std::unique_lock<std::shared_mutex> lock(all.mutex);
  all.nodes[name] = node;
}

}  // namespace detail
}  // namespace rclcpp
