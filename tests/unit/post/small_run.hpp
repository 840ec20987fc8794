#pragma once
#include <stdlib.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "post/files/frame.hpp"
#include "tests/catch.hpp"

/// What the tests of the writers share: a folder of their own, a full disk, a plate of six points.
namespace small_run {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The warnings in the text of a summary.json.
inline std::vector<std::string> warnings_in(const std::string& json) {
  std::vector<std::string> result;
  const auto list = json.find("\"warnings\": [");
  if (list == std::string::npos) return result;
  for (auto at = json.find('[', list) + 1; at < json.size() && json[at] != ']'; ++at) {
    if (json[at] != '"') continue;
    auto& text = result.emplace_back();
    while (++at < json.size() && json[at] != '"') {
      if (json[at] == '\\') ++at;
      text += json[at];
    }
  }
  return result;
}

/// True where a warning names a value to set, or where it only says how the case was read or what it comes to.
inline bool says_what_to_set(const std::string& warning) {
  static constexpr std::array notes{" taken to end there",
                                    " taken as",
                                    " overrides the unit",
                                    "computed with its image",
                                    " of the case not used",
                                    " loads cancel",
                                    " along w cancel",
                                    " in the plane cancel",
                                    "no load does so",
                                    "too many to look for",
                                    "buckle in",
                                    "accuracy not reached",
                                    "reactions balance the",
                                    "left out",
                                    "chords of curves are",
                                    "the plate snaps"};
  return warning.find("set ") != std::string::npos ||
         std::ranges::any_of(notes, [&](const char* note) { return warning.find(note) != std::string::npos; });
}

/// Checks that warnings in every summary.json below a folder have at most 25 words, 3 of them for "load case NAME: ",
/// name settings by their keys, and say what to set.
inline void check_warnings(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code none;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, none), end;
       !none && entry != end; entry.increment(none)) {
    if (entry->path().filename() != "summary.json" || !entry->is_regular_file(none)) continue;
    for (const auto& warning : warnings_in(text_of(entry->path()))) {
      const bool named = warning.starts_with("load case ");
      std::istringstream words(named ? warning.substr(warning.find(": ") + 1) : warning);
      INFO(warning);
      CHECK(warning.find('`') == std::string::npos);
      CHECK(says_what_to_set(warning));
      CHECK(std::distance(std::istream_iterator<std::string>(words), {}) <= (named ? 22 : 25));
    }
  }
}

/// A folder that is removed at the end, after a look at the warnings of the runs in it.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pdplate_test_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    if (std::uncaught_exceptions() == 0) check_warnings(path_);
    std::filesystem::remove_all(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

private:
  std::filesystem::path path_;
};

/// While it lives, no file can grow beyond `bytes`: to the writers, a disk that is full.
class FullDisk {
public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  rlimit before_{};
  void (*handler_)(int);
};

/// A square of four points, a triangle beside it, and a point that no cell uses.
inline post::Mesh mesh() {
  post::Mesh mesh;
  mesh.positions = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0.5}, {5, 5}};
  mesh.areas = {1, 1, 1, 1, 0.5, 0.25};
  mesh.cut = {0, 0.1, 0.2, 0.3, 0.4, 0.5};
  mesh.quads = {{0, 1, 3, 2}};
  mesh.triangles = {{1, 4, 3}};
  mesh.spacing = 1;
  mesh.thickness = 0.1;
  return mesh;
}

/// Numbers that differ from each other, so that a mixed-up component shows.
inline post::Frame frame(double time, std::size_t step, Eigen::Index points = 6) {
  post::Frame frame;
  frame.time = time;
  frame.step = step;
  const auto numbers = [&](Eigen::Index rows, double first) {
    const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(rows * points, first, first + 1) / 3;
    return Eigen::MatrixXd(values.reshaped(rows, points));
  };
  frame.state = numbers(3, 1 + time);
  frame.resultants.moments = numbers(3, 10);
  frame.resultants.shear = numbers(2, 20);
  frame.resultants.von_mises = numbers(1, 30).transpose();
  frame.damage.assign(static_cast<std::size_t>(points), 0.125);
  return frame;
}

}  // namespace small_run
