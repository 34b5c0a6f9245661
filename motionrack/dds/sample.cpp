// Identities of publishers, the check of a sample, and checks of bus names and domains.
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <motionrack/dds/sample.hpp>
#include <random>

namespace motionrack::dds {

std::string_view PublisherIdentity::host_name() const {
    return {host.data(), static_cast<std::size_t>(std::find(host.begin(), host.end(), '\0') - host.begin())};
}

std::string PublisherIdentity::id_text() const {
    std::string out;
    for (const std::uint8_t byte : id) out += fmt::format("{:02x}", byte);
    return out;
}

std::string PublisherIdentity::text() const {
    return fmt::format("{}, process {}, id {}", host_name(), process, id_text());
}

PublisherIdentity new_source() {
    PublisherIdentity out;
    std::random_device device;
    for (std::uint8_t& byte : out.id) byte = static_cast<std::uint8_t>(device());
    ::gethostname(out.host.data(), out.host.size() - 1);
    out.host.back() = '\0';
    const std::size_t length = out.host_name().size();
    std::fill(out.host.begin() + static_cast<std::ptrdiff_t>(length), out.host.end(), '\0');
    for (std::size_t i = 0; i < length; ++i)
        if (out.host[i] < ' ' || out.host[i] > '~') out.host[i] = '?';
    if (length == 0) out.host[0] = '?';
    out.process = static_cast<std::uint32_t>(::getpid());
    return out;
}

std::uint32_t check_of(const Sample& sample) {
    std::array<std::uint8_t, 4 + 16 + 64 + 4 + 8 + 8 + 4> bytes;
    std::uint8_t* at = bytes.data();
    const auto put = [&at](std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) *at++ = static_cast<std::uint8_t>(value >> (8 * i));
    };
    put(sample.format, 4);
    at = std::copy(sample.source.id.begin(), sample.source.id.end(), at);
    for (const char c : sample.source.host) *at++ = static_cast<std::uint8_t>(c);
    put(sample.source.process, 4);
    put(static_cast<std::uint64_t>(sample.period), 8);
    put(static_cast<std::uint64_t>(sample.pace), 8);
    put(sample.frame.crc, 4);
    return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

Result<void> check_bus_name(std::string_view name) {
    static constexpr std::size_t max_length = 64;
    const auto good = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    if (name.empty() || name.size() > max_length)
        return fail(
            ErrorKind::invalid_input,
            fmt::format(
                "The bus name has {} characters, but must have 1 to {}. Nothing was opened; choose another name.",
                name.size(), max_length));
    const auto bad = std::find_if_not(name.begin(), name.end(), good);
    if (bad != name.end())
        return fail(ErrorKind::invalid_input,
                    fmt::format("Character {} of the bus name is not one of letters, digits, '_' and "
                                "'-'. Nothing was opened; choose another name.",
                                bad - name.begin() + 1));
    return {};
}

Result<void> check_domain(int domain) {
    if (domain >= 0 && domain <= 232) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("The DDS domain is {}, but must be 0 to 232. Nothing was opened.", domain));
}

}  // namespace motionrack::dds
