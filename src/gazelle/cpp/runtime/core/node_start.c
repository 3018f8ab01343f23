/* Part of every node's file: makes a shared library something that can be started.
 *
 * The file's interpreter is a small program of Gazelle's, which starts Python with the host of
 * nodes; the host loads this file and calls main through the pointer below. main itself is hidden,
 * for Python's program exports one of its own, and the first one of a process would be found.
 */
#ifdef __cplusplus
#error "this file is C"
#endif

/* What nothing refers to is kept by linkers that leave such things out. */
#if defined(__has_attribute)
#if __has_attribute(retain)
#define KEPT used, retain
#endif
#endif
#ifndef KEPT
#define KEPT used
#endif

extern int main(int argc, char** argv) __attribute__((visibility("hidden")));

__attribute__((visibility("default"), KEPT)) int (*gazelle_node_main)(int, char**) = main;

__attribute__((visibility("default"), KEPT)) const char gazelle_node_mark[] = "gazelle-node-abi-1";

#ifdef GAZELLE_INTERPRETER
__attribute__((section(".interp"), KEPT)) static const char interpreter[] = GAZELLE_INTERPRETER;
#endif
