// The life of a node: arguments, start, spinning, the end.

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <gazelle/core.hpp>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include "node_state.hpp"

namespace ros {

namespace {

// The process' node. Never destroyed: static objects of users end after us.
struct Life {
  std::recursive_mutex starting;
  std::mutex mutex;  // of what follows
  std::shared_ptr<gazelle::GraphNode> node;
  std::vector<boost::weak_ptr<detail::End> > ends;
  CallbackQueue global_queue;
  CallbackQueue internal_queue;
  uint32_t options = 0;
  std::atomic<bool> is_initialized{false};
  std::atomic<bool> is_started{false};
  std::atomic<bool> is_shutting_down{false};
  std::atomic<bool> is_ok{false};
  std::atomic<uint64_t> owners{0};
};

Life& life() {
  static Life* const state = new Life;
  return *state;
}

void endAtExit() {
  if (ok() && !isShuttingDown()) shutdown();
}

bool splitRemapping(const std::string& argument, std::string& left, std::string& right) {
  const std::size_t at = argument.find(":=");
  if (at == std::string::npos) return false;
  left = argument.substr(0, at);
  right = argument.substr(at + 2);
  return true;
}

class Later : public CallbackInterface {
 public:
  Later(const boost::function<void()>& function, const boost::weak_ptr<void const>& owner)
      : function_(function), owner_(owner) {}
  virtual CallResult call() {
    const boost::shared_ptr<void const> owner = owner_.lock();
    if (!owner) return Invalid;
    function_();
    return Success;
  }

