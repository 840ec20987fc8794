#include "post/files/files.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace post {
namespace {

const Files* loaded() {
  void* const library = dlopen("libpdplate_files.so", RTLD_NOW | RTLD_LOCAL);
  void* const found = library ? dlsym(library, "pdplate_files") : nullptr;
  if (!found) throw std::runtime_error(std::string("the part of the program that writes fields: ") + dlerror());
  return static_cast<const Files*>(found);
}

}  // namespace

const Files& files() {
  static const Files* const all = loaded();
  return *all;
}

}  // namespace post
