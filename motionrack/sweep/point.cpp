// Text of a point. Each part is its name, its length in bytes and its bytes, so that programs may contain any bytes:
//
//   motionrack point 1
//   version 5
//   1.2.3
//   rack 812
//   rack.name = "router" ...
#include <fmt/format.h>

#include <charconv>
#include <motionrack/auth/secrets.hpp>
#include <motionrack/sweep/point.hpp>
#include <optional>

namespace motionrack::sweep {

namespace {

constexpr std::string_view head = "motionrack point 1\n";

void add_part(std::string& out, std::string_view name, std::string_view bytes) {
    out += fmt::format("{} {}\n{}\n", name, bytes.size(), bytes);
}

struct Part {
    std::string_view name, bytes;
};

/// Removes the first part from `text`; empty if it is damaged.
std::optional<Part> take_part(std::string_view& text) {
    const std::size_t blank = text.find(' '), end = text.find('\n');
    if (blank == std::string_view::npos || end == std::string_view::npos || blank > end) return std::nullopt;
    std::size_t size = 0;
    const auto [stop, bad] = std::from_chars(text.data() + blank + 1, text.data() + end, size);
    const std::string_view rest = text.substr(end + 1);
    if (bad != std::errc() || stop != text.data() + end || size >= rest.size() || rest[size] != '\n')
        return std::nullopt;
    Part out{text.substr(0, blank), rest.substr(0, size)};
    text = rest.substr(size + 1);
    return out;
}

}  // namespace

std::string text_of(const PointText& point) {
    std::string out(head);
    add_part(out, "version", MOTIONRACK_VERSION);
    add_part(out, "rack", point.rack);
    add_part(out, "program", point.program);
    for (const auto& [name, text] : point.subprograms) add_part(out, "subprogram", name + "\n" + text);
    if (!point.tools.empty()) add_part(out, "tools", point.tools);
    if (point.block_delete) add_part(out, "block_delete", "");
    for (const std::string& fault : point.faults) add_part(out, "fault", fault);
    add_part(out, "end", "");
    return out;
}

Result<PointText> read_point(std::string_view text) {
    const auto damaged = [] {
        return fail(ErrorKind::invalid_input, "This is not a point of a sweep, or it is damaged. Nothing was run.");
    };
    if (!text.starts_with(head)) return damaged();
    text.remove_prefix(head.size());
    PointText out;
    std::string_view version;
    bool whole = false;
    while (!text.empty() && !whole) {
        const std::optional<Part> part = take_part(text);
        if (!part) return damaged();
        if (part->name == "version") {
            version = part->bytes;
        } else if (part->name == "rack") {
            out.rack = part->bytes;
        } else if (part->name == "program") {
            out.program = part->bytes;
        } else if (part->name == "subprogram") {
            const std::size_t line = part->bytes.find('\n');
            if (line == std::string_view::npos) return damaged();
            out.subprograms[std::string(part->bytes.substr(0, line))] = part->bytes.substr(line + 1);
        } else if (part->name == "tools") {
            out.tools = part->bytes;
        } else if (part->name == "block_delete") {
            out.block_delete = true;
        } else if (part->name == "fault") {
            out.faults.emplace_back(part->bytes);
        } else if (part->name == "end") {
            whole = true;
        } else {
            return damaged();
        }
    }
    if (!whole || !text.empty()) return damaged();
    if (version != MOTIONRACK_VERSION)
        return fail(ErrorKind::refused,
                    fmt::format("The point was made by version {:.20} of motionrack and this is {}, which may run it "
                                "differently. Nothing was run; use the same version on all machines.",
                                version, MOTIONRACK_VERSION));
    return out;
}

std::string key_of(std::string_view text) {
    return auth::hash_of(text).substr(0, 32);
}

}  // namespace motionrack::sweep
