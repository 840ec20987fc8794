#include "cases/studies/isolated_runs.hpp"

#include <omp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include "plate/solve/interruption.hpp"
#include "post/files/summary.hpp"
#include "post/report/quantity.hpp"

namespace cases {
namespace {

Ended caught(const std::function<Ended()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return {RunOutcome::broken, error.what()};
  }
}

void write_all(int to, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto count = ::write(to, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) done += std::size_t(count);
  }
}

/// Reads all that `child` writes. The child is asked to end where this process is, unless it knows. SIGINT: a SIGTERM
/// may have reached both.
std::string read_all(int from, pid_t child, bool passed_on) {
  constexpr int patience = 200;  // [ms]
  std::string text;
  char part[4096];
  for (;;) {
    if (plate::stop_is_asked() && !std::exchange(passed_on, true)) kill(child, SIGINT);
    pollfd ready{from, POLLIN, 0};
    if (poll(&ready, 1, patience) <= 0) continue;
    const auto count = ::read(from, part, sizeof part);
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    if (count > 0) text.append(part, std::size_t(count));
  }
}

double seconds_of(const timeval& spent) {
  return double(spent.tv_sec) + 1e-6 * double(spent.tv_usec);
}

/// The work of the new process. Its first thread is a copy of one that may have led a team which is not here any more:
/// OpenMP would wait for that, so that another thread leads.
[[noreturn]] void work_in_child(const std::function<Ended()>& work, int to, int threads, pid_t parent) {
  setpgid(0, 0);  // Ctrl-C reaches the parent alone, which passes it on
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it has ended before
  Ended ended;
  std::thread([&] {
    omp_set_num_threads(threads);
    ended = caught(work);
  }).join();
  write_all(to, std::string(name_of(ended.outcome)) + "\n" + ended.message);
  std::fflush(nullptr);
  _exit(0);
}

}  // namespace

Ended isolated(const std::function<Ended()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("no pipe: ") + strerror(errno));
  std::fflush(nullptr);  // or both processes would write what waits
  const int threads = omp_get_max_threads();
  const bool knows = plate::stop_is_asked();  // so does the new process
  const pid_t parent = getpid(), child = fork();
  if (child == 0) {
    close(ends[0]);
    work_in_child(work, ends[1], threads, parent);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw std::runtime_error(std::string("no process: ") + strerror(errno));
  }
  const auto said = read_all(ends[0], child, knows);
  close(ends[0]);
  int status = 0;
  rusage used{};
  while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    return {RunOutcome::killed, std::string("the run was ended by signal ") + std::to_string(WTERMSIG(status)) + " (" +
                                    strsignal(WTERMSIG(status)) + ")"};
  const auto line = said.find('\n');
  const auto outcome = line == std::string::npos ? std::nullopt : run_outcome(said.substr(0, line));
  if (!outcome) return {RunOutcome::killed, "the run ended with code " + std::to_string(WEXITSTATUS(status))};
  return {*outcome, said.substr(line + 1), seconds_of(used.ru_utime) + seconds_of(used.ru_stime)};
}

namespace {

std::optional<post::Summary> summary_of(const RunRecord& record, const std::filesystem::path& folder) {
  return post::read_summary(folder / record.run / "summary.json");
}

}  // namespace

std::optional<RunRecord> kept_record(const RunRecord& wanted, std::size_t repeats, const std::filesystem::path& folder,
                                     const Ledger& ledger) {
  auto known = ledger.done(wanted, repeats);
  if (known && !summary_of(wanted, folder)) known.reset();
  return known;
}

RunRecord new_record(RunRecord wanted, std::size_t repeats, const std::filesystem::path& folder, const Ledger& ledger,
                     const std::function<Ended()>& run) {
  ledger.forget(wanted.run);
  std::vector<std::vector<std::pair<std::string, double>>> seconds;
  for (std::size_t i = 0; i < repeats && wanted.outcome == RunOutcome::done; ++i) {
    const auto ended = isolated(run);
    if (ended.outcome == RunOutcome::broken) throw std::runtime_error(ended.message);
    wanted.outcome = ended.outcome, wanted.message = ended.message;
    if (const auto found = summary_of(wanted, folder); found && ended.outcome == RunOutcome::done) {
      seconds.push_back(found->seconds);
      seconds.back().emplace_back("processor", ended.processor_seconds);
    }
  }
  wanted.cost = cost_of(seconds);
  ledger.put(wanted);
  return wanted;
}

std::vector<StudyRow> rows_of(const RunRecord& record, StudyRow row, const std::vector<Wanted>& wanted,
                              const std::filesystem::path& folder) {
  row.outcome = record.outcome;
  row.message = record.message;
  auto summary = summary_of(record, folder);
  if (record.outcome != RunOutcome::done || !summary) return {row};
  summary->seconds = record.cost.seconds;
  if (record.cost.repeats > 1) row.seconds_min = record.cost.least, row.seconds_max = record.cost.most;
  return study_rows(row, wanted, *summary, folder / record.run);
}

}  // namespace cases
