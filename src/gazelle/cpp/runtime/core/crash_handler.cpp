#include "crash_handler.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "gazelle/export.hpp"

// Where the program is compiled with AddressSanitizer, that tells more.
extern "C" __attribute__((weak)) void __asan_init();

namespace gazelle {

namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
constexpr int kMostFrames = 40;
constexpr unsigned kMostSeconds = 5;
constexpr std::size_t kStackBytes = 256 * 1024;

const char* name_of(int number) {
  switch (number) {
    case SIGSEGV:
      return "SIGSEGV: memory that is not the program's";
    case SIGBUS:
      return "SIGBUS: memory that cannot be reached";
    case SIGFPE:
      return "SIGFPE: a number that cannot be computed, such as a division by zero";
    case SIGILL:
      return "SIGILL: an instruction that there is not";
    case SIGABRT:
      return "SIGABRT: the program gave up";
    case SIGTRAP:
      return "SIGTRAP";
    default:
      return "SIGSYS";
  }
}

void say(const char* text) {
  std::size_t left = std::strlen(text);
  while (left > 0) {
    const ssize_t size = write(STDERR_FILENO, text, left);
    if (size <= 0) return;
    text += size;
    left -= static_cast<std::size_t>(size);
  }
}

// What addr2line of the compiler's own tools knows: a function's name, and file and line where
// there is debug information.
struct Place {
  char name[512] = "";
  char line[512] = "";
};

void take_line(const char*& at, char* into, std::size_t size) {
  const std::size_t length = std::strcspn(at, "\n");
  if (length < size && at[0] != '?') {
    std::memcpy(into, at, length);
    into[length] = '\0';
    // "(discriminator 3)" is of interest to compilers only.
    if (char* more = std::strstr(into, " (discriminator")) *more = '\0';
  }
  at += at[length] == '\n' ? length + 1 : length;
}

Place place_of(const char* file, std::uintptr_t offset) {
  Place found;
  int ends[2];
  if (pipe(ends) != 0) return found;
  char address[32];
  std::snprintf(address, sizeof address, "0x%zx", static_cast<std::size_t>(offset));
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    execlp("addr2line", "addr2line", "-f", "-C", "-e", file, address, nullptr);
    _exit(127);
  }
  close(ends[1]);
  char text[1024] = "";
  std::size_t size = 0;
  while (child > 0 && size + 1 < sizeof text) {
    const ssize_t more = read(ends[0], text + size, sizeof text - 1 - size);
    if (more <= 0) break;
    size += static_cast<std::size_t>(more);
  }
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  text[size] = '\0';
  const char* at = text;
  take_line(at, found.name, sizeof found.name);
  take_line(at, found.line, sizeof found.line);
  return found;
}

const char* base_of(const char* path) {
  const char* slash = path != nullptr ? std::strrchr(path, '/') : nullptr;
  return slash != nullptr ? slash + 1 : path != nullptr ? path : "";
}

bool begins(const char* text, const char* with) {
  return std::strncmp(text, with, std::strlen(with)) == 0;
}

// Where libraries of the system and of the runtime go wrong, whoever called them is to look.
bool is_of_system(const char* base) {
  return begins(base, "libc.so") || begins(base, "libpthread") || begins(base, "libstdc++") ||
         begins(base, "libgcc_s") || begins(base, "libc++");
}

bool is_of_user(const char* base) { return !is_of_system(base) && !begins(base, "libgazelle_"); }

void say_frame(int number, void* address, bool is_return) {
  char text[64];
  Dl_info info = {};
  std::snprintf(text, sizeof text, "  #%-2d ", number);
  say(text);
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) {
    std::snprintf(text, sizeof text, "%p\n", address);
    say(text);
    return;
  }
  const auto offset = static_cast<char*>(address) - static_cast<char*>(info.dli_fbase);
  // Where a call returns to, the call stands before.
  Place place;
  if (is_of_user(base_of(info.dli_fname))) {
    place = place_of(info.dli_fname, static_cast<std::uintptr_t>(offset - (is_return ? 1 : 0)));
  }
  if (place.name[0] != '\0') {
    say(place.name);
  } else if (info.dli_sname != nullptr) {
    int status = 0;
    char* readable = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status);
    say(readable != nullptr ? readable : info.dli_sname);
    std::free(readable);
  } else {
    say("?");
  }
  if (place.line[0] != '\0') {
    say(" at ");
    say(place.line);
  } else {
    say(" in ");
    say(info.dli_fname);
    std::snprintf(text, sizeof text, " (+0x%zx)", static_cast<std::size_t>(offset));
    say(text);
  }
  say("\n");
}

// What lies below the program's `main`.
bool is_of_host(void* address) {
  Dl_info info = {};
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return false;
  const char* base = base_of(info.dli_fname);
  const char* name = info.dli_sname != nullptr ? info.dli_sname : "";
  return begins(base, "libffi") || begins(base, "_ctypes") || begins(base, "python") ||
         begins(base, "libpython") || std::strcmp(name, "gazelle_run_main") == 0;
}

bool is_of_system(void* address) {
  Dl_info info = {};
  return dladdr(address, &info) != 0 && is_of_system(base_of(info.dli_fname));
}

void on_crash(int number, siginfo_t* info, void*) {
  // What follows is more than a handler may do; a second crash, or a lock that is held, ends it.
  std::signal(SIGALRM, SIG_DFL);
  sigset_t alarms;
  sigemptyset(&alarms);
  sigaddset(&alarms, SIGALRM);
  pthread_sigmask(SIG_UNBLOCK, &alarms, nullptr);
  alarm(kMostSeconds);
  char text[160];
  std::snprintf(text, sizeof text, "\n%s", name_of(number));
  say(text);
  if (number == SIGSEGV || number == SIGBUS) {
    std::snprintf(text, sizeof text, " (address %p)", info->si_addr);
    say(text);
  }
  say("\nthe crash came about in, latest first:\n");
  void* frames[kMostFrames];
  const int count = backtrace(frames, kMostFrames);
  // The first two are this handler and the kernel's way into it.
  int first = 2;
  // How a program gives up is of no interest.
  while (number == SIGABRT && first + 1 < count && is_of_system(frames[first])) ++first;
  int shown = 0;
  for (int i = first; i < count && !is_of_host(frames[i]); ++i) {
    say_frame(shown++, frames[i], i != 2);
  }
  alarm(0);
  // As it would have ended without us, so that whoever launched it sees the signal.
  std::signal(number, SIG_DFL);
  sigset_t own;
  sigemptyset(&own);
  sigaddset(&own, number);
  pthread_sigmask(SIG_UNBLOCK, &own, nullptr);
  raise(number);
}

}  // namespace

void install_crash_handler() {
  if (&__asan_init != nullptr) return;
  // Loads what backtrace() needs now: in a handler that would be too late.
  void* frames[1];
  backtrace(frames, 1);
  // A stack of its own, as a stack that has run over is a crash, too.
  void* memory =
      mmap(nullptr, kStackBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory != MAP_FAILED) {
    stack_t stack = {};
    stack.ss_sp = memory;
    stack.ss_size = kStackBytes;
    sigaltstack(&stack, nullptr);
  }
  struct sigaction action = {};
  action.sa_sigaction = &on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (int number : kSignals) {
    struct sigaction before;
    // One that the program, or whoever debugs it, has installed stays.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) {
      sigaction(number, &action, nullptr);
    }
  }
}

}  // namespace gazelle
