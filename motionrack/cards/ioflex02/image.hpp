// The configuration image of the array: what Init unpacks and feeds to the card.
//
//   0        8                 24     25   28       32       36
//   +--------+-----------------+------+----+--------+--------+-------------- - -
//   | magic  | project's name  |ident | 0  | length | CRC-32 | payload
//   +--------+-----------------+------+----+--------+--------+-------------- - -
//
// Numbers have their low byte first; the length is the payload's; the CRC-32 is that of bytes 0 to 31 and the payload.
// A project called "position" begins its payload with the words MODE of the four axes. In a file or a program an image
// is compressed as a zlib stream (RFC 1950).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::ioflex02 {

inline constexpr std::string_view image_magic = "IOFLEX02";
inline constexpr std::size_t image_header = 36;
inline constexpr std::size_t min_payload = 2 * axis_count;
inline constexpr std::size_t max_payload = 128 * 1024;
inline constexpr std::string_view position_project = "position";
inline constexpr std::uint8_t position_ident = 0x25;  ///< the version that Flex2Pos expects

struct ImageContent {
    std::string project{position_project};  ///< up to 16 characters
    std::uint8_t ident = position_ident;
    std::vector<std::uint8_t> payload = std::vector<std::uint8_t>(min_payload);
};

/// Header and payload, not compressed. Errors: refused, if the name or the payload is too long or the payload too
/// short.
Result<std::vector<std::uint8_t>> raw_image(const ImageContent& content);
/// The image compressed, as files have it.
std::vector<std::uint8_t> compressed(std::span<const std::uint8_t> raw);
/// The reverse. Errors: invalid_input, if it is no whole zlib stream, is damaged, or unpacks to more than the greatest
/// image.
Result<std::vector<std::uint8_t>> unpacked(std::span<const std::uint8_t> file);

/// What an image says of itself.
struct ImageInfo {
    std::string project;  ///< without the zeros that fill it up
    std::uint8_t ident = 0;
    std::uint32_t payload = 0;  ///< bytes
    std::uint32_t crc = 0;
    std::array<std::uint16_t, axis_count> modes{};  ///< words MODE of the axes, where the project is "position"
    bool position() const { return project == position_project; }
};
/// Of an image that is not compressed. Errors: invalid_input, with what the card would refuse it for.
Result<ImageInfo> inspect(std::span<const std::uint8_t> raw);

/// Whether it is one that Flex2Pos works with. Errors: invalid_input (another project or version: Flex_ErrProject).
Result<void> check_project(const ImageInfo& info);

/// Bytes as a rack file has them: two hexadecimal digits each.
std::string hex_text(std::span<const std::uint8_t> bytes);
/// The reverse. Errors: invalid_input.
Result<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text);
inline constexpr std::size_t max_image_file = 132'000;  ///< bytes of a compressed image, with room to spare

/// The image that is built into the library: project "position", its axes counting as `modes` say (words MODE).
/// Compressed.
std::vector<std::uint8_t> position_image(const std::array<std::uint16_t, axis_count>& modes = {});

/// CRC-32 (IEEE 802.3) of more bytes; begin with 0.
std::uint32_t crc32_of(std::uint32_t before, const std::uint8_t* bytes, std::size_t size);

/// A header's fields, as they are in its bytes.
struct ImageHeader {
    std::array<std::uint8_t, image_header> bytes{};
    bool ours() const;
    bool named(std::string_view project) const;
    std::string name() const;
    std::uint8_t ident() const;
    std::uint32_t length() const;
    std::uint32_t crc() const;

  private:
    std::uint32_t number(std::size_t at) const;
};

}  // namespace motionrack::ioflex02
