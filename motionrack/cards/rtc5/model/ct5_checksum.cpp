// The checksum of a .ct5 file, and detection of single damages that make a new file look like one of an older program.
//
// The checksum is linear: an inverted bit changes it by a number that depends only on the bit's position. Going
// backwards from the end of the file gives these numbers in sequence. (Chosen: a file of an older program, with its
// other checksum, looks damaged once in 500 files. Refusing it is better than marking with a damaged file.)
#include <fmt/format.h>

#include <array>
#include <bit>
#include <motionrack/cards/rtc5/model/ct5_checksum.hpp>

namespace motionrack::rtc5 {

namespace {

constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> out{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t c = i;
        for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ c >> 1 : c >> 1;
        out[i] = c;
    }
    return out;
}();

/// Returns the CRC register after one more byte.
std::uint32_t next_crc(std::uint32_t crc, std::uint8_t byte) {
    return crc_table[(crc ^ byte) & 0xFF] ^ crc >> 8;
}

constexpr std::size_t program_byte = 4 * program_word;

/// Returns true if a newer program version in the header explains the `difference` of the checksums; `effects`: change
/// of the checksum by each bit of the version word.
bool newer_program_fits(std::uint32_t said, std::uint32_t difference, const std::array<std::uint32_t, 32>& effects) {
    constexpr std::uint32_t max_origin = 9;
    for (std::uint32_t origin = 0; origin <= max_origin; ++origin)
        for (std::uint32_t version = first_summed; version < 1000; ++version) {
            std::uint32_t effect = 0;
            for (std::uint32_t left = said ^ (origin * 1000 + version); left != 0; left &= left - 1)
                effect ^= effects[static_cast<std::size_t>(std::countr_zero(left))];
            if (effect == difference) return true;
        }
    return false;
}

std::uint32_t stored_word(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 4; i-- > 0;) out = out << 8 | bytes[at + i];
    return out;
}

}  // namespace

std::uint32_t ct5_checksum(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) crc = next_crc(crc, byte);
    return crc;
}

std::string damage_of_summed_file(std::span<const std::uint8_t> file) {
    const auto contents = file.first(file.size() - 4);
    const std::uint32_t difference = ct5_checksum(contents) ^ stored_word(file, contents.size());
    if (std::has_single_bit(difference)) return "a bit of its checksum is inverted";
    std::array<std::uint32_t, 8> effects{};
    for (std::size_t bit = 0; bit < 8; ++bit) effects[bit] = next_crc(0, static_cast<std::uint8_t>(1u << bit));
    std::array<std::uint32_t, 32> of_program{};
    for (std::size_t at = contents.size(); at-- > 0;) {
        for (std::size_t bit = 0; bit < 8; ++bit) {
            if (effects[bit] == difference)
                return fmt::format("its checksum would fit if bit {} of byte {} were inverted", bit, at);
            if (at >= program_byte && at < program_byte + 4) of_program[8 * (at - program_byte) + bit] = effects[bit];
            effects[bit] = next_crc(effects[bit], 0);
        }
    }
    if (newer_program_fits(stored_word(file, program_byte), difference, of_program))
        return "its checksum would fit if its header named another program version";
    return "";
}

}  // namespace motionrack::rtc5
