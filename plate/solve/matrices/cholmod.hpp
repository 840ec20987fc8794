#pragma once
#include <suitesparse/cholmod.h>

namespace plate {

/// CHOLMOD's settings and workspace; silent.
class Common {
public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  cholmod_common* operator&() { return &common_; }
  cholmod_common* operator->() { return &common_; }

private:
  cholmod_common common_;
};

}  // namespace plate
