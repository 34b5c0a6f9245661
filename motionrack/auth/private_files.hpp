// Permission checks of files that hold access rights or secrets.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::auth {

/// Errors: invalid_input if other users may write the file, or replace it through its folder; `subject` begins the
/// sentence ("The users file"). If the file is missing, checks only its folder; io if that fails too.
Result<void> check_writers(const std::string& path, const std::string& subject);

/// Errors: invalid_input if other users may read or write the file, e.g. a private key. The group may read a key of
/// root.
Result<void> check_readers(const std::string& path, const std::string& subject);

}  // namespace motionrack::auth
