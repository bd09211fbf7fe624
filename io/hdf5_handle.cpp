#include "io/hdf5_handle.hpp"

#include <fmt/format.h>

namespace lampblack::io::hdf5 {

QuietErrors::QuietErrors() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

std::string lastError() {
  std::string reason;
  const auto keepFirst = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    auto& kept = *static_cast<std::string*>(text);
    if (error->desc != nullptr && kept.empty()) kept = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keepFirst, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

void check(herr_t status, const std::string& what) {
  if (status < 0) throw NumericsError(fmt::format("cannot {}: {}", what, lastError()));
}

Handle::Handle(hid_t id, Close closer, const std::string& what) : id_(id), close_(closer) {
  if (id < 0) throw NumericsError(fmt::format("cannot {}: {}", what, lastError()));
}

void Handle::close(const std::string& what) {
  if (id_ < 0) return;
  const herr_t status = close_(std::exchange(id_, H5I_INVALID_HID));
  check(status, what);
}

}  // namespace lampblack::io::hdf5
