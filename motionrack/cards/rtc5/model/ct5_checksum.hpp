// The checksum at the end of a .ct5 file, as programs from version 4.0 on write it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace motionrack::rtc5 {

/// Header word with origin * 1000 + version of the program that wrote the file. From version `first_summed` on the
/// checksum is the known one; that of older programs is unknown.
inline constexpr std::size_t program_word = 10;
inline constexpr std::int32_t first_summed = 400;

/// Computes the CRC-32 of zlib, without the final inversion.
std::uint32_t ct5_checksum(std::span<const std::uint8_t> bytes);

/// Describes the damage of a file whose checksum is wrong and whose header names an older program: the known checksum
/// would match with one bit inverted, or with a newer program in the header. "": no such damage.
std::string damage_of_summed_file(std::span<const std::uint8_t> file);

}  // namespace motionrack::rtc5
