// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <memory>
#include <string>

namespace pharos::host {

struct UnrefObject {
  void operator()(void* object) const { g_object_unref(object); }
};
struct FreeMemory {
  void operator()(void* memory) const { g_free(memory); }
};

/// Sole owner of a reference to a GObject.
template <class Object>
using GObjectPtr = std::unique_ptr<Object, UnrefObject>;
/// Sole owner of memory that GLib allocated.
template <class Type>
using GMemory = std::unique_ptr<Type, FreeMemory>;

/// Receives the error of a call into Aravis.
class ArvError {
 public:
  ArvError() = default;
  ArvError(const ArvError&) = delete;
  ArvError& operator=(const ArvError&) = delete;
  ~ArvError() { g_clear_error(&error_); }
  /// Argument for a call; clears the previous error.
  GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const { return error_ == nullptr ? "" : error_->message; }

 private:
  GError* error_ = nullptr;
};

}  // namespace pharos::host
