// The core of the C++ half: nodes, topics, services, time, life and death of the process, with no
// names of ROS. Messages between ends of this process stay in C++; the rest goes through the host.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "gazelle/bytes.hpp"
#include "gazelle/error.hpp"
#include "gazelle/export.hpp"
#include "gazelle/json.hpp"
#include "gazelle/message_type.hpp"

namespace gazelle {

// ---- The host ---------------------------------------------------------------------------------

// Ask a verb of the host; throws Error with the host's words. See gazelle.cpp.verbs (Python).
GAZELLE_EXPORT Json call(const std::string& verb, const Json& request = Json::object());

// The same without exceptions at the process' end: null where the graph is left already.
GAZELLE_EXPORT bool is_attached();

// A listener whose number is given to a verb that tells things later (Python: host.emit(number,
// value)). Runs in a thread of the host and must be short. Returns the number.
GAZELLE_EXPORT std::uint64_t add_event_listener(std::function<void(const Json&)> listener);
GAZELLE_EXPORT void remove_event_listener(std::uint64_t number);

// ---- Values -----------------------------------------------------------------------------------

struct MessageInfo {
  std::uint64_t sequence = 0;          // counts the publisher's messages from 1
  std::int64_t stamp_ns = 0;           // wall time of publishing
  std::array<std::uint8_t, 16> gid{};  // names the publisher
  std::string publisher;               // its node's global name; "" where nobody knows
  bool is_local = false;               // it came from this process
};

struct Qos {
  std::size_t depth = 10;
  bool reliable = true;
  bool transient_local = false;
  bool keep_all = false;
  std::int64_t deadline_ns = 0;  // 0: none
  std::int64_t lifespan_ns = 0;  // 0: for ever
  bool manual_liveliness = false;
  std::int64_t lease_ns = 0;  // 0: never
};

// A message on its way to a subscription: the publisher's object, or bytes, or both.
class GAZELLE_EXPORT Delivered {
 public:
  // An object of this process, of `type->native`.
  Delivered(std::shared_ptr<const void> message, const MessageType* type, MessageInfo info);
  // Bytes of a type.
  Delivered(Bytes cdr, std::string type_name, MessageInfo info);

  const MessageInfo& info() const { return info_; }
  const std::string& type_name() const { return type_name_; }  // "std_msgs/msg/String"
  // The publisher's type, null where it came as bytes.
  const MessageType* type() const { return type_; }
  bool has_object() const { return static_cast<bool>(message_); }

  // As an object of a type: the publisher's own where that is the same C++ type, else read from
  // the bytes, once for all who ask for the same type. Throws Error where the bytes are no such
  // message.
  std::shared_ptr<const void> object(const MessageType& wanted) const;
  template <class M>
  std::shared_ptr<const M> as(const MessageType& wanted) const {
    return std::static_pointer_cast<const M>(object(wanted));
  }
  // The same, and true where nobody else can have it: then it may be changed.
  std::shared_ptr<void> own_object(const MessageType& wanted) const;
  // As CDR, written on demand and once.
  Bytes cdr() const;

