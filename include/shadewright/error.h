// The library's errors: each is one sentence that names the input and the mend. Thrown anywhere, caught once at the top
// of each command (architecture, section 4).
#pragma once

#include <stdexcept>
#include <string>

namespace shadewright {

/// Base of everything the library throws. `what()` is the whole sentence, for a person.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's input is wrong (a file, a spec, a flag): "INPUT: PROBLEM; MEND". The command line exits with code 2.
class InputError : public Error {
 public:
  /// `input` names what was given, `problem` what is wrong with it, `mend` what to do about it (may be empty).
  InputError(const std::string& input, const std::string& problem, const std::string& mend = {})
      : Error(input + ": " + problem + (mend.empty() ? "" : "; " + mend)) {}
};

/// The device or the disk failed, not the caller. The command line exits with code 1.
class FailureError : public Error {
 public:
  FailureError(const std::string& subject, const std::string& problem, const std::string& mend = {})
      : Error(subject + ": " + problem + (mend.empty() ? "" : "; " + mend)) {}
};

}  // namespace shadewright
