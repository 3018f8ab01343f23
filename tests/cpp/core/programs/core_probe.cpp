// What tests of the core have done: one word says what, in a process of its own.
#include <gazelle/core.hpp>

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {

using gazelle::Bytes;
using gazelle::Delivered;
using gazelle::Qos;

void say(const std::string &text) { std::cout << text << std::endl; }

// A std_msgs/String as CDR.
Bytes text(const std::string &words) {
  std::vector<std::uint8_t> bytes{0, 1, 0, 0};
  const auto size = static_cast<std::uint32_t>(words.size() + 1);
  bytes.resize(8);
  std::memcpy(&bytes[4], &size, 4);
  bytes.insert(bytes.end(), words.begin(), words.end());
  bytes.push_back(0);
  return bytes;
}

std::string words(const Bytes &bytes) {
  return reinterpret_cast<const char *>(bytes.data()) + 8;
}

std::shared_ptr<gazelle::GraphNode> node_named(const std::string &name) {
  gazelle::NodeOptions options;
  options.name = name;
  return gazelle::GraphNode::create(options);
}

constexpr const char *kString = "std_msgs/msg/String";

struct Told {
  explicit Told(const char *name) : name(name) {}
  ~Told() { say(std::string("destroyed ") + name); }
  const char *name;
};
Told global("global");

void await(const std::function<bool()> &condition) {
  while (gazelle::ok() && !condition()) gazelle::clock::wait_wall(2'000'000);
}

// Says back what it hears, with the publisher's name.
int echo() {
  gazelle::install_signal_handlers({SIGINT});
  auto node = node_named("probe");
  auto publisher = node->advertise("out", kString, "string data\n", Qos{});
  auto subscription = node->subscribe("in", kString, Qos{}, [&](Delivered one) {
    publisher->publish_cdr(text(words(one.cdr()) + " from " + one.info().publisher));
  });
  say("ready " + node->full_name());
  await([] { return false; });
  say("ended by " + gazelle::shutdown_reason());
  return 0;
}

int latched() {
  gazelle::install_signal_handlers({SIGINT});
  auto node = node_named("probe");
  gazelle::PublisherOptions options;
  options.latch = true;
  auto publisher = node->advertise("map", kString, "string data\n", Qos{}, options);
  publisher->publish_cdr(text("first"));
  publisher->publish_cdr(text("last"));
  auto late = node->subscribe("map", kString, Qos{},
                              [](Delivered one) { say("late " + words(one.cdr())); });
  say("ready");
  await([] { return false; });
  return 0;
}

int inside() {
  auto node = node_named("probe");
  int count = 0;
  const void *seen = nullptr;
  auto publisher = node->advertise("inside", kString, "string data\n", Qos{});
  auto subscription = node->subscribe("inside", kString, Qos{}, [&](Delivered one) {
    ++count;
    seen = one.cdr().data();
  });
  const Bytes sent = text("x");
  publisher->publish_cdr(sent);
  say("same bytes " + std::to_string(seen == sent.data()));
  subscription.reset();
  publisher->publish_cdr(sent);
  say("count " + std::to_string(count));
  auto other = node->subscribe("inside", "std_msgs/msg/Int32", Qos{},
                               [&](Delivered) { say("wrong type came"); });
  publisher->publish_cdr(sent);
  return 0;
}

int serve() {
  gazelle::install_signal_handlers({SIGINT});
  auto node = node_named("probe");
  static const gazelle::MessageType half{};
  static const gazelle::ServiceType trigger{"std_srvs/srv/Trigger", "std_srvs/Trigger", "", "",
                                            &half, &half};
  std::shared_ptr<gazelle::ServiceServer> server;
  int count = 0;
  server = node->offer("trigger", trigger, [&](const gazelle::RequestId &request, Bytes) {
    if (++count == 2) {
      server->fail(request, "not today");
      return;
    }
    std::vector<std::uint8_t> bytes{0, 1, 0, 0, 1, 0, 0, 0};
    const std::string message = "for " + request.caller;
    const auto size = static_cast<std::uint32_t>(message.size() + 1);
    bytes.resize(12);
    std::memcpy(&bytes[8], &size, 4);
    bytes.insert(bytes.end(), message.begin(), message.end());
    bytes.push_back(0);
    server->respond(request, std::move(bytes));
  });
  say("ready");
  await([] { return false; });
  return 0;
}

int ask() {
  auto node = node_named("probe");
  static const gazelle::MessageType half{};
  static const gazelle::ServiceType trigger{"std_srvs/srv/Trigger", "std_srvs/Trigger", "", "",
                                            &half, &half};
  auto client = node->client("trigger", trigger);
  const auto none = client->call(std::vector<std::uint8_t>{0, 1, 0, 0, 0});
  say("before " + std::to_string(none.status == gazelle::CallStatus::kUnavailable));
  client->wait_for();
  const auto found = client->call(std::vector<std::uint8_t>{0, 1, 0, 0, 0});
  say("answer " + std::string(reinterpret_cast<const char *>(found.response.data()) + 12));
  std::mutex mutex;
  std::map<std::int64_t, bool> done;
  for (int i = 0; i < 5; ++i) {
    client->call_async(std::vector<std::uint8_t>{0, 1, 0, 0, 0}, [&, i](gazelle::CallResult one) {
      std::lock_guard lock(mutex);
      done[i] = one.status == gazelle::CallStatus::kOk;
    });
  }
  await([&] {
    std::lock_guard lock(mutex);
    return done.size() == 5;
  });
  bool all = true;
  for (const auto &one : done) all = all && one.second;
  say("five " + std::to_string(all));
  return 0;
}

// Says the times it wakes at, on the graph's clock.
int sleep_by_clock() {
  gazelle::install_signal_handlers({SIGINT});
  auto node = node_named("probe");
  say("ready " + std::to_string(gazelle::clock::uses_sim_time()));
  await([] { return gazelle::clock::uses_sim_time() && gazelle::clock::now_ns() > 0; });
  say("start " + std::to_string(gazelle::clock::now_ns()));
  gazelle::clock::on_jump([](const gazelle::clock::Jump &jump) {
    if (!jump.clock_changed) say("jump " + std::to_string(jump.delta_ns));
  });
  gazelle::Alarms::at(gazelle::Alarms::Base::kClock, 3'000'000'000,
                      [](gazelle::clock::Wake wake) {
                        say("alarm " + std::to_string(static_cast<int>(wake)));
                      });
  const auto first = gazelle::clock::wait_until(2'000'000'000);
  say("reached " + std::to_string(static_cast<int>(first)));
  const auto second = gazelle::clock::wait_until(1'000'000'000'000);
  say("woken " + std::to_string(static_cast<int>(second)));
  await([] { return false; });
  return 0;
}

__attribute__((noinline)) void fall(volatile int *nowhere) { *nowhere = 1; }
int *volatile nowhere = nullptr;

__attribute__((noinline)) int deeper(volatile int *above) {
  volatile int here[100] = {*above};
  return deeper(here) + here[1];
}

int many() {
  auto node = node_named("probe");
  auto publisher = node->advertise("many", kString, "string data\n", Qos{});
  std::uint64_t count = 0;
  auto subscription = node->subscribe("many", kString, Qos{}, [&](Delivered) { ++count; });
  const Bytes sent = text("x");
  await([&] { return publisher->subscription_count() > 0; });
  gazelle::clock::wait_wall(700'000'000);
  const auto before = gazelle::clock::steady_ns();
  for (int i = 0; i < 200'000; ++i) publisher->publish_cdr(sent);
  const double seconds = static_cast<double>(gazelle::clock::steady_ns() - before) * 1e-9;
  say("count " + std::to_string(count) + " rate " + std::to_string(200'000 / seconds));
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  Told local("local");
  if (what == "echo") return echo();
  if (what == "latched") return latched();
  if (what == "inside") return inside();
  if (what == "serve") return serve();
  if (what == "ask") return ask();
  if (what == "sleep") return sleep_by_clock();
  if (what == "many") return many();
  if (what == "code") return 7;
  if (what == "exit") {
    auto node = node_named("probe");
    std::atexit([] { say("at exit"); });
    std::thread([] { std::exit(5); }).join();
  }
  if (what == "crash") {
    auto node = node_named("probe");
    fall(nowhere);
  }
  if (what == "overflow") {
    volatile int start = 0;
    return deeper(&start);
  }
  if (what == "abort") std::abort();
  if (what == "throw") throw std::runtime_error("nobody catches this");
  if (what == "read") {
    char line[100] = {};
    const ssize_t size = read(STDIN_FILENO, line, sizeof line - 1);
    say("read " + std::to_string(size) + " " + std::string(line, static_cast<std::size_t>(size)));
    std::string word;
    std::cin >> word;
    say("cin " + word);
    return 0;
  }
  if (what == "wait") {
    say("waiting");
    pause();
  }
  if (what == "own-handler") {
    auto node = node_named("probe");
    gazelle::install_signal_handlers({SIGINT});
    std::signal(SIGINT, [](int) {
      static constexpr char kText[] = "own handler\n";
      if (write(STDOUT_FILENO, kText, sizeof kText - 1) > 0) _exit(9);
    });
    say("waiting");
    await([] { return false; });
    return 1;
  }
  if (what == "arguments") {
    for (int i = 0; i < argc; ++i) say(argv[i]);
  }
  return 0;
}
