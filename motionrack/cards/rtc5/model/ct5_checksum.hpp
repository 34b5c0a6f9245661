// The sum at the end of a .ct5 file, as programs from version 4.0 on write it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace motionrack::rtc5 {

/// Where the header has origin * 1000 + version of the program that wrote the file; from `first_summed` on the sum of
/// the file is the known one, that of older programs is not known.
inline constexpr std::size_t program_word = 10;
inline constexpr std::int32_t first_summed = 400;

/// CRC-32 as zlib has it, but without the inversion at its end.
std::uint32_t ct5_checksum(std::span<const std::uint8_t> bytes);

/// Of a whole file whose sum does not fit and whose header names an older program: how it is damaged nevertheless, in
/// words: with one bit turned back, or with a newer program in its header, the known sum would fit. "": that is not so.
std::string damage_of_summed_file(std::span<const std::uint8_t> file);

}  // namespace motionrack::rtc5
