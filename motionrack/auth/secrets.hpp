// What must not be guessed: random text, and the hash under which it is kept.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::auth {

/// 256 random bits as 64 hexadecimal digits.
std::string random_token();
/// A code for people, "ABCD-EFGH": 40 random bits in digits and letters that are not mistaken for each other.
std::string random_code();
/// How a code that a person typed is meant: capitals, O as 0, I and L as 1, without blanks and dashes.
std::string plain_code(std::string_view typed);
/// SHA-256 as 64 hexadecimal digits.
std::string hash_of(std::string_view text);
/// Takes as long for texts that differ in the first place as for those that differ in the last.
bool same_secret(std::string_view one, std::string_view other);

}  // namespace motionrack::auth