 private:
  boost::function<void()> function_;
  boost::weak_ptr<void const> owner_;
};

}  // namespace

namespace detail {

std::shared_ptr<gazelle::GraphNode> graphNode() {
  const std::lock_guard<std::mutex> lock(life().mutex);
  return life().node;
}

uint64_t newOwner() { return ++life().owners; }

void keep(const boost::shared_ptr<End>& end) {
  Life& state = life();
  const std::lock_guard<std::mutex> lock(state.mutex);
  std::vector<boost::weak_ptr<End> >& ends = state.ends;
  // Those that are gone are dropped whenever the list would grow.
  if (ends.size() == ends.capacity())
    ends.erase(std::remove_if(ends.begin(), ends.end(),
                              [](const boost::weak_ptr<End>& kept) { return kept.expired(); }),
               ends.end());
  ends.push_back(end);
}

void closeAll() {
  std::vector<boost::weak_ptr<End> > ends;
  {
    const std::lock_guard<std::mutex> lock(life().mutex);
    ends.swap(life().ends);
  }
  for (const boost::weak_ptr<End>& kept : ends)
    if (const boost::shared_ptr<End> end = kept.lock()) end->close(false);
}

CallbackInterfacePtr later(const boost::function<void()>& function,
                           const boost::weak_ptr<void const>& owner) {
  return boost::make_shared<Later>(function, owner);
}

}  // namespace detail

void init(const M_string& remappings, const std::string& name, uint32_t options) {
  Life& state = life();
  const std::lock_guard<std::recursive_mutex> lock(state.starting);
  if (state.is_initialized) return;
  std::signal(SIGPIPE, SIG_IGN);
  state.options = options;
  this_node::init(name, remappings, options);
  state.is_ok = true;
  state.is_initialized = true;
  static std::once_flag once;
  std::call_once(once, [] { std::atexit(&endAtExit); });
  param::init(remappings);
}

void init(int& argc, char** argv, const std::string& name, uint32_t options) {
  M_string remappings;
  std::string left, right;
  int kept = 0;
  const int count = argc;
  for (int i = 0; i < count; ++i) {
    if (splitRemapping(argv[i], left, right)) {
      remappings[left] = right;
      --argc;
    } else {
      argv[kept++] = argv[i];
    }
  }
  for (int i = kept; i < count; ++i) argv[i] = nullptr;
  init(remappings, name, options);
}

void init(const VP_string& remapping_args, const std::string& name, uint32_t options) {
  init(M_string(remapping_args.begin(), remapping_args.end()), name, options);
}

std::string getROSArg(int argc, const char* const* argv, const std::string& arg) {
  std::string left, right;
  for (int i = 0; i < argc; ++i)
    if (splitRemapping(argv[i], left, right) && left == arg) return right;
  return "";
}

void removeROSArgs(int argc, const char* const* argv, V_string& args_out) {
  std::string left, right;
  for (int i = 0; i < argc; ++i)
    if (!splitRemapping(argv[i], left, right)) args_out.push_back(argv[i]);
}

bool isInitialized() { return life().is_initialized; }
bool isShuttingDown() { return life().is_shutting_down; }
bool isStarted() { return life().is_started; }
bool ok() { return life().is_ok.load(std::memory_order_relaxed) && gazelle::ok(); }

CallbackQueue* getGlobalCallbackQueue() { return &life().global_queue; }
CallbackQueue* getInternalCallbackQueue() { return &life().internal_queue; }

void start() {
  Life& state = life();
  const std::lock_guard<std::recursive_mutex> lock(state.starting);
  if (state.is_started || state.is_shutting_down || !state.is_initialized) return;
  Time::init();
  gazelle::on_shutdown([](const std::string&) { shutdown(); });
  gazelle::NodeOptions options;
  const std::string& full = this_node::getName();
  const std::size_t slash = full.rfind('/');
  options.name = full.substr(slash + 1);
  options.namespace_ = slash == 0 ? "/" : full.substr(0, slash);
  options.ros_version = 1;
  options.rosout = !(state.options & init_options::NoRosout);
  options.use_global_arguments = false;
  std::shared_ptr<gazelle::GraphNode> node;
  try {
    node = gazelle::GraphNode::create(options);
  } catch (const gazelle::Error& error) {
    gazelle::log(gazelle::Level::kFatal, error.what(), ROSCONSOLE_DEFAULT_NAME);
    std::exit(1);
  }
  node->on_shutdown([](const std::string& reason) {
    ROS_WARN("Shutdown request received.");
    ROS_WARN("Reason given for shutdown: [%s]", reason.c_str());
    XMLRPCManager::instance()->hear("shutdown", reason);
  });
  {
    const std::lock_guard<std::mutex> guard(state.mutex);
    state.node = node;
  }
  console::offerServices(*node);
  if (!(state.options & init_options::NoSigintHandler)) gazelle::install_signal_handlers({SIGINT});
  state.is_started = true;
}

void shutdown() {
  Life& state = life();
  if (!state.is_initialized || state.is_shutting_down.exchange(true)) return;
  state.is_ok = false;
  state.global_queue.disable();
  state.global_queue.clear();
  gazelle::clock::notify_waiters();
  if (state.is_started) {
    detail::closeAll();
    console::closeServices();
    std::shared_ptr<gazelle::GraphNode> node;
    {
      const std::lock_guard<std::mutex> lock(state.mutex);
      node.swap(state.node);
    }
    if (node) node->shutdown();
  }
  Time::shutdown();
  gazelle::request_shutdown("ros::shutdown");
  state.is_started = false;
}

void requestShutdown() { gazelle::request_shutdown("ros::requestShutdown"); }

void spin() {
  SingleThreadedSpinner spinner;
  spin(spinner);
}
void spin(Spinner& spinner) { spinner.spin(); }
void spinOnce() { getGlobalCallbackQueue()->callAvailable(WallDuration()); }
void waitForShutdown() {
  while (ok()) WallDuration(0.05).sleep();
}

const std::string& getDefaultMasterURI() {
  static const std::string uri("http://localhost:11311");
  return uri;
}

namespace network {

bool splitURI(const std::string& uri, std::string& host, uint32_t& port) {
  std::string rest = uri.compare(0, 7, "http://") == 0     ? uri.substr(7)
                     : uri.compare(0, 9, "rosrpc://") == 0 ? uri.substr(9)
                                                           : uri;
  const std::size_t colon = rest.find(':');
  if (colon == std::string::npos) return false;
  host = rest.substr(0, colon);
  port = static_cast<uint32_t>(std::strtoul(rest.c_str() + colon + 1, nullptr, 10));
  return port != 0;
}

const std::string& getHost() {
  static const std::string host = [] {
    for (const char* variable : {"ROS_HOSTNAME", "ROS_IP"})
      if (const char* value = std::getenv(variable))
        if (*value) return std::string(value);
    return std::string("localhost");
  }();
  return host;
}

uint16_t getTCPROSPort() { return 0; }

}  // namespace network

// ---- XMLRPCManager: only what users bind to

const XMLRPCManagerPtr& XMLRPCManager::instance() {
  static const XMLRPCManagerPtr* const manager =
      new XMLRPCManagerPtr(boost::make_shared<XMLRPCManager>());
  return *manager;
}

bool XMLRPCManager::bind(const std::string& function_name, const XMLRPCFunc& callback) {
  return functions_.emplace(function_name, callback).second;
}
void XMLRPCManager::unbind(const std::string& function_name) { functions_.erase(function_name); }

void XMLRPCManager::hear(const std::string& function_name, const std::string& reason) {
  const auto found = functions_.find(function_name);
  if (found == functions_.end()) {
    requestShutdown();
    return;
  }
  XmlRpc::XmlRpcValue params, result;
  params[0] = std::string("master");
  params[1] = reason;
  found->second(params, result);
}

namespace xmlrpc {
XmlRpc::XmlRpcValue responseStr(int code, const std::string& message, const std::string& response) {
  XmlRpc::XmlRpcValue answer;
  answer[0] = code;
  answer[1] = message;
  answer[2] = response;
  return answer;
}
XmlRpc::XmlRpcValue responseInt(int code, const std::string& message, int response) {
  XmlRpc::XmlRpcValue answer;
  answer[0] = code;
  answer[1] = message;
  answer[2] = response;
  return answer;
}
}  // namespace xmlrpc

}  // namespace ros
