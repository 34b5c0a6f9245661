// Whether a file that decides who may do what, or what is trusted, is its owner's alone.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::auth {

/// Errors: invalid_input if other users may write the file or replace it, because its folder is open to them; `subject`
/// begins the sentence ("The users file"). A file that is missing has only its folder checked; io: not even that can
/// be.
Result<void> check_writers(const std::string& path, const std::string& subject);

/// Errors: invalid_input if others than the owner may read or write the file, as a private key; a key of root may be
/// read by its group.
Result<void> check_readers(const std::string& path, const std::string& subject);

}  // namespace motionrack::auth
