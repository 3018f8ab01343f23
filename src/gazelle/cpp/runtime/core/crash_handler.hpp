// Says of a crash which signal it was and where, and lets it end the process as it would have.
#pragma once

namespace gazelle {

void install_crash_handler();

// Register leave_graph() with exit(), once: what was made before `main` goes after it.
void leave_graph_at_exit();

}  // namespace gazelle
