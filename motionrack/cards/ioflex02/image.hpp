// The configuration image of the array, which Init unpacks and writes to the card.
//
//   0        8                 24     25   28       32       36
//   +--------+-----------------+------+----+--------+--------+-------------- - -
//   | magic  | project name    |ident | 0  | length | CRC-32 | payload
//   +--------+-----------------+------+----+--------+--------+-------------- - -
//
// Numbers are stored low byte first; the length is that of the payload; the CRC-32 covers bytes 0 to 31 and the
// payload. The payload of a project called "position" begins with the words MODE of the four axes. In a file or a
// program an image is compressed as a zlib stream (RFC 1950).
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
inline constexpr std::uint8_t position_ident = 0x25;  ///< version that Flex2Pos expects

struct ImageContent {
    std::string project{position_project};  ///< up to 16 characters
    std::uint8_t ident = position_ident;
    std::vector<std::uint8_t> payload = std::vector<std::uint8_t>(min_payload);
};

/// Builds an uncompressed image: header and payload. Errors: refused, if the name or the payload is too long or the
/// payload is too short.
Result<std::vector<std::uint8_t>> raw_image(const ImageContent& content);
/// Compresses an image for files.
std::vector<std::uint8_t> compressed(std::span<const std::uint8_t> raw);
/// Unpacks an image. Errors: invalid_input if the zlib stream is incomplete or damaged, or unpacks to more than the
/// largest image.
Result<std::vector<std::uint8_t>> unpacked(std::span<const std::uint8_t> file);

/// Information in the header of an image.
struct ImageInfo {
    std::string project;  ///< without the padding zeros
    std::uint8_t ident = 0;
    std::uint32_t payload = 0;  ///< bytes
    std::uint32_t crc = 0;
    std::array<std::uint16_t, axis_count> modes{};  ///< words MODE of the axes if the project is "position"
    bool position() const { return project == position_project; }
};
/// Reads the header of an uncompressed image. Errors: invalid_input, with the reason for which the card would refuse
/// it.
Result<ImageInfo> inspect(std::span<const std::uint8_t> raw);

/// Checks that Flex2Pos supports the image. Errors: invalid_input (another project or version: Flex_ErrProject).
Result<void> check_project(const ImageInfo& info);

/// Formats bytes for a rack file: two hexadecimal digits each.
std::string hex_text(std::span<const std::uint8_t> bytes);
/// Parses the text of hex_text(). Errors: invalid_input.
Result<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text);
inline constexpr std::size_t max_image_file = 132'000;  ///< maximum bytes of a compressed image, with a margin

/// Returns the built-in image, compressed: project "position", with the counting modes `modes` (words MODE) of its
/// axes.
std::vector<std::uint8_t> position_image(const std::array<std::uint16_t, axis_count>& modes = {});

/// Continues the CRC-32 (IEEE 802.3) over more bytes; begin with 0.
std::uint32_t crc32_of(std::uint32_t before, const std::uint8_t* bytes, std::size_t size);

/// Fields of a header, in their byte form.
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
