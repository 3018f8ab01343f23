// What tests ask of rclcpp: the first word chooses, lines on standard output are the facts.
#include <chrono>
#include <cstdio>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "example_interfaces/action/fibonacci.hpp"
#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "std_msgs/msg/int32.hpp"
#include "std_msgs/msg/string.hpp"

using namespace std::chrono_literals;  // NOLINT
using AddTwoInts = example_interfaces::srv::AddTwoInts;
using Fibonacci = example_interfaces::action::Fibonacci;
using Int32 = std_msgs::msg::Int32;
using String = std_msgs::msg::String;

template <>
struct rclcpp::TypeAdapter<std::string, String> {
  using is_specialized = std::true_type;
  using custom_type = std::string;
  using ros_message_type = String;
  static void convert_to_ros_message(const std::string& from, String& to) { to.data = from; }
  static void convert_to_custom(const String& from, std::string& to) { to = from.data; }
};

namespace {

void say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void check(const char* name, bool holds) { say(std::string(name) + (holds ? " holds" : " FAILS")); }

template <class Function>
bool throws(Function function, const char* part) {
  try {
    function();
  } catch (const std::exception& error) {
    if (std::string(error.what()).find(part) != std::string::npos) return true;
    say(std::string("said: ") + error.what());
  }
  return false;
}

void spin(const rclcpp::Node::SharedPtr& node, const std::function<bool()>& done) {
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (rclcpp::ok() && !done() && std::chrono::steady_clock::now() < end) {
    executor.spin_once(50ms);
  }
}

struct Methods {
  int reference = 0, shared = 0, constant = 0, unique = 0, info = 0, bytes = 0, custom = 0;
  void by_shared(const String::SharedPtr) { ++shared; }
  void by_constant(const String::ConstSharedPtr&) { ++constant; }
};

void signatures() {
  auto node = std::make_shared<rclcpp::Node>("signatures");
  Methods m;
  std::vector<rclcpp::SubscriptionBase::SharedPtr> all;
  const auto add = [&](auto callback) {
    all.push_back(node->create_subscription<String>("topic", 10, callback));
  };
  add([&](const String&) { ++m.reference; });
  add([&](const String&, const rclcpp::MessageInfo& given) {
    m.info += given.get_rmw_message_info().source_timestamp > 0;
  });
  add(std::bind(&Methods::by_shared, &m, std::placeholders::_1));
  add(std::bind(&Methods::by_constant, &m, std::placeholders::_1));
  add([&](String::UniquePtr message) { m.unique += message->data == "x"; });
  add([&](std::shared_ptr<const rclcpp::SerializedMessage> message) {
    String read;
    rclcpp::Serialization<String>().deserialize_message(message.get(), &read);
    m.bytes += read.data == "x";
  });
  all.push_back(node->create_subscription<rclcpp::TypeAdapter<std::string, String>>(
      "topic", 10, [&](const std::string& text) { m.custom += text == "x"; }));
  all.push_back(node->create_generic_subscription(
      "topic", "std_msgs/msg/String", 10,
      [&](std::shared_ptr<rclcpp::SerializedMessage> message) { m.bytes += message->size() > 4; }));
  auto publisher = node->create_publisher<String>("topic", 10);
  String message;
  message.data = "x";
  publisher->publish(message);
  spin(node, [&]() { return m.bytes == 2 && m.custom == 1; });
  check("signatures", m.reference == 1 && m.info == 1 && m.shared == 1 && m.constant == 1 &&
                          m.unique == 1 && m.bytes == 2 && m.custom == 1);
  check("subscriptions counted", publisher->get_subscription_count() == all.size());
}

void ownership() {
  auto node = std::make_shared<rclcpp::Node>("ownership");
  const void* sent = nullptr;
  const void* got = nullptr;
  auto subscription = node->create_subscription<String>(
      "own", 10, [&](String::UniquePtr message) { got = message.get(); });
  auto publisher = node->create_publisher<String>("own", 10);
  auto message = std::make_unique<String>();
  sent = message.get();
  publisher->publish(std::move(message));
  spin(node, [&]() { return got != nullptr; });
  check("unique message is not copied", got == sent);
  auto looked = std::make_shared<String>();
  publisher->publish(*looked);
  got = nullptr;
  spin(node, [&]() { return got != nullptr; });
  check("looked-at message is copied", got != looked.get());
}

void parameters() {
  auto node = std::make_shared<rclcpp::Node>("parameters");
  check("default", node->declare_parameter("rate", 3) == 3);
  check("override", node->declare_parameter<std::string>("name", "none") == "given");
  check("list",
        node->declare_parameter<std::vector<double>>("gains") == std::vector<double>({1.5, 2.0}));
  check("declared twice",
        throws([&]() { node->declare_parameter("rate", 3); }, "has already been declared"));
  check("not declared", throws([&]() { node->get_parameter("nothing"); }, "nothing"));
  check("wrong type", throws([&]() { node->declare_parameter<int>("text"); }, "not allowed"));
  rcl_interfaces::msg::ParameterDescriptor range;
  range.integer_range.resize(1);
  range.integer_range[0].from_value = 0;
  range.integer_range[0].to_value = 10;
  range.integer_range[0].step = 2;
  node->declare_parameter("even", 4, range);
  check("range", node->set_parameter(rclcpp::Parameter("even", 5)).reason ==
                     "Parameter {even} doesn't comply with integer range.");
  check("type kept", !node->set_parameter(rclcpp::Parameter("even", "x")).successful);
  int before = 0, after = 0;
  auto pre = node->add_pre_set_parameters_callback(
      [&](std::vector<rclcpp::Parameter>& changes) { before += changes.size(); });
  auto during =
      node->add_on_set_parameters_callback([](const std::vector<rclcpp::Parameter>& changes) {
        rcl_interfaces::msg::SetParametersResult result;
        result.successful = changes[0].as_int() != 8;
        result.reason = "not eight";
        return result;
      });
  auto post = node->add_post_set_parameters_callback(
      [&](const std::vector<rclcpp::Parameter>& changes) { after += changes.size(); });
  check("refused", node->set_parameter(rclcpp::Parameter("even", 8)).reason == "not eight");
  check("set", node->set_parameter(rclcpp::Parameter("even", 6)).successful);
  check("called around", before == 2 && after == 1);
  auto client = std::make_shared<rclcpp::SyncParametersClient>(node);
  check("client", client->get_parameter<int>("even") == 6);
  check("list of names", client->list_parameters({"even"}, 0).names.size() == 1);
  node->set_parameter(rclcpp::Parameter("even", 2));
  check("printed", std::to_string(node->get_parameter("even")) ==
                       "{\"name\": \"even\", \"type\": \"integer\", \"value\": \"2\"}");
}

void executors() {
  auto node = std::make_shared<rclcpp::Node>("executors");
  std::set<std::thread::id> threads;
  std::mutex mutex;
  std::atomic<int> together{0}, most{0}, calls{0};
  const auto work = [&]() {
    most = std::max<int>(most, ++together);
    {
      std::lock_guard<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
    const auto until = std::chrono::steady_clock::now() + 20ms;
    while (std::chrono::steady_clock::now() < until && most < 2) std::this_thread::yield();
    --together;
    ++calls;
  };
  auto group = node->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  auto one = node->create_wall_timer(1ms, work, group);
  auto two = node->create_wall_timer(1ms, work, group);
  rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 4);
  executor.add_node(node);
  check("added twice", throws([&]() { executor.add_node(node); }, "already been added"));
  auto stop = node->create_wall_timer(10ms, [&]() {
    if (most >= 2 && calls > 10) executor.cancel();
  });
  executor.spin();
  check("reentrant callbacks run together", most >= 2);
  // It would end what is spun below before anything of that has run.
  stop->cancel();
  executor.remove_node(node);

  std::atomic<int> alone{0}, worst{0}, count{0};
  auto exclusive = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  const auto careful = [&]() {
    worst = std::max<int>(worst, ++alone);
    std::this_thread::yield();
    --alone;
    ++count;
  };
  auto three = node->create_wall_timer(1ms, careful, exclusive);
  auto four = node->create_wall_timer(1ms, careful, exclusive);
  auto end = node->create_wall_timer(5ms, [&]() {
    if (count > 20) executor.cancel();
  });
  executor.add_node(node);
  executor.spin();
  check("exclusive callbacks run alone", worst == 1);
  executor.remove_node(node);

  std::promise<void> never;
  auto future = never.get_future().share();
  check("future in time", rclcpp::spin_until_future_complete(node, future, 30ms) ==
                              rclcpp::FutureReturnCode::TIMEOUT);
  one->cancel();
  two->cancel();
}

void wait_sets() {
  auto node = std::make_shared<rclcpp::Node>("wait_sets");
  auto subscription = node->create_subscription<Int32>("numbers", 10, [](Int32::UniquePtr) {});
  auto guard = std::make_shared<rclcpp::GuardCondition>();
  rclcpp::WaitSet set({{subscription}}, {guard});
  check("nothing to wait for", set.wait(1ms).kind() == rclcpp::WaitResultKind::Timeout);
  guard->trigger();
  {
    const auto result = set.wait(5s);
    check("guard condition", result.kind() == rclcpp::WaitResultKind::Ready &&
                                 result.get_wait_set().get_rcl_wait_set().guard_conditions[0]);
  }
  auto publisher = node->create_publisher<Int32>("numbers", 10);
  Int32 number;
  number.data = 5;
  publisher->publish(number);
  Int32 read;
  rclcpp::MessageInfo info;
  {
    const auto result = set.wait(5s);
    check("message taken", result.kind() == rclcpp::WaitResultKind::Ready &&
                               subscription->take(read, info) && read.data == 5);
  }
  check("nothing more", !subscription->take(read, info));
  rclcpp::WaitSet other;
  check("in one set only", throws([&]() { other.add_subscription(subscription); }, "in use"));
  set.remove_subscription(subscription);
  std::thread later([&]() { publisher->publish(number); });
  Int32 waited;
  check("waited for", rclcpp::wait_for_message(waited, subscription,
                                               rclcpp::contexts::get_global_default_context(), 5s));
  later.join();
}

void times() {
  const rclcpp::Time a(2, 500000000, RCL_ROS_TIME), b(1, 0, RCL_ROS_TIME);
  check("difference", (a - b).seconds() == 1.5);
  check("other clock", throws([&]() { (void)(a < rclcpp::Time(0, 0, RCL_SYSTEM_TIME)); },
                              "different time sources"));
  builtin_interfaces::msg::Duration negative = rclcpp::Duration::from_seconds(-0.25);
  check("negative duration", negative.sec == -1 && negative.nanosec == 750000000u);
  check("overflow",
        throws([]() { (void)(rclcpp::Duration::max() + rclcpp::Duration(1s)); }, "overflow"));
  check("expanded", rclcpp::expand_topic_or_service_name("~/x", "n", "/a") == "/a/n/x");
  rclcpp::WallRate rate(1000.0);
  check("rate", rate.sleep() && rate.period() == 1ms);
}

void echo() {
  auto node = std::make_shared<rclcpp::Node>("probe");
  auto publisher = node->create_publisher<String>("out", 10);
  auto latched = node->create_publisher<String>("map", rclcpp::QoS(1).transient_local());
  String map;
  map.data = "last";
  latched->publish(map);
  auto subscription = node->create_subscription<String>("in", 10, [&](const String& message) {
    String answer;
    answer.data = message.data + " back";
    publisher->publish(answer);
  });
  auto service =
      node->create_service<AddTwoInts>("add", [](const std::shared_ptr<AddTwoInts::Request> request,
                                                 std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a + request->b;
      });
  node->declare_parameter("rate", 3);
  node->declare_parameter("name", "none");
  say(std::string("ready ") + node->get_fully_qualified_name());
  RCLCPP_INFO(node->get_logger(), "I am %s", node->get_name());
  rclcpp::spin(node);
  say("spun");
}

void ask() {
  auto node = std::make_shared<rclcpp::Node>("asker");
  auto client = node->create_client<AddTwoInts>("add");
  client->wait_for_service();
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 2;
  request->b = 3;
  auto future = client->async_send_request(request);
  rclcpp::spin_until_future_complete(node, future);
  say("sum " + std::to_string(future.get()->sum));
}

void act() {
  auto node = std::make_shared<rclcpp::Node>("actor");
  auto client = rclcpp_action::create_client<Fibonacci>(node, "fibonacci");
  client->wait_for_action_server();
  auto options = rclcpp_action::Client<Fibonacci>::SendGoalOptions();
  int feedback = 0;
  bool done = false;
  options.feedback_callback = [&](rclcpp_action::ClientGoalHandle<Fibonacci>::SharedPtr,
                                  const std::shared_ptr<const Fibonacci::Feedback>) { ++feedback; };
  options.result_callback =
      [&](const rclcpp_action::ClientGoalHandle<Fibonacci>::WrappedResult& result) {
        say("result " + std::to_string(static_cast<int>(result.code)) + " " +
            std::to_string(result.result->sequence.size()));
        done = true;
      };
  Fibonacci::Goal goal;
  goal.order = 5;
  client->async_send_goal(goal, options);
  spin(node, [&]() { return done; });
  say(feedback ? "feedback came" : "no feedback");
}

void serve_action() {
  auto node = std::make_shared<rclcpp::Node>("actions");
  using Handle = rclcpp_action::ServerGoalHandle<Fibonacci>;
  std::vector<std::thread> threads;
  auto server = rclcpp_action::create_server<Fibonacci>(
      node, "fibonacci",
      [](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal> goal) {
        return goal->order > 40 ? rclcpp_action::GoalResponse::REJECT
                                : rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](const std::shared_ptr<Handle>) { return rclcpp_action::CancelResponse::ACCEPT; },
      [&](const std::shared_ptr<Handle> handle) {
        threads.emplace_back([handle]() {
          auto feedback = std::make_shared<Fibonacci::Feedback>();
          feedback->sequence = {0, 1};
          auto result = std::make_shared<Fibonacci::Result>();
          const bool waits = handle->get_goal()->order == 40;
          for (int i = 1; rclcpp::ok() && (waits || i < handle->get_goal()->order); ++i) {
            if (handle->is_canceling()) {
              handle->canceled(result);
              return;
            }
            if (!waits)
              feedback->sequence.push_back(feedback->sequence[i] + feedback->sequence[i - 1]);
            handle->publish_feedback(feedback);
            rclcpp::sleep_for(waits ? 5ms : 1ms);
          }
          result->sequence = feedback->sequence;
          if (rclcpp::ok()) handle->succeed(result);
        });
      });
  say("ready");
  rclcpp::spin(node);
  for (auto& one : threads) one.join();
}

class Managed : public rclcpp_lifecycle::LifecycleNode {
 public:
  Managed() : LifecycleNode("managed") {
    publisher_ = create_publisher<String>("out", 10);
    timer_ = create_wall_timer(5ms, [this]() { publisher_->publish(String()); });
  }
  CallbackReturn on_configure(const rclcpp_lifecycle::State& from) override {
    say("configured from " + from.label());
    return CallbackReturn::SUCCESS;
  }
  CallbackReturn on_activate(const rclcpp_lifecycle::State& from) override {
    LifecycleNode::on_activate(from);
    say("activated");
    return CallbackReturn::SUCCESS;
  }
  CallbackReturn on_cleanup(const rclcpp_lifecycle::State&) override {
    throw std::runtime_error("cannot clean up");
  }
  CallbackReturn on_error(const rclcpp_lifecycle::State&) override {
    say("error");
    return CallbackReturn::SUCCESS;
  }

 private:
  rclcpp_lifecycle::LifecyclePublisher<String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

void sim_time() {
  auto node = std::make_shared<rclcpp::Node>("timed");
  int calls = 0;
  auto timer = rclcpp::create_timer(node, node->get_clock(), rclcpp::Duration(1s), [&]() {
    say("tick " + std::to_string(++calls) + " at " + std::to_string(node->now().nanoseconds()));
  });
  say(node->get_clock()->ros_time_is_active() ? "simulated" : "wall");
  say("ready");
  rclcpp::spin(node);
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "inside") {
    times();
    signatures();
    ownership();
    parameters();
    executors();
    wait_sets();
  } else if (what == "echo") {
    echo();
  } else if (what == "ask") {
    ask();
  } else if (what == "act") {
    act();
  } else if (what == "serve_action") {
    serve_action();
  } else if (what == "sim_time") {
    sim_time();
  } else if (what == "managed") {
    auto node = std::make_shared<Managed>();
    say("ready");
    rclcpp::spin(node->get_node_base_interface());
  }
  rclcpp::shutdown();
  say("end");
}
