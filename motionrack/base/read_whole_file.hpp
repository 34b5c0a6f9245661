// Reading a whole file that a user names: with a limit, so that /dev/zero ends in a sentence, and without waiting for
// a FIFO that has no writer.
#pragma once

#include <cstddef>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack {

/// How long a file of a kind may be, and what the kind is called: "a program".
struct ReadLimit {
    std::size_t max_bytes;
    std::string_view kind;
};

namespace read_limits {
constexpr ReadLimit program{std::size_t{256} << 20, "a program"};
constexpr ReadLimit drawing{std::size_t{64} << 20, "a drawing"};
constexpr ReadLimit table{std::size_t{16} << 20, "a table of tools"};
constexpr ReadLimit toml{std::size_t{16} << 20, "a file of settings"};
constexpr ReadLimit users{std::size_t{4} << 20, "a users file"};
}  // namespace read_limits

/// Errors: io (it cannot be read, is a folder, or a FIFO to which nothing was written), invalid_input (it is too long).
Result<std::string> read_whole_file(const std::string& path, const ReadLimit& limit);
/// The same of an open file, which stays open; `name` is for the sentences. Errors: as read_whole_file.
Result<std::string> read_descriptor(int file, const std::string& name, const ReadLimit& limit);

}  // namespace motionrack
