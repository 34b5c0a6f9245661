// Secrets: random tokens and codes, and their stored hash.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::auth {

/// Returns 256 random bits as 64 hexadecimal digits.
std::string random_token();
/// Returns a readable code, "ABCD-EFGH": 40 random bits in digits and letters that are not easily confused.
std::string random_code();
/// Normalises a typed code: capitals, O as 0, I and L as 1, without blanks and dashes.
std::string plain_code(std::string_view typed);
/// Returns the SHA-256 as 64 hexadecimal digits.
std::string hash_of(std::string_view text);
/// Compares in constant time, independent of the position of the first difference.
bool same_secret(std::string_view one, std::string_view other);

}  // namespace motionrack::auth
