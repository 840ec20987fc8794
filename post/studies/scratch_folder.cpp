#include "post/studies/scratch_folder.hpp"

#include <cstdlib>
#include <stdexcept>

namespace post {

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
