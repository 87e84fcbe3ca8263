// Failures as values: a code, and a sentence that names the cause and the place.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace pillowmesh {

/// The first four are the exit status of the command as well.
enum class StatusCode : int {
  ok = 0,
  limit_not_met = 1,    ///< finished with a valid mesh, but a requested limit was not met
  usage = 2,            ///< the call itself is wrong: unknown option, malformed formula
  bad_input = 3,        ///< a file, mesh or field that cannot be used
  cancelled = 4,        ///< stopped on request; what is there is valid
  illegal = 5,          ///< an operator refused; the mesh is unchanged
  other_build = 6,  ///< nothing wrong, but this build leaves out what it takes (mesh/any_mesh.h, adapt/options.h)
};

/// Outcome of a fallible call. `message` is one sentence, empty when ok.
struct [[nodiscard]] Status {
  StatusCode code = StatusCode::ok;
  std::string message;

  [[nodiscard]] bool ok() const { return code == StatusCode::ok; }

  static Status usage(std::string text) { return {StatusCode::usage, std::move(text)}; }
  static Status bad_input(std::string text) { return {StatusCode::bad_input, std::move(text)}; }
  static Status limit_not_met(std::string text) { return {StatusCode::limit_not_met, std::move(text)}; }
  static Status cancelled(std::string text) { return {StatusCode::cancelled, std::move(text)}; }
  static Status illegal(std::string text) { return {StatusCode::illegal, std::move(text)}; }
};

/// A value, or the Status that says why there is none.
template <class T>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : value_(std::move(value)) {}          // NOLINT: implicit on purpose
  Expected(Status status) : status_(std::move(status)) {}  // NOLINT: implicit on purpose

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }
  /// \pre ok()
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }
  /// \pre !ok()
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace pillowmesh
