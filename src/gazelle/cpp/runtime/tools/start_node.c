/* The interpreter of nodes' files: starts Python with the host of nodes for the file that was run.
 *
 * The system runs this program in place of its dynamic linker, so nothing of the node's file, of
 * its libraries or of the C library has been loaded or initialised. Therefore it has no C library
 * either: three system calls are all that it needs.
 */
#define MOST_WORDS 4096
#define LONGEST_PATH 4096

#if defined(__x86_64__)
static long system_call(long number, long a, long b, long c) {
  long result;
  __asm__ volatile("syscall"
                   : "=a"(result)
                   : "a"(number), "D"(a), "S"(b), "d"(c)
                   : "rcx", "r11", "memory");
  return result;
}
enum { NUMBER_WRITE = 1, NUMBER_EXECVE = 59, NUMBER_EXIT = 60, NUMBER_READLINK = 89 };
static long read_link(const char* path, char* to, long size) {
  return system_call(NUMBER_READLINK, (long)path, (long)to, size);
}
__asm__(
    ".globl _start\n_start:\n  xor %ebp, %ebp\n  mov %rsp, %rdi\n  and $-16, %rsp\n  call begin\n");
#elif defined(__aarch64__)
static long system_call4(long number, long a, long b, long c, long d) {
  register long x8 __asm__("x8") = number;
  register long x0 __asm__("x0") = a;
  register long x1 __asm__("x1") = b;
  register long x2 __asm__("x2") = c;
  register long x3 __asm__("x3") = d;
  __asm__ volatile("svc 0" : "+r"(x0) : "r"(x8), "r"(x1), "r"(x2), "r"(x3) : "memory");
  return x0;
}
static long system_call(long number, long a, long b, long c) {
  return system_call4(number, a, b, c, 0);
}
enum { NUMBER_WRITE = 64, NUMBER_EXECVE = 221, NUMBER_EXIT = 93, NUMBER_READLINKAT = 78 };
static long read_link(const char* path, char* to, long size) {
  return system_call4(NUMBER_READLINKAT, -100, (long)path, (long)to, size);
}
__asm__(".globl _start\n_start:\n  mov x29, #0\n  mov x0, sp\n  bl begin\n");
#else
#error "nodes' files are started by launchers only on this machine"
#endif

static const char* words[MOST_WORDS];
static char file[LONGEST_PATH];

static long length_of(const char* text) {
  long length = 0;
  while (text[length]) {
    ++length;
  }
  return length;
}

/* The value of a variable of the environment, null where it is not set. */
static const char* value_of(char** environment, const char* name) {
  for (; *environment; ++environment) {
    long index = 0;
    while (name[index] && (*environment)[index] == name[index]) {
      ++index;
    }
    if (!name[index] && (*environment)[index] == '=') {
      return *environment + index + 1;
    }
  }
  return 0;
}

static void say(const char* text) { system_call(NUMBER_WRITE, 2, (long)text, length_of(text)); }

__attribute__((used, noreturn)) static void begin(long* stack) {
  long count = stack[0];
  char** arguments = (char**)(stack + 1);
  char** environment = arguments + count + 1;
  const char* python = value_of(environment, "GAZELLE_PYTHON");
  long from;
  long to = 0;
  long length = read_link("/proc/self/exe", file, sizeof file - 1);
  if (!python || !*python) {
    python = GAZELLE_PYTHON;
  }
  if (length > 0) {
    words[to++] = python;
#ifdef GAZELLE_PATH
    words[to++] = "-c";
    words[to++] = "import sys; sys.path.insert(1, '" GAZELLE_PATH
                  "'); import runpy; "
                  "runpy.run_module('gazelle.cpp.host', run_name='__main__', alter_sys=True)";
#else
    words[to++] = "-m";
    words[to++] = "gazelle.cpp.host";
#endif
    words[to++] = file;
    for (from = 1; from < count && to < MOST_WORDS - 1; ++from) {
      words[to++] = arguments[from];
    }
    system_call(NUMBER_EXECVE, (long)python, (long)words, (long)environment);
  }
  say("cannot start Python for this node: ");
  say(python);
  say("\n");
  system_call(NUMBER_EXIT, 126, 0, 0);
  for (;;) {
  }
}
