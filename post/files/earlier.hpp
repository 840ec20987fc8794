#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What a run finds in the folder that it is to write to.
namespace post {

/// Names in a folder that holds something but no results of a run; empty where a run may write.
std::vector<std::string> strangers(const std::filesystem::path& folder);

/// Is the folder of a run of this case, as text?
bool is_of(const std::filesystem::path& folder, const std::string& resolved);

/// Folders of runs that belong to it.
enum class Parts { go, stay };

/// Removes all that a run has written into a folder, by name; everything else stays. Returns the number of files.
std::size_t remove_earlier(const std::filesystem::path& folder, Parts parts = Parts::go);

}  // namespace post
