#include "post/files/shared/shared_checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace post {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t turns = 3;

/// The first that is not empty.
std::string first_of(const std::vector<std::string>& texts) {
  const auto found = std::ranges::find_if(texts, [](const std::string& text) { return !text.empty(); });
  return found == texts.end() ? "" : *found;
}

}  // namespace

SharedCheckpoints::SharedCheckpoints(const plate::Ranks& all, fs::path folder, std::string of)
    : all_(&all), folder_(std::move(folder)), first_(folder_, std::move(of)) {}

/// What every process says.
std::vector<std::string> SharedCheckpoints::told(const std::string& own) const {
  return all_->exchanged(std::vector<std::string>(std::size_t(all_->size()), own));
}

fs::path SharedCheckpoints::part(std::size_t turn, std::size_t rank) const {
  return folder_ / fmt::format("checkpoint.{}.{}", turn, rank);
}

void SharedCheckpoints::write(const std::string& memory, const CellValues& own) {
  const auto together = [&](const auto& write) {
    std::string result, fault;
    try {
      result = write();
    } catch (const fs::filesystem_error& error) {
      fault = error.what();
    }
    if (fault = first_of(told(fault)); !fault.empty())
      throw fs::filesystem_error(fault, std::make_error_code(std::errc::io_error));
    return result;
  };
  const auto checksums = told(together([&] { return write_cells(part(turn_, std::size_t(all_->rank())), own); }));
  together([&] {
    if (all_->rank() == 0)
      first_.write(fmt::format("{} {} {}\n", turn_, checksums.size(), fmt::join(checksums, " ")) + memory);
    return std::string();
  });
  turn_ = (turn_ + 1) % turns;
}

SharedCheckpoints::Main SharedCheckpoints::main_of(const std::string& text) {
  Main main;
  const auto line = text.find('\n');
  std::istringstream words(text.substr(0, line));
  std::size_t count = 0;
  words >> main.turn >> count;
  for (std::string word; main.checksums.size() < count && words >> word;) main.checksums.push_back(word);
  if (line != std::string::npos) main.memory = text.substr(line + 1);
  return main;
}

/// Every process looks at some of the parts.
std::string SharedCheckpoints::fault_of_parts(const Main& main) const {
  for (auto rank = std::size_t(all_->rank()); rank < main.checksums.size(); rank += std::size_t(all_->size()))
    if (const auto path = part(main.turn, rank); checksum_of(path) != main.checksums[rank])
      return path.string() + " is damaged or not whole";
  return "";
}

std::optional<SharedCheckpoints::Found> SharedCheckpoints::read(std::vector<std::string>& refused) {
  for (std::size_t which = 0; which < Checkpoints::kept; ++which) {
    std::string fault;
    const auto text = first_.read(which, fault);
    const auto main = text ? main_of(*text) : Main{};
    if (text) fault = fault_of_parts(main);
    const auto found = told(text ? "+" + fault : fault.empty() ? "" : "-" + fault);  // nothing: there is none
    const auto missing = std::ranges::count(found, std::string());
    const auto wrong = std::ranges::find_if(found, [](const std::string& one) { return one.size() > 1; });
    if (wrong != found.end())
      refused.push_back(wrong->substr(1));
    else if (missing == 0) {
      turn_ = (main.turn + 1) % turns;
      Found result{main.memory, {}};
      for (std::size_t rank = 0; rank < main.checksums.size(); ++rank) result.parts.push_back(part(main.turn, rank));
      return result;
    } else if (missing < std::ptrdiff_t(found.size()))
      refused.push_back(folder_.string() + ": not all processes see the checkpoint in it");
  }
  return std::nullopt;
}

void SharedCheckpoints::remove() const {
  if (all_->rank() > 0) return;
  first_.remove();
  std::vector<fs::path> parts;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (entry.path().filename().string().starts_with("checkpoint.")) parts.push_back(entry.path());
  for (const auto& path : parts) fs::remove(path, none);
}

}  // namespace post
