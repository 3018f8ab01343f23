/* Goes before the compiler: takes out of a user's flags what would not work here.
 *
 *   compiler_words COMPILER WORDS…
 *
 * -march=native and the like: what is compiled is kept and may run on another machine, and Eigen's
 *   types would differ from the runtime's.
 * -std= below C++17: the headers of the runtime need it.
 * -Werror: written for another compiler and other headers.
 *
 * GAZELLE_PRECOMPILED names a table, a line "SOURCE<tab>HEADER" each: HEADER is included first, for
 * there is a compiled one beside it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int starts(const char* word, const char* start) {
  return strncmp(word, start, strlen(start)) == 0;
}

static int is_old_standard(const char* word) {
  static const char* const old[] = {"98", "03", "0x", "11", "1y", "14", "1z"};
  const char* name = 0;
  size_t index;
  if (starts(word, "-std=c++")) {
    name = word + strlen("-std=c++");
  } else if (starts(word, "-std=gnu++")) {
    name = word + strlen("-std=gnu++");
  }
  for (index = 0; name && index < sizeof old / sizeof *old; ++index) {
    if (strcmp(name, old[index]) == 0) {
      return 1;
    }
  }
  return 0;
}

static int is_left_out(const char* word) {
  return strcmp(word, "-march=native") == 0 || strcmp(word, "-mtune=native") == 0 ||
         strcmp(word, "-mcpu=native") == 0 || strcmp(word, "-Werror") == 0 ||
         starts(word, "-Werror=") || strcmp(word, "-pedantic-errors") == 0 ||
         strcmp(word, "-fgnu-unique") == 0 || strcmp(word, "-static") == 0 ||
         starts(word, "-ffp-contract=f");
}

/* The header that a source includes first, by the table; a new string, or null. */
static char* precompiled(const char* table, const char* source) {
  static char line[8192];
  size_t length = strlen(source);
  char* found = 0;
  FILE* file = fopen(table, "r");
  if (!file) {
    return 0;
  }
  while (!found && fgets(line, sizeof line, file)) {
    if (strncmp(line, source, length) == 0 && line[length] == '\t') {
      line[strcspn(line, "\n")] = 0;
      found = strdup(line + length + 1);
    }
  }
  fclose(file);
  return found;
}

int main(int argc, char** argv) {
  const char* table = getenv("GAZELLE_PRECOMPILED");
  const char* source = 0;
  char* header = 0;
  char** words = calloc((size_t)argc + 5, sizeof *words);
  int from;
  int count = 0;
  if (argc < 2 || !words) {
    return 2;
  }
  for (from = 2; from + 1 < argc; ++from) {
    if (strcmp(argv[from], "-c") == 0) {
      source = argv[from + 1];
    }
  }
  words[count++] = argv[1];
  if (table && source && (header = precompiled(table, source))) {
    words[count++] = "-include";
    words[count++] = header;
    /* What the compiled header was made of counts as read: it is looked at for changes. */
    words[count++] = "-fpch-deps";
  }
  for (from = 2; from < argc; ++from) {
    if (is_old_standard(argv[from])) {
      words[count++] = "-std=gnu++17";
    } else if (!is_left_out(argv[from])) {
      words[count++] = argv[from];
    }
  }
  execvp(words[0], words);
  perror(words[0]);
  return 127;
}