 private:
  struct Shared;
  MessageInfo info_;
  std::string type_name_;
  const MessageType* type_ = nullptr;
  std::shared_ptr<const void> message_;
  std::shared_ptr<Shared> shared_;
};

// ---- Ends of topics and services --------------------------------------------------------------

class GAZELLE_EXPORT Publisher {
 public:
  virtual ~Publisher() = default;
  // Subscriptions of this process get the very object: it must not be changed afterwards.
  virtual void publish(std::shared_ptr<const void> message, const MessageType& type) = 0;
  // The message is only looked at: encoded for others; for subscriptions here it is encoded and
  // decoded, as the caller may go on changing it. `copy` makes the copy instead, where given.
  virtual void publish_copy(const void* message, const MessageType& type,
                            std::shared_ptr<const void> (*copy)(const void*) = nullptr) = 0;
  // CDR with its header.
  virtual void publish_cdr(Bytes cdr) = 0;
  virtual std::size_t subscription_count() const = 0;        // on the whole graph
  virtual std::size_t local_subscription_count() const = 0;  // in this process
  virtual bool wanted() const = 0;  // whether a message would go anywhere; cheap
  virtual const std::string& topic() const = 0;
  virtual const std::string& type_name() const = 0;
  virtual const std::array<std::uint8_t, 16>& gid() const = 0;
  virtual const Qos& qos() const = 0;
  // Take it off the graph; what is published afterwards goes nowhere. The destructor does it, too.
  virtual void close() = 0;
  virtual bool closed() const = 0;
};

struct PublisherOptions {
  bool latch = false;  // late subscriptions get the last message (ROS 1); transient_local does, too
  // Called, in a thread of the host's or of who subscribes, with the new number on the graph.
  std::function<void(std::size_t count)> matched;
  // Called for each subscriber by its node's global name, as it comes (true) and goes.
  std::function<void(const std::string& node, bool is_there)> subscriber_changed;
};

class GAZELLE_EXPORT Subscription {
 public:
  virtual ~Subscription() = default;
  virtual std::size_t publisher_count() const = 0;  // on the whole graph
  virtual const std::string& topic() const = 0;
  virtual const std::string& type_name() const = 0;
  virtual const Qos& qos() const = 0;
  // No call of the function begins afterwards; one that is under way in another thread is waited
  // for. The destructor does it, too.
  virtual void close() = 0;
};

struct SubscriptionOptions {
  bool latched = true;         // with those that latched publishers sent before
  bool ignore_local = false;   // none of this very node's own publishers (rclcpp)
  std::string announced_type;  // for subscriptions of any type: what others see
  std::function<void(std::size_t count)> matched;
};

struct RequestId {
  std::array<std::uint8_t, 16> client{};
  std::int64_t sequence = 0;
  std::int64_t stamp_ns = 0;
  std::string caller;        // the asking node's global name
  std::uint64_t number = 0;  // the host's
};

class GAZELLE_EXPORT ServiceServer {
 public:
  virtual ~ServiceServer() = default;
  virtual void respond(const RequestId& request, Bytes response) = 0;
  virtual void fail(const RequestId& request, const std::string& text) = 0;
  virtual const std::string& name() const = 0;
  virtual void close() = 0;
};

enum class CallStatus { kOk, kFailed, kUnavailable, kTimeout };

struct CallResult {
  CallStatus status = CallStatus::kFailed;
  Bytes response;    // where kOk
  std::string text;  // where not
  std::int64_t stamp_ns = 0;
};

class GAZELLE_EXPORT ServiceClient {
 public:
  virtual ~ServiceClient() = default;
  // `done` runs once in a thread of the host's; a negative timeout waits as long as the server
  // lives. Returns the call's number (counts from 1), for `cancel`.
  virtual std::int64_t call_async(Bytes request, std::function<void(CallResult)> done,
                                  double timeout_s = -1.0) = 0;
  // `done` is called no more.
  virtual void cancel(std::int64_t number) = 0;
  // Ask and wait; for programs of ROS 1. Ends early when the process is to end.
  virtual CallResult call(Bytes request, double timeout_s = -1.0) = 0;
  virtual bool is_ready() const = 0;
  // Until the service is there, time is up (negative: none), or the process is to end.
  virtual bool wait_for(double timeout_s = -1.0) = 0;
  virtual const std::string& name() const = 0;
  virtual void close() = 0;
};

// ---- Nodes ------------------------------------------------------------------------------------

struct NodeOptions {
  std::string name;
  std::string namespace_;  // "" for ROS_NAMESPACE or what the arguments say
  int ros_version = 1;     // 1 or 2
  bool anonymous = false;  // ROS 1: make the name unique
  bool rosout = true;
  bool use_global_arguments = true;    // of the process (set_arguments)
  std::vector<std::string> arguments;  // own ones, before those of the process
  std::vector<std::pair<std::string, std::string>> remappings;  // ROS 1's ros::init(remappings, …)
};

enum class Level { kDebug = 10, kInfo = 20, kWarn = 30, kError = 40, kFatal = 50 };

// The arguments of the process, without the program's name, for nodes made later (ros::init,
// rclcpp::init). Returns those that are not ROS's.
GAZELLE_EXPORT std::vector<std::string> set_arguments(int ros_version,
                                                      const std::vector<std::string>& arguments);

class GAZELLE_EXPORT GraphNode : public std::enable_shared_from_this<GraphNode> {
 public:
  // Opens the graph where that is not done yet. Throws Error (IllegalNameError, PortTakenError …).
  static std::shared_ptr<GraphNode> create(const NodeOptions& options);
  virtual ~GraphNode() = default;

