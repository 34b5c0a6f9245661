// Parsing of a card's location.
#include <fmt/format.h>

#include <charconv>
#include <motionrack/live/port_spec.hpp>
#include <optional>

namespace motionrack::live {

namespace {

tl::unexpected<Error> wrong(std::string_view text, std::string_view what) {
    return fail(ErrorKind::invalid_input,
                fmt::format("'{}' is not the address of a card: {}. The form is {}. Nothing was opened.", text, what,
                            port_spec_form()));
}

std::optional<std::uint64_t> number(std::string_view text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

struct Range {
    std::string_view key;
    std::uint64_t min, max;
    void (*set)(PortSpec&, std::uint64_t);
};

constexpr Range numbers[] = {
    {"offset", 0, 1ull << 40, [](PortSpec& spec, std::uint64_t n) { spec.offset = n; }},
    {"stride", 1, 4096, [](PortSpec& spec, std::uint64_t n) { spec.stride = static_cast<std::uint32_t>(n); }},
    {"width", 8, 16, [](PortSpec& spec, std::uint64_t n) { spec.width = static_cast<int>(n); }},
    {"map", 0, 4, [](PortSpec& spec, std::uint64_t n) { spec.map = static_cast<int>(n); }},
    {"gap_ns", 0, 1'000'000'000,
     [](PortSpec& spec, std::uint64_t n) { spec.gap = nanoseconds(static_cast<std::int64_t>(n)); }},
};

/// The error in KEY=VALUE; "" if it is accepted.
std::string take(PortSpec& spec, std::string_view key, std::string_view value) {
    if (key == "interrupt") {
        if (value.empty()) return "interrupt has no path; 'interrupt=none' is none";
        spec.interrupt = value == "none" ? "" : std::string(value);
        return "";
    }
    for (const Range& range : numbers) {
        if (range.key != key) continue;
        const auto n = number(value);
        if (!n) return fmt::format("{} is '{}', which is not a number", key, value);
        if (*n < range.min || *n > range.max)
            return fmt::format("{} is {}; it must be {} to {}", key, value, range.min, range.max);
        range.set(spec, *n);
        return "";
    }
    return fmt::format("unknown key '{}'; the keys are offset, stride, width, map, interrupt, gap_ns", key);
}

std::string contradiction(const PortSpec& spec) {
    if (spec.path.empty()) return "the path is empty";
    if (spec.width != 8 && spec.width != 16) return fmt::format("width is {}; it must be 8 or 16", spec.width);
    if (spec.map != 0 && spec.reach != AddressSpace::uio) return "only uio: has maps";
    return "";
}

}  // namespace

std::string_view port_spec_form() {
    return "uio:PATH, memory:PATH or port:PATH, then optionally ,offset=N ,stride=N ,width=8 ,map=N "
           ",interrupt=PATH ,gap_ns=N";
}

bool names_real_card(std::string_view text) {
    for (const std::string_view kind : {"uio:", "memory:", "port:"})
        if (text.starts_with(kind)) return true;
    return false;
}

Result<PortSpec> read_port_spec(std::string_view text) {
    PortSpec spec;
    const std::size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    if (colon == std::string_view::npos) return wrong(text, "it has no ':'");
    if (kind == "uio")
        spec.reach = AddressSpace::uio;
    else if (kind == "memory")
        spec.reach = AddressSpace::memory;
    else if (kind == "port")
        spec.reach = AddressSpace::port;
    else
        return wrong(text, fmt::format("unknown kind '{}:'", kind));

    std::string_view rest = text.substr(colon + 1);
    const std::size_t path_end = rest.find(',');
    spec.path = rest.substr(0, path_end);
    if (spec.reach == AddressSpace::uio) spec.interrupt = spec.path;
    rest = path_end == std::string_view::npos ? std::string_view{} : rest.substr(path_end);
    while (!rest.empty()) {
        rest.remove_prefix(1);
        const std::string_view item = rest.substr(0, rest.find(','));
        rest.remove_prefix(item.size());
        const std::size_t equals = item.find('=');
        if (equals == std::string_view::npos) return wrong(text, fmt::format("'{}' has no '='", item));
        if (const std::string what = take(spec, item.substr(0, equals), item.substr(equals + 1)); !what.empty())
            return wrong(text, what);
    }
    if (const std::string what = contradiction(spec); !what.empty()) return wrong(text, what);
    return spec;
}

}  // namespace motionrack::live
