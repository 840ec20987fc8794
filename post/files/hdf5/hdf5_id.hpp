#pragma once
#include <fmt/format.h>
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

/// What writing and reading state.h5 share. For post/hdf5*.cpp alone: nobody else has HDF5 on the include path.
namespace post::hdf5 {

constexpr int format_version = 1;
using Sizes = std::vector<hsize_t>;

/// The innermost message of HDF5's error stack: "file write failed: ... No space left on device".
inline std::string message() {
  std::string text = "unknown error";
  const auto keep = [](unsigned depth, const H5E_error2_t* error, void* target) -> herr_t {
    if (depth == 0) *static_cast<std::string*>(target) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &text);
  // "file write failed: time = ..., error message = 'File too large', buf = ..."
  constexpr std::string_view system = "error message = '";
  const auto begin = text.find(system);
  if (begin == std::string::npos) return text;
  return text.substr(begin + system.size(), text.find('\'', begin + system.size()) - begin - system.size());
}

/// Passes on what a call of HDF5 returned; throws where that says failure.
template <typename Result>
Result checked(Result result, const std::string& what) {
  if (result >= 0) return result;
  throw std::filesystem::filesystem_error(fmt::format("HDF5, {}: {}", what, message()),
                                          std::make_error_code(std::errc::io_error));
}

/// Leaves the reporting, of the calling thread, and the closing to us: at exit HDF5 would print, and crash over a file
/// that it could not close.
inline void keep_quiet() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// An identifier of HDF5 that closes itself.
class Id {
public:
  using Close = herr_t (*)(hid_t);
  Id() = default;
  Id(hid_t id, Close close, const std::string& what) : id_(checked(id, what)), close_(close) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Id() { release(); }

  operator hid_t() const { return id_; }
  herr_t release() { return id_ < 0 ? 0 : close_(std::exchange(id_, H5I_INVALID_HID)); }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

}  // namespace post::hdf5