  virtual std::uint64_t handle() const = 0;           // what verbs call "node"
  virtual const std::string& name() const = 0;        // last part
  virtual const std::string& namespace_() const = 0;  // "/" or "/a/b"
  virtual const std::string& full_name() const = 0;
  virtual int ros_version() const = 0;
  // What the verb node/create gave: {"name", "namespace", "full_name", "parameters": {…} (ROS 2:
  // overrides, ROS 1: private ones set already), "log_levels": {…}, "log_path" …}.
  virtual const Json& details() const = 0;
  // The global name after remapping; `~` is this node.
  virtual std::string resolve(const std::string& name, bool remap = true) const = 0;

  virtual std::shared_ptr<Publisher> advertise(const std::string& topic, const MessageType& type,
                                               const Qos& qos,
                                               const PublisherOptions& options = {}) = 0;
  // Of a type that is known by name and text only (generic publishers, ShapeShifter).
  virtual std::shared_ptr<Publisher> advertise(const std::string& topic,
                                               const std::string& type_name,
                                               const std::string& definition, const Qos& qos,
                                               const PublisherOptions& options = {}) = 0;
  // `type` null: any type. The function runs in the publisher's or the host's thread and must
  // only queue.
  virtual std::shared_ptr<Subscription> subscribe(const std::string& topic, const MessageType* type,
                                                  const Qos& qos,
                                                  std::function<void(Delivered)> function,
                                                  const SubscriptionOptions& options = {}) = 0;
  // By name: messages come as bytes, or as objects of whoever publishes here.
  virtual std::shared_ptr<Subscription> subscribe(const std::string& topic,
                                                  const std::string& type_name, const Qos& qos,
                                                  std::function<void(Delivered)> function,
                                                  const SubscriptionOptions& options = {}) = 0;
  // The handler runs in a thread of the host's and only queues; `respond` or `fail` later.
  virtual std::shared_ptr<ServiceServer> offer(const std::string& service, const ServiceType& type,
                                               std::function<void(RequestId, Bytes)> handler) = 0;
  virtual std::shared_ptr<ServiceClient> client(const std::string& service,
                                                const ServiceType& type) = 0;

