/* The table of functions between the host (Python) and the C++ runtime: C types only.
 *
 * No exception and no lock crosses it. It is valid to the end of the process; once the host has
 * shut down, every call is without effect and returns GAZELLE_CLOSED.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GAZELLE_ABI_VERSION 1

/* What a function of the table returns. */
enum gazelle_status {
  GAZELLE_OK = 0,
  GAZELLE_FAILED = 1, /* the sink has been given the error as text */
  GAZELLE_CLOSED = 2  /* the graph was left already */
};

/* Takes a result, or the text of an error, once and before the function returns. */
typedef void (*gazelle_sink)(void* context, const uint8_t* data, size_t size);

/* What the host offers to the runtime. Handles are numbers that a verb of creation has given. */
struct gazelle_host {
  uint32_t version; /* GAZELLE_ABI_VERSION */
  uint32_t size;    /* of this struct, so that a newer host may offer more */

  /* Everything rare: a verb such as "param/get", JSON in, JSON out. */
  int (*call)(const char* verb, const uint8_t* json, size_t size, gazelle_sink sink, void* context);

  /* Send CDR bytes to other processes and to what listens in Python here. The bytes are read
   * before it returns. */
  int (*publish)(uint64_t publisher, const uint8_t* cdr, size_t size, int64_t sequence,
                 int64_t stamp_ns);

  /* Ask a service; gazelle_on_response is called once for `call`: by another thread, or, where
   * is_waiting is not 0, by this one before it returns. timeout_s < 0: as long as it takes. */
  int (*request)(uint64_t client, uint64_t call, const uint8_t* cdr, size_t size, double timeout_s,
                 int is_waiting);

  /* Answer what gazelle_on_request brought; `error` is text where is_error is not 0. */
  int (*respond)(uint64_t request, int is_error, const uint8_t* data, size_t size);

  /* Say something on the console and on /rosout. Levels are those of rcutils: 10 … 50. */
  int (*log)(uint64_t node, int level, const char* text, size_t size, const char* logger,
             const char* file, int line, const char* function);

  /* Let go of what was lent with an owner (gazelle_on_message and the like). */
  void (*release)(void* owner);
};

/* What the runtime offers to the host (exported by libgazelle_core.so). */

/* Take the table; 0, or 1 where it is of another version. */
int gazelle_attach(const struct gazelle_host* host);

/* Make this process one of C++: crashes are told, and exit() leaves the graph. Called before
 * anything of the program is loaded; not where C++ is a guest in a process of Python. */
void gazelle_prepare_process(void);

/* Run the `main` of a node file and end the process with exit(); an exception ends it with abort().
 */
int gazelle_run_main(int (*main)(int, char**, char**), int argc, char** argv);

/* A message from elsewhere. The bytes live until the runtime calls `release(owner)`, or, where the
 * owner is null, until this function returns. */
void gazelle_on_message(uint64_t subscription, const uint8_t* cdr, size_t size, void* owner,
                        const char* type_name, int64_t sequence, int64_t stamp_ns,
                        const uint8_t* gid, const char* publisher);

/* How many ends a publisher or a subscription is matched with on the whole graph, and whether
 * anybody outside of this runtime wants what it publishes (-1: it is a subscription). */
void gazelle_on_matched(uint64_t end, uint64_t count, int is_wanted_elsewhere);

/* A subscriber of a publisher's topic has come or gone; by the global name of its node. */
void gazelle_on_subscriber(uint64_t publisher, const char* node, int is_there);

/* A request; to be answered by `respond(request, …)`. Bytes as with gazelle_on_message. */
void gazelle_on_request(uint64_t server, uint64_t request, const uint8_t* cdr, size_t size,
                        void* owner, const uint8_t* client, int64_t sequence, int64_t stamp_ns,
                        const char* caller);

/* The answer to `request`. status: 0 bytes of the response; 1 text: the handler failed;
 * 2 text: nobody offers it; 3 text: time is up. */
void gazelle_on_response(uint64_t call, int status, const uint8_t* data, size_t size, void* owner,
                         int64_t sequence, int64_t stamp_ns);

/* Who is on the graph has changed. */
void gazelle_on_graph_change(void);

/* Somebody asks for a node to be shut down (rosnode kill, a node of the same name). */
void gazelle_on_node_shutdown(uint64_t node, const char* reason);

/* The clock: wall time (use_sim_time 0), or simulated time that is told (`page` null) or shown
 * on a page of memory (its four numbers, mapped for good). */
void gazelle_on_clock(int use_sim_time, const int64_t* page, int64_t now_ns, int64_t jump_ns);

/* Something that a verb has promised to tell later: a listener's number and JSON. */
void gazelle_on_event(uint64_t listener, const uint8_t* json, size_t size);

/* The graph is left: nothing is called through the table any more. */
void gazelle_detach(void);

#ifdef __cplusplus
}
#endif
