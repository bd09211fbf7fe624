// HDF5 objects that close themselves, and calls whose return is looked at. A failed call becomes a NumericsError that
// says what was being done and the innermost reason HDF5 gives.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::io::hdf5 {

// Turns off HDF5's own printing of errors while it lives.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// The innermost message on HDF5's error stack; empties the stack.
std::string lastError();

// Throws a NumericsError "cannot <what>: <reason>" where an HDF5 call returned a negative value.
void check(herr_t status, const std::string& what);

class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  // Takes over an identifier just made; NumericsError "cannot <what>" where making it failed.
  Handle(hid_t id, Close closer, const std::string& what);
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      close_ = other.close_;
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the identifier
  [[nodiscard]] bool isOpen() const { return id_ >= 0; }
  // Closes and reports, where a destructor could not.
  void close(const std::string& what);
  // Forgets the identifier without closing it.
  void release() { id_ = H5I_INVALID_HID; }

 private:
  void reset() noexcept {
    if (id_ >= 0) close_(id_);
    id_ = H5I_INVALID_HID;
  }

  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

}  // namespace lampblack::io::hdf5
