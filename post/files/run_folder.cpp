#include "post/files/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "post/files/atomic_file.hpp"

namespace post {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : opened_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      held_(opened_ < 0 || flock(opened_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {}

namespace {

constexpr auto pause = std::chrono::milliseconds(20);

/// The byte that stands for a name: of 10,000 names two fall together once in 10^10 files.
off_t byte_of(const std::string& name) {
  constexpr int spare = 2;  // offsets are not negative, and their ends neither
  return off_t(std::stoull(digest(name), nullptr, 16) >> spare);
}

}  // namespace

NamedLock::NamedLock(const std::filesystem::path& file, const std::string& name, Use use,
                     std::chrono::milliseconds patience)
    : opened_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (opened_ < 0) throw std::system_error(errno, std::generic_category(), "cannot open " + file.string());
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!(held_ = taken(name, use)) && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(pause);
}

bool NamedLock::taken(const std::string& name, Use use) {
  struct flock wanted = {};
  wanted.l_type = use == Use::alone ? F_WRLCK : F_RDLCK;
  wanted.l_whence = SEEK_SET;
  wanted.l_start = byte_of(name);
  wanted.l_len = 1;
  if (fcntl(opened_, F_OFD_SETLK, &wanted) == 0) return true;
  works_ = errno == EAGAIN || errno == EACCES || errno == EINTR;
  return !works_;
}

namespace {

namespace fs = std::filesystem;

constexpr auto mark = "case.resolved.toml";  // the first file of every run

bool is_result(const std::string& name) {
  static const std::regex names(
      R"((case\.resolved\.toml|summary\.json|state\.h5(\.\d+)?|fields\.pvd|fields_\d{4,}(_\d+)?\.vtu|fields_\d{4,}\.pvtu|cracks(_\d{4,})?\.vtp|cracks\.pvd|)"
      R"(curves\.svg|report\.html|checkpoint(\.before|\.end|\.\d\.\d+)?|)"
      R"((history|probes|lines|crack_springs|load_steps|contact|buckling|reactions|edge_reactions|corner_forces|frequencies|srif|envelope|impact|response|growth|tips|cracks)\.csv)(\.partial)?)");
  return std::regex_match(name, names);
}

}  // namespace

std::vector<std::string> strangers(const fs::path& folder) {
  std::error_code none;
  std::vector<std::string> names;
  if (!fs::is_directory(folder, none) || fs::exists(folder / mark, none)) return names;
  for (const auto& entry : fs::directory_iterator(folder, none)) names.push_back(entry.path().filename().string());
  std::erase(names, std::string(mark) + ".partial");  // of a run that was killed at its first file
  std::ranges::sort(names);
  return names;
}

bool is_of(const fs::path& folder, const std::string& resolved) {
  std::error_code none;
  return fs::exists(folder / mark, none) && read_text(folder / mark) == resolved;
}

std::size_t remove_earlier(const fs::path& folder, Parts parts) {
  std::error_code none;
  if (!fs::exists(folder / mark, none)) return 0;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none) && is_result(entry.path().filename().string())) old.push_back(entry.path());
  // what one could go on from, or take for an end, goes first; the mark last: a folder that was cleared in part is
  // still one of results
  std::ranges::sort(old, {}, [](const fs::path& path) {
    const auto name = path.filename().string();
    const bool first =
        name == "checkpoint" || name == "checkpoint.before" || name == "checkpoint.end" || name == "summary.json";
    return name == mark ? 2 : first ? 0 : 1;
  });
  std::size_t count = 0;
  for (const char* part : {"motion", "ordinary", "galerkin"}) {
    if (parts == Parts::stay) break;
    count += remove_earlier(folder / part);
    if (fs::is_empty(folder / part, none) && !none) fs::remove(folder / part, none);
  }
  for (const auto& path : old) count += fs::remove(path);
  return count;
}

ScratchFolder::ScratchFolder(const std::string& name) {
  auto pattern = (std::filesystem::temp_directory_path() / (name + "_XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder can be made in the place of " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

double ScratchFolder::bytes() const {
  double sum = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(path_))
    if (file.is_regular_file()) sum += double(file.file_size());
  return sum;
}

}  // namespace post
