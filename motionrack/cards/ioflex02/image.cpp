// Creation, compression and unpacking of configuration images.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <motionrack/cards/ioflex02/image.hpp>

namespace motionrack::ioflex02 {

namespace {

constexpr std::size_t name_at = 8, max_name = 16, ident_at = 24, length_at = 28, crc_at = 32;
constexpr std::size_t max_image = image_header + max_payload;

void put(std::vector<std::uint8_t>& out, std::size_t at, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i) out[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace

std::uint32_t crc32_of(std::uint32_t before, const std::uint8_t* bytes, std::size_t size) {
    return static_cast<std::uint32_t>(::crc32(before, bytes, static_cast<uInt>(size)));
}

bool ImageHeader::ours() const {
    return std::equal(image_magic.begin(), image_magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return a == static_cast<char>(b); });
}

bool ImageHeader::named(std::string_view project) const {
    for (std::size_t i = 0; i < max_name; ++i)
        if (bytes[name_at + i] != (i < project.size() ? static_cast<std::uint8_t>(project[i]) : 0)) return false;
    return true;
}

std::string ImageHeader::name() const {
    const auto first = bytes.begin() + name_at;
    return {first, std::find(first, first + max_name, std::uint8_t{0})};
}

std::uint8_t ImageHeader::ident() const {
    return bytes[ident_at];
}

std::uint32_t ImageHeader::length() const {
    return number(length_at);
}

std::uint32_t ImageHeader::crc() const {
    return number(crc_at);
}

std::uint32_t ImageHeader::number(std::size_t at) const {
    return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

Result<std::vector<std::uint8_t>> raw_image(const ImageContent& content) {
    if (content.project.empty() || content.project.size() > max_name)
        return fail(ErrorKind::refused,
                    fmt::format("The project's name has {} characters, it must have 1 to {}. No image was created.",
                                content.project.size(), max_name));
    if (content.payload.size() < min_payload || content.payload.size() > max_payload)
        return fail(ErrorKind::refused,
                    fmt::format("The payload has {} bytes, but an image has {} to {}. No image was created.",
                                content.payload.size(), min_payload, max_payload));
    std::vector<std::uint8_t> out(image_header);
    std::copy(image_magic.begin(), image_magic.end(), out.begin());
    std::copy(content.project.begin(), content.project.end(), out.begin() + name_at);
    out[ident_at] = content.ident;
    put(out, length_at, content.payload.size());
    out.insert(out.end(), content.payload.begin(), content.payload.end());
    const std::uint32_t head = crc32_of(0, out.data(), crc_at);
    put(out, crc_at, crc32_of(head, out.data() + image_header, content.payload.size()));
    return out;
}

std::vector<std::uint8_t> compressed(std::span<const std::uint8_t> raw) {
    uLongf size = compressBound(static_cast<uLong>(raw.size()));
    std::vector<std::uint8_t> out(size);
    const int done = compress2(out.data(), &size, raw.data(), static_cast<uLong>(raw.size()), Z_BEST_COMPRESSION);
    MOTIONRACK_ASSERT(done == Z_OK);
    out.resize(size);
    return out;
}

Result<std::vector<std::uint8_t>> unpacked(std::span<const std::uint8_t> file) {
    std::vector<std::uint8_t> out(max_image + 1);
    uLongf size = static_cast<uLongf>(out.size());
    auto used = static_cast<uLong>(file.size());
    const std::uint8_t nothing = 0;
    const int done = uncompress2(out.data(), &size, file.empty() ? &nothing : file.data(), &used);
    if (size > max_image || (done == Z_BUF_ERROR && size == out.size()))
        return fail(ErrorKind::invalid_input,
                    fmt::format("The configuration image unpacks to more than {} bytes, the limit of the array. It was "
                                "not used; is it an image of this card?",
                                max_image));
    if (done != Z_OK)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The configuration image of {} bytes cannot be unpacked: it is cut short, damaged, or not a "
                        "zlib stream. It was not used; make or copy it again.",
                        file.size()));
    if (used != file.size())
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The configuration image has {} bytes, but its zlib stream ends after {}. It was not used; "
                        "make or copy it again.",
                        file.size(), used));
    out.resize(size);
    return out;
}

