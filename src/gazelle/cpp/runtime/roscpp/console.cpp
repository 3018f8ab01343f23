// Levels, loggers, and what is said.

#include <ros/console.h>
#include <ros/names.h>
#include <ros/service_callback_helper.h>
#include <ros/this_node.h>
#include <roscpp/GetLoggers.h>
#include <roscpp/SetLoggerLevel.h>
#include <gazelle/cdr.hpp>
#include <gazelle/core.hpp>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "node_state.hpp"

namespace ros {
namespace console {

std::atomic<unsigned> logger_generation{1};
bool g_initialized = true;

namespace {

const char* const kLevelNames[] = {"debug", "info", "warn", "error", "fatal"};
const gazelle::Level kLevels[] = {gazelle::Level::kDebug, gazelle::Level::kInfo,
                                  gazelle::Level::kWarn, gazelle::Level::kError,
                                  gazelle::Level::kFatal};

struct Loggers {
  std::mutex mutex;
  std::map<std::string, Level> set;    // by users; the others have that of their parent
  std::map<std::string, Level> known;  // those that places of the program use
  LogAppender* appender = nullptr;
  std::shared_ptr<gazelle::ServiceServer> get_server, set_server;
};

bool levelOf(std::string word, Level& level) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (word == "warning") word = "warn";
  for (int i = 0; i < levels::Count; ++i)
    if (word == kLevelNames[i]) {
      level = static_cast<Level>(i);
      return true;
    }
  return false;
}

// "log4j.logger.ros.my_package=DEBUG" of the file that ROSCONSOLE_CONFIG_FILE names.
void readConfiguration(std::map<std::string, Level>& set) {
  const char* const path = std::getenv("ROSCONSOLE_CONFIG_FILE");
  if (!path) return;
  std::ifstream file(path);
  static const std::string kPrefix = "log4j.logger.";
  for (std::string line; std::getline(file, line);) {
    const std::size_t equals = line.find('=');
    if (line.compare(0, kPrefix.size(), kPrefix) != 0 || equals == std::string::npos) continue;
    std::string word = line.substr(equals + 1);
    word = word.substr(0, word.find_first_of(", \t\r"));
    Level level;
    if (levelOf(word, level)) set[line.substr(kPrefix.size(), equals - kPrefix.size())] = level;
  }
}

Loggers& loggers() {
  static Loggers* const state = [] {
    auto* made = new Loggers;
    readConfiguration(made->set);
    return made;
  }();
  return *state;
}

Level effective(const Loggers& state, std::string name) {
  for (;;) {
    const auto found = state.set.find(name);
    if (found != state.set.end()) return found->second;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return levels::Info;
    name.resize(dot);
  }
}

void say(const std::string& logger, Level level, const char* file, int line, const char* function,
         const std::string& text) {
  LogAppender* appender = nullptr;
  {
    const std::lock_guard<std::mutex> lock(loggers().mutex);
    appender = loggers().appender;
  }
  if (appender) appender->log(level, text.c_str(), file, function, line);
  if (const std::shared_ptr<gazelle::GraphNode> node = detail::graphNode())
    node->log(kLevels[level], text, logger, file, line, function);
  else
    gazelle::log(kLevels[level], text, logger, file, line, function);
}

std::string formatted(const char* format, va_list arguments) {
  char fixed[1024];
  va_list again;
  va_copy(again, arguments);
  const int size = std::vsnprintf(fixed, sizeof fixed, format, arguments);
  std::string text;
  if (size < 0) {
    text = format;
  } else if (static_cast<std::size_t>(size) < sizeof fixed) {
    text.assign(fixed, static_cast<std::size_t>(size));
  } else {
    text.resize(static_cast<std::size_t>(size) + 1);
    std::vsnprintf(&text[0], text.size(), format, again);
    text.pop_back();
  }
  va_end(again);
  return text;
}

}  // namespace

void LogSite::refresh() {
  const unsigned generation = logger_generation.load();
  const std::lock_guard<std::mutex> lock(loggers().mutex);
  const Level least = effective(loggers(), logger_);
  loggers().known.emplace(logger_, least);
  heard_ = level_ >= least;
  generation_ = generation;
}

bool LogSite::isDue(double period, bool delayed) {
  double now = 0.0;
  try {
    now = Time::now().toSec();
  } catch (const TimeNotInitializedException&) {
    now = WallTime::now().toSec();
  }
  double last = last_.load();
  if (last < 0.0 && delayed) {
    last_ = now;
    return false;
  }
  // Time that went back lets it speak again.
  if (last >= 0.0 && now < last + period && now >= last) return false;
  return last_.compare_exchange_strong(last, now);
}

void print(const LogSite& site, const char* file, int line, const char* function,
           const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  say(site.logger(), site.level(), file, line, function, text);
}

void print(FilterBase* filter, const LogSite& site, const char* file, int line,
           const char* function, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::string text = formatted(format, arguments);
  va_end(arguments);
  Level level = site.level();
  if (filter) {
    FilterParams params{file, line, function, text.c_str(), nullptr, level, std::string()};
    if (!filter->isEnabled(params)) return;
    level = params.level;
    if (!params.out_message.empty()) text = params.out_message;
  }
  say(site.logger(), level, file, line, function, text);
}

void printText(const LogSite& site, const char* file, int line, const char* function,
               const std::string& text) {
  say(site.logger(), site.level(), file, line, function, text);
}

void register_appender(LogAppender* appender) {
  const std::lock_guard<std::mutex> lock(loggers().mutex);
  loggers().appender = appender;
}

void initialize() {}
void shutdown() {}

bool get_loggers(std::map<std::string, levels::Level>& found) {
  const std::lock_guard<std::mutex> lock(loggers().mutex);
  found["ros"] = effective(loggers(), "ros");
  for (const auto& known : loggers().known) found[known.first] = effective(loggers(), known.first);
  for (const auto& set : loggers().set) found[set.first] = set.second;
  return true;
}

bool set_logger_level(const std::string& name, levels::Level level) {
  if (level < levels::Debug || level >= levels::Count) return false;
  {
    const std::lock_guard<std::mutex> lock(loggers().mutex);
    const auto found = loggers().set.find(name);
    if (found != loggers().set.end() && found->second == level) return false;
    loggers().set[name] = level;
  }
  notifyLoggerLevelsChanged();
  return true;
}

void notifyLoggerLevelsChanged() {
  if (++logger_generation == 0) ++logger_generation;
}

std::string formatToString(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  return text;
}

void setFixedFilterToken(const std::string&, const std::string&) {}

// ---- ~get_loggers and ~set_logger_level

namespace {

template <class M>
M requestOf(const gazelle::Bytes& bytes) {
  M request;
  gazelle::from_cdr(request, bytes.data(), bytes.size());
  return request;
}

template <class M>
gazelle::Bytes bytesOf(const M& response) {
  std::vector<uint8_t> cdr;
  gazelle::to_cdr(response, cdr);
  return cdr;
}

// Answers at once, in the thread that asks: a node that never spins has these services too.
template <class S, class Answer>
std::shared_ptr<gazelle::ServiceServer> offer(gazelle::GraphNode& node, const char* name,
                                              const Answer& answer) {
  auto server = std::make_shared<std::weak_ptr<gazelle::ServiceServer> >();
  auto made = node.offer(names::append(this_node::getName(), name),
                         *detail::serviceTypeOf<typename S::Request, typename S::Response>(),
                         [server, answer](gazelle::RequestId id, gazelle::Bytes bytes) {
                           const std::shared_ptr<gazelle::ServiceServer> self = server->lock();
                           if (!self) return;
                           try {
                             typename S::Response response;
                             if (answer(requestOf<typename S::Request>(bytes), response))
                               self->respond(id, bytesOf(response));
                             else
                               self->fail(id, "");
                           } catch (const std::exception& error) {
                             self->fail(id, error.what());
                           }
                         });
  *server = made;
  return made;
}

}  // namespace

void offerServices(gazelle::GraphNode& node) {
  try {
    auto get_server = offer<roscpp::GetLoggers>(
        node, "get_loggers",
        [](const roscpp::GetLoggersRequest&, roscpp::GetLoggersResponse& response) {
          std::map<std::string, Level> found;
          get_loggers(found);
          for (const auto& entry : found) {
            roscpp::Logger logger;
            logger.name = entry.first;
            logger.level = kLevelNames[entry.second];
            response.loggers.push_back(logger);
          }
          return true;
        });
    auto set_server = offer<roscpp::SetLoggerLevel>(
        node, "set_logger_level",
        [](const roscpp::SetLoggerLevelRequest& request, roscpp::SetLoggerLevelResponse&) {
          Level level;
          if (!levelOf(request.level, level)) return false;
          set_logger_level(request.logger, level);
          return true;
        });
    const std::lock_guard<std::mutex> lock(loggers().mutex);
    loggers().get_server = get_server;
    loggers().set_server = set_server;
  } catch (const gazelle::Error& error) {
    gazelle::log(gazelle::Level::kWarn,
                 std::string("Loggers of this node cannot be set by others: ") + error.what());
  }
}

void closeServices() {
  std::shared_ptr<gazelle::ServiceServer> get_server, set_server;
  {
    const std::lock_guard<std::mutex> lock(loggers().mutex);
    get_server.swap(loggers().get_server);
    set_server.swap(loggers().set_server);
  }
  if (get_server) get_server->close();
  if (set_server) set_server->close();
}

}  // namespace console
}  // namespace ros
