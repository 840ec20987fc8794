#pragma once
#include <functional>
#include <string>

namespace post {

/// How a piece of work ended: "done", "refused", "failed", "killed" (its process, by a signal) or "broken" (the
/// machine: no memory, disk full), and why.
struct Ended {
  std::string outcome, message = {};
};

/// Does the work in a process of its own, so that nothing that becomes of it ends this one; it ends with this one. The
/// work returns "done", "refused" or "failed"; what it throws is "broken". Threads: as many as this process would use.
Ended isolated(const std::function<Ended()>& work);

}  // namespace post
