// Life and death of the process: ok(), shutdown, signals, exit, `main`.
#include <cxxabi.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <thread>

#include "crash_handler.hpp"
#include "gazelle/core.hpp"
#include "host.hpp"
#include "listeners.hpp"
#include "waiting.hpp"

namespace gazelle {

namespace {

struct Life {
  std::atomic<bool> is_ending{false};
  std::mutex mutex;
  bool was_told = false;
  std::string reason;
  Listeners<const std::string&> listeners;
  std::once_flag at_exit;
};

Life& life() {
  static auto* one = new Life;
  return *one;
}

// What a signal handler may touch.
std::atomic<int> signal_pipe{-1};
std::atomic<bool>* is_ending_flag = nullptr;
std::atomic<int> last_signal{0};
struct sigaction previous_actions[NSIG];
std::atomic<bool> is_installed[NSIG];

void on_signal(int number, siginfo_t* info, void* context) {
  const int error = errno;
  last_signal.store(number);
  is_ending_flag->store(true);
  const auto word = static_cast<unsigned char>(number);
  if (write(signal_pipe.load(), &word, 1) < 0) {
    // The pipe is full of signals: the thread is on its way already.
  }
  const struct sigaction& before = previous_actions[number];
  if ((before.sa_flags & SA_SIGINFO) != 0) {
    if (before.sa_sigaction != nullptr) before.sa_sigaction(number, info, context);
  } else if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) {
    before.sa_handler(number);
  }
  errno = error;
}

void serve_signals(int pipe_end) {
  unsigned char number = 0;
  while (true) {
    const ssize_t size = read(pipe_end, &number, 1);
    if (size == 1) {
      request_shutdown("signal-" + std::to_string(number));
    } else if (size == 0 || errno != EINTR) {
      return;
    }
  }
}

void start_signal_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    fcntl(ends[1], F_SETFL, O_NONBLOCK);
    is_ending_flag = &life().is_ending;
    signal_pipe = ends[1];
    host::SignalsBlocked quiet;
    std::thread(serve_signals, ends[0]).detach();
  });
}

void end_at_exit() { leave_graph(); }

}  // namespace

void leave_graph_at_exit() {
  std::call_once(life().at_exit, [] { std::atexit(end_at_exit); });
}

bool ok() { return !life().is_ending.load(std::memory_order_relaxed); }

void request_shutdown(const std::string& reason) {
  Life& all = life();
  {
    std::lock_guard lock(all.mutex);
    all.is_ending = true;
    if (all.was_told) return;
    all.was_told = true;
    all.reason = reason;
  }
  wake_all();
  auto functions = all.listeners.copies();
  for (auto one = functions.rbegin(); one != functions.rend(); ++one) (*one)(reason);
}

std::string shutdown_reason() {
  std::lock_guard lock(life().mutex);
  // Whoever sees that the process is to end may be faster than the thread that tells of it.
  if (life().is_ending && !life().was_told && last_signal != 0) {
    return "signal-" + std::to_string(last_signal);
  }
  return life().reason;
}

std::uint64_t on_shutdown(std::function<void(const std::string&)> listener) {
  return life().listeners.add(std::move(listener));
}

void remove_shutdown_listener(std::uint64_t number) { life().listeners.remove(number); }

void reset_shutdown() {
  std::lock_guard lock(life().mutex);
  life().is_ending = false;
  life().was_told = false;
  last_signal = 0;
  life().reason.clear();
}

void install_signal_handlers(const std::vector<int>& numbers) {
  start_signal_thread();
  for (int number : numbers) {
    if (number <= 0 || number >= NSIG || is_installed[number].exchange(true)) continue;
    struct sigaction action = {};
    action.sa_sigaction = &on_signal;
    action.sa_flags = SA_SIGINFO;
    sigfillset(&action.sa_mask);
    sigaction(number, nullptr, &previous_actions[number]);
    sigaction(number, &action, nullptr);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, number);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  }
}

void uninstall_signal_handlers() {
  for (int number = 1; number < NSIG; ++number) {
    if (!is_installed[number].exchange(false)) continue;
    struct sigaction now;
    sigaction(number, nullptr, &now);
    // One that the program has installed since stays.
    if ((now.sa_flags & SA_SIGINFO) != 0 && now.sa_sigaction == &on_signal) {
      sigaction(number, &previous_actions[number], nullptr);
    }
  }
}

void leave_graph() {
  const gazelle_host* host = host::table();
  if (host == nullptr) return;
  std::cout.flush();
  try {
    call("process/leave");
  } catch (const std::exception& error) {
    std::cerr << "leaving the graph: " << error.what() << std::endl;
  }
}

std::string demangled(const char* name) {
  int status = 0;
  char* found = abi::__cxa_demangle(name, nullptr, nullptr, &status);
  if (found == nullptr) return name;
  std::string text = found;
  std::free(found);
  return text;
}

}  // namespace gazelle

extern "C" {

GAZELLE_EXPORT void gazelle_prepare_process(void) {
  gazelle::install_crash_handler();
  gazelle::leave_graph_at_exit();
}

GAZELLE_EXPORT int gazelle_run_main(int (*main)(int, char**, char**), int argc, char** argv) {
  // What the program does not catch nobody below catches either: it ends in std::terminate where
  // it was thrown, with nothing unwound, as in any other process.
  std::exit(main(argc, argv, environ));
}

}  // extern "C"
