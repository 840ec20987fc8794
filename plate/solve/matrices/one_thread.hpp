#pragma once
#include <omp.h>

namespace plate {

/// The products of a sparse factorisation are too small to share out, and CHOLMOD starts four threads for its loops
/// whatever it is told: measured 1.3 to 1.8 times as long as with none (3,000 to 10,000 points, one thread allowed),
/// and thirty times as long with two on busy processors. Holds for OpenBLAS built with OpenMP.
class OneThread {
public:
  OneThread() : threads_(omp_get_max_threads()), levels_(omp_get_max_active_levels()) {
    omp_set_num_threads(1);
    omp_set_max_active_levels(0);
  }
  ~OneThread() {
    omp_set_max_active_levels(levels_);
    omp_set_num_threads(threads_);
  }
  OneThread(const OneThread&) = delete;

private:
  int threads_, levels_;
};

}  // namespace plate
