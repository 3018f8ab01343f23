#include "host.hpp"

#include <pthread.h>

#include <atomic>
#include <cstring>
#include <iostream>
#include <string>
#include <utility>

#include "gazelle/core.hpp"
#include "listeners.hpp"
#include "registry.hpp"

namespace gazelle {

namespace {

// Nothing of the core is ever destroyed: users' own statics may still call when exit() runs.
struct Attached {
  std::atomic<const gazelle_host*> table{nullptr};
  Listeners<> on_detach;
  Listeners<> on_graph_change;
  std::mutex events_mutex;
  std::unordered_map<std::uint64_t, std::shared_ptr<std::function<void(const Json&)>>> events;
  std::uint64_t last_event = 0;
};

Attached& attached() {
  static auto* one = new Attached;
  return *one;
}

void append(void* context, const std::uint8_t* data, std::size_t size) {
  static_cast<std::string*>(context)->append(reinterpret_cast<const char*>(data), size);
}

}  // namespace

namespace host {

const gazelle_host* table() { return attached().table.load(std::memory_order_acquire); }

SignalsBlocked::SignalsBlocked() {
  sigset_t all;
  sigfillset(&all);
  // What a thread does wrong itself is told by these; blocked, the kernel would end the process
  // without a word.
  for (int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS}) {
    sigdelset(&all, number);
  }
  // What Python starts meanwhile inherits the mask, and would never hear of its own children's end.
  sigdelset(&all, SIGCHLD);
  pthread_sigmask(SIG_BLOCK, &all, &before_);
}

SignalsBlocked::~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

Bytes lent(const std::uint8_t* data, std::size_t size, void* owner) {
  if (owner == nullptr) return Bytes(std::vector<std::uint8_t>(data, data + size));
  return {data, size, std::shared_ptr<const void>(owner, [](void* held) {
            if (const gazelle_host* host = table()) host->release(held);
          })};
}

void call_at_end(const std::string& verb, const Json& request) {
  try {
    call(verb, request);
  } catch (const std::exception& error) {
    std::cerr << verb << ": " << error.what() << std::endl;
  }
}

void on_detach(std::function<void()> listener) { attached().on_detach.add(std::move(listener)); }

}  // namespace host

Json call(const std::string& verb, const Json& request) {
  const gazelle_host* host = host::table();
  if (host == nullptr) return {};
  const std::string text = request.dump();
  std::string answer;
  int status;
  {
    host::SignalsBlocked quiet;
    status = host->call(verb.c_str(), reinterpret_cast<const std::uint8_t*>(text.data()),
                        text.size(), &append, &answer);
  }
  if (status == GAZELLE_OK) return answer.empty() ? Json() : Json::parse(answer);
  if (status == GAZELLE_CLOSED) return {};
  // The kind of error stands before the first line's end.
  const std::size_t end = answer.find('\n');
  if (end == std::string::npos) throw Error(answer);
  throw Error(answer.substr(end + 1), answer.substr(0, end));
}

bool is_attached() { return host::table() != nullptr; }

std::uint64_t add_event_listener(std::function<void(const Json&)> listener) {
  Attached& all = attached();
  std::lock_guard lock(all.events_mutex);
  all.events[++all.last_event] =
      std::make_shared<std::function<void(const Json&)>>(std::move(listener));
  return all.last_event;
}

void remove_event_listener(std::uint64_t number) {
  Attached& all = attached();
  std::lock_guard lock(all.events_mutex);
  all.events.erase(number);
}

std::uint64_t on_graph_change(std::function<void()> listener) {
  return attached().on_graph_change.add(std::move(listener));
}

void remove_graph_listener(std::uint64_t number) { attached().on_graph_change.remove(number); }

}  // namespace gazelle

extern "C" {

GAZELLE_EXPORT int gazelle_attach(const gazelle_host* host) {
  if (host->version != GAZELLE_ABI_VERSION || host->size < sizeof(gazelle_host)) return 1;
  gazelle::attached().table.store(host, std::memory_order_release);
  return 0;
}

GAZELLE_EXPORT void gazelle_detach(void) {
  gazelle::attached().table.store(nullptr, std::memory_order_release);
  gazelle::attached().on_detach.tell();
}

GAZELLE_EXPORT void gazelle_on_graph_change(void) { gazelle::attached().on_graph_change.tell(); }

GAZELLE_EXPORT void gazelle_on_event(std::uint64_t listener, const std::uint8_t* json,
                                     std::size_t size) {
  auto& all = gazelle::attached();
  std::shared_ptr<std::function<void(const gazelle::Json&)>> function;
  {
    std::lock_guard lock(all.events_mutex);
    auto found = all.events.find(listener);
    if (found != all.events.end()) function = found->second;
  }
  if (function) (*function)(gazelle::Json::parse(reinterpret_cast<const char*>(json), size));
}

}  // extern "C"