  // On the console, in the log file and on /rosout.
  virtual void log(Level level, const std::string& text, const std::string& logger = "",
                   const char* file = "", int line = 0, const char* function = "") = 0;
  // Called once when somebody else has this node shut down (rosnode kill, the same name again).
  virtual void on_shutdown(std::function<void(const std::string& reason)> listener) = 0;
  // Take it and all its ends off the graph; twice does nothing.
  virtual void shutdown() = 0;
  virtual bool closed() const = 0;
};

// Say something before there is a node, or without one.
GAZELLE_EXPORT void log(Level level, const std::string& text, const std::string& logger = "",
                        const char* file = "", int line = 0, const char* function = "");

// Called, in a thread of the host's, whenever something comes to the graph or goes; must be short.
GAZELLE_EXPORT std::uint64_t on_graph_change(std::function<void()> listener);
GAZELLE_EXPORT void remove_graph_listener(std::uint64_t number);

// ---- Time -------------------------------------------------------------------------------------

namespace clock {

using Stop = std::function<bool()>;

GAZELLE_EXPORT std::int64_t now_ns();  // simulated, or since 1970
GAZELLE_EXPORT std::int64_t wall_ns();
GAZELLE_EXPORT std::int64_t steady_ns();
GAZELLE_EXPORT bool uses_sim_time();
// Whatever /use_sim_time says: 1 simulated, 0 wall, -1 what it says (ROS 2's parameter).
GAZELLE_EXPORT void use_sim_time(int choice);
// Whether a time is known: false while simulated time has not begun.
GAZELLE_EXPORT bool is_valid();
// How often time went backwards, or became another one's, so far.
GAZELLE_EXPORT std::uint64_t jumps();

enum class Wake { kReached, kJumped, kStopped };
// Until now_ns() is there. Ends early when time goes backwards, when `stop` (looked at after every
// notify_waiters()) says so, and when the process is to end (ok() false).
GAZELLE_EXPORT Wake wait_until(std::int64_t target_ns, const Stop& stop = {});
// The same on the wall's clock, of which 0 jumps are known.
GAZELLE_EXPORT Wake wait_wall(std::int64_t duration_ns, const Stop& stop = {});
// Let everybody who waits look whether to stop.
GAZELLE_EXPORT void notify_waiters();

struct Jump {
  bool clock_changed;     // between simulated and wall time
  std::int64_t delta_ns;  // negative: backwards
};
// In the thread that brings the time; must be short.
GAZELLE_EXPORT std::uint64_t on_jump(std::function<void(const Jump&)> listener);
// Whenever simulated time has come on (message by message, or as somebody looks): for timers'
// queues. Not called on wall time.
GAZELLE_EXPORT std::uint64_t on_time(std::function<void(std::int64_t now_ns)> listener);
GAZELLE_EXPORT void remove_listener(std::uint64_t number);

}  // namespace clock

// A queue of work at points in time, with one thread for the process: what roscpp's and rclcpp's
// timers wake by. Functions are short (they queue), on the clock or on steady time.
class GAZELLE_EXPORT Alarms {
 public:
  enum class Base { kClock, kWall, kSteady };
  // Returns a number; the function is called once when the time is there, or when time has jumped
  // back (kClock), with how it came about.
  static std::uint64_t at(Base base, std::int64_t when_ns,
                          std::function<void(clock::Wake)> function);
  // False where it has been called already or is being called now.
  static bool cancel(std::uint64_t number);
};

// ---- The process ------------------------------------------------------------------------------

GAZELLE_EXPORT bool ok();  // false once a shutdown was asked for
// Callable from any thread (not from a signal handler): ok() turns false, waits end, listeners run
// in this thread, latest first.
GAZELLE_EXPORT void request_shutdown(const std::string& reason);
GAZELLE_EXPORT std::string shutdown_reason();
GAZELLE_EXPORT std::uint64_t on_shutdown(std::function<void(const std::string& reason)> listener);
GAZELLE_EXPORT void remove_shutdown_listener(std::uint64_t number);
// rclcpp::init after rclcpp::shutdown: ok() is true again.
GAZELLE_EXPORT void reset_shutdown();

// Install native handlers as ros::init (SIGINT) or rclcpp::init (SIGINT, SIGTERM) do: a thread of
// ours then calls request_shutdown("signal-2"). The handler that was there before is called as
// well where it was a program's own. uninstall puts back what was there.
GAZELLE_EXPORT void install_signal_handlers(const std::vector<int>& numbers);
GAZELLE_EXPORT void uninstall_signal_handlers();

// Leave the graph: nodes are shut down, last messages delivered. Called at exit() as well.
GAZELLE_EXPORT void leave_graph();

// "Foo<int>::bar()" of a mangled name.
GAZELLE_EXPORT std::string demangled(const char* name);

}  // namespace gazelle
