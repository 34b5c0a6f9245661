// Reads a whole file named by a user: with a limit, so that /dev/zero ends in an error, and without waiting for a FIFO
// without a writer.
#pragma once

#include <cstddef>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack {

/// Maximum length and name of a kind of file: "a program".
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

/// Reads a file. Errors: io (not readable, a folder, or a FIFO without data), invalid_input (too long).
Result<std::string> read_whole_file(const std::string& path, const ReadLimit& limit);
/// Reads an open file, which stays open; `name`: its name in messages. Errors: as read_whole_file.
Result<std::string> read_descriptor(int file, const std::string& name, const ReadLimit& limit);

}  // namespace motionrack
