#pragma once

#include <stdexcept>
#include <string>

namespace ir {

/// Any failure that a user can act on. what() is one line that names the file or parameter, the place in
/// it and the mend. Exit status 1 (failed while working) unless a subclass says otherwise.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file that cannot be used: exit status 3.
class InputError : public Error {
  public:
    /// `place` is where in the file ("accessor 3", "line 12"), may be empty; `problem` says what is wrong and
    /// what would mend it.
    InputError(const std::string& file, const std::string& place, const std::string& problem)
        : Error(place.empty() ? file + ": " + problem : file + ": " + place + ": " + problem) {}
};

/// A wrong option, key or value on the command line or in a set of parameters: exit status 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// Whether what was given is at fault, and not the work.
inline bool is_refusal(const Error& error) {
    return dynamic_cast<const UsageError*>(&error) || dynamic_cast<const InputError*>(&error);
}

/// The memory budget (or a device limit) does not allow the work; names the parameter to lower.
class BudgetError : public Error {
  public:
    using Error::Error;
};

/// Thrown through a running frame when its user cancelled it; nothing is wrong.
class Cancelled : public std::exception {
  public:
    const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace ir