Result<ImageInfo> inspect(std::span<const std::uint8_t> raw) {
    const auto refused = [](const std::string& why) {
        return fail(ErrorKind::invalid_input, why + ". The card would refuse the image; make it again.");
    };
    ImageHeader header;
    if (raw.size() < image_magic.size() || !std::equal(image_magic.begin(), image_magic.end(), raw.begin()))
        return refused("It is not an image of this card: it does not begin with \"IOFLEX02\"");
    if (raw.size() < image_header)
        return refused(fmt::format("Its header is cut short: {} of {} bytes are there", raw.size(), image_header));
    std::copy_n(raw.begin(), image_header, header.bytes.begin());
    if (header.length() < min_payload || header.length() > max_payload)
        return refused(fmt::format("The length in its header is {} bytes, but a payload has {} to {}", header.length(),
                                   min_payload, max_payload));
    const std::span<const std::uint8_t> payload = raw.subspan(image_header);
    if (payload.size() != header.length())
        return refused(
            fmt::format("Its payload has {} bytes, but the header says {}", payload.size(), header.length()));
    const std::uint32_t crc = crc32_of(crc32_of(0, raw.data(), crc_at), payload.data(), payload.size());
    if (crc != header.crc())
        return refused(fmt::format("Its CRC-32 is {:08X}h, but the header says {:08X}h", crc, header.crc()));
    ImageInfo out{header.name(), header.ident(), header.length(), crc, {}};
    for (std::size_t i = 0; i < axis_count && out.position(); ++i)
        out.modes[i] = static_cast<std::uint16_t>(payload[2 * i] | payload[2 * i + 1] << 8) & mode::all;
    return out;
}

Result<void> check_project(const ImageInfo& info) {
    if (!info.position())
        return fail(ErrorKind::invalid_input,
                    fmt::format("The image is of the project \"{}\" (ident {:02X}h), but the unit works with \"{}\". "
                                "Init would give Flex_ErrProject.",
                                info.project, info.ident, position_project));
    if (info.ident != position_ident)
        return fail(ErrorKind::invalid_input,
                    fmt::format("The image has version {:02X}h of the project, but the unit needs {:02X}h. Init would "
                                "give Flex_ErrProject.",
                                info.ident, position_ident));
    return {};
}

std::string hex_text(std::span<const std::uint8_t> bytes) {
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

Result<std::vector<std::uint8_t>> bytes_of_hex(std::string_view text) {
    std::vector<std::uint8_t> out;
    out.reserve(text.size() / 2);
    for (std::size_t i = 0; i < text.size(); i += 2) {
        std::uint8_t byte = 0;
        const std::string_view two = text.substr(i, 2);
        const auto [end, error] = std::from_chars(two.data(), two.data() + two.size(), byte, 16);
        if (error != std::errc{} || end != two.data() + 2)
            return fail(
                ErrorKind::invalid_input,
                fmt::format("Digits {} and {} of the image are not a hexadecimal number of two digits. The image "
                            "was not used; copy it again.",
                            i + 1, i + 2));
        out.push_back(byte);
    }
    return out;
}

std::vector<std::uint8_t> position_image(const std::array<std::uint16_t, axis_count>& modes) {
    ImageContent content;
    for (std::size_t i = 0; i < axis_count; ++i) {
        content.payload[2 * i] = static_cast<std::uint8_t>(modes[i]);
        content.payload[2 * i + 1] = static_cast<std::uint8_t>(modes[i] >> 8);
    }
    return compressed(*raw_image(content));
}

}  // namespace motionrack::ioflex02
