// VCD writer with a buffer; formats the upper digits of times only when they change.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <motionrack/trace/vcd_writer.hpp>
#include <utility>

namespace motionrack::trace {

namespace {

constexpr std::size_t vcd_buffer_size = 256 * 1024;
constexpr std::size_t max_change_bytes = 128;  ///< a time and a value: 1 + 19 + 1 + 1 + 64 + 1 + 6 + 1
constexpr std::int64_t low_base = 100'000'000;

constexpr std::array<char, 200> make_pairs() {
    std::array<char, 200> pairs{};
    for (std::size_t i = 0; i < 100; ++i) {
        pairs[2 * i] = static_cast<char>('0' + i / 10);
        pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
    return pairs;
}
constexpr std::array<char, 200> pairs = make_pairs();

/// Writes eight digits of 0 <= value < 1e8, with leading zeros.
void put_eight(char* at, std::uint32_t value) {
    const std::uint32_t upper = value / 10'000;
    const std::uint32_t lower = value % 10'000;
    std::memcpy(at, &pairs[2 * (upper / 100)], 2);
    std::memcpy(at + 2, &pairs[2 * (upper % 100)], 2);
    std::memcpy(at + 4, &pairs[2 * (lower / 100)], 2);
    std::memcpy(at + 6, &pairs[2 * (lower % 100)], 2);
}

/// Returns "100 ps", "1 us"; empty if VCD has no such timescale.
std::string timescale_text(std::int64_t ticks) {
    static constexpr std::array<const char*, 5> units = {"ps", "ns", "us", "ms", "s"};
    std::int64_t size = 1;
    for (int exponent = 2; exponent <= 12; ++exponent, size *= 10) {
        if (size != ticks) continue;
        static constexpr std::array<const char*, 3> multiples = {"1", "10", "100"};
        return fmt::format("{} {}", multiples[static_cast<std::size_t>(exponent % 3)],
                           units[static_cast<std::size_t>(exponent / 3)]);
    }
    return {};
}

std::string legal_name(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0U) == 0x80U) continue;  // continuation byte of a UTF-8 character; its first byte gave the '_'
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool digit = c >= '0' && c <= '9';
        if (digit && out.empty()) out += '_';
        out += letter || digit || c == '_' ? c : c == '+' ? 'p' : c == '-' ? 'm' : '_';
    }
    return out.empty() ? "_" : out;
}

/// Returns text that cannot end its comment.
std::string without_dollar(std::string text) {
    for (char& c : text) {
        if (c == '$') c = '_';
    }
    return text;
}

std::uint64_t cut(std::uint64_t value, int bits) {
    return bits >= 64 ? value : value & ((std::uint64_t{1} << bits) - 1);
}

}  // namespace

Result<void> check_unit(Duration unit) {
    if (!timescale_text(unit.count()).empty()) return {};
    const std::string seen =
        unit > Duration{0} ? fmt::format("a timescale of {} ps", unit.count() * 100) : "this timescale";
    return fail(
        ErrorKind::refused,
        fmt::format("A VCD file cannot have {}: it must be 1, 10 or 100 of ps, ns, us or ms, from 100 ps to 1 s. "
                    "Nothing was written; take 1 ns.",
                    seen));
}

Result<VcdWriter> VcdWriter::create(const std::string& path, const VcdSettings& settings) {
    MOTIONRACK_CHECK(check_unit(settings.timescale));
    const std::string timescale = timescale_text(settings.timescale.count());
    Result<disk::NewFile> file = disk::NewFile::create(path, disk::NewFile::Incomplete::keep);
    if (!file) {
        return fail(ErrorKind::io,
                    fmt::format("The VCD file could not be created: {}. Choose another place.", file.error().message),
                    {}, path);
    }
    VcdWriter writer;
    writer.path_ = path;
    writer.file_ = std::move(*file);
    writer.timescale_ = settings.timescale.count();
    writer.full_names_ = settings.full_names;
    writer.buffer_.resize(vcd_buffer_size);
    writer.names_.emplace_back();
    writer.put("$version Motionrack $end\n");
    if (!settings.comment.empty()) writer.put("$comment " + without_dollar(settings.comment) + " $end\n");
    writer.put("$timescale " + timescale + " $end\n");
    return writer;
}

VcdWriter::VcdWriter(VcdWriter&& other) noexcept {
    *this = std::move(other);
}

VcdWriter& VcdWriter::operator=(VcdWriter&& other) noexcept {
    if (this == &other) return *this;
    if (file_) flush();
    path_ = std::move(other.path_);
    file_ = std::move(other.file_);
    gave_up_ = other.gave_up_;
    timescale_ = other.timescale_;
    variables_ = std::move(other.variables_);
    names_ = std::move(other.names_);
    scopes_ = std::move(other.scopes_);
    full_names_ = other.full_names_;
    buffer_ = std::move(other.buffer_);
    used_ = std::exchange(other.used_, 0);
    declaring_ = other.declaring_;
    now_ = other.now_;
    unit_ = other.unit_;
    unit_end_ = other.unit_end_;
    high_ = other.high_;
    std::memcpy(high_text_, other.high_text_, sizeof high_text_);
    high_length_ = other.high_length_;
    return *this;
}

// Not closed, because an exception is active: the incomplete file does not replace the final name.
VcdWriter::~VcdWriter() {
    if (file_) flush();
}

std::string VcdWriter::unique_name(std::string_view name) {
    const std::string base = legal_name(name);
    std::string unique = base;
    for (int number = 2; !names_.back().insert(unique).second; ++number) unique = fmt::format("{}_{}", base, number);
    return unique;
}

void VcdWriter::push_scope(std::string_view name) {
    MOTIONRACK_ASSERT(declaring_);
    scopes_.push_back(unique_name(name));
    put("$scope module " + scopes_.back() + " $end\n");
    names_.emplace_back();
}

void VcdWriter::pop_scope() {
    MOTIONRACK_ASSERT(declaring_ && names_.size() > 1);
    names_.pop_back();
    scopes_.pop_back();
    put("$upscope $end\n");
}

VcdWriter::Id VcdWriter::add_wire(std::string_view name, bool initial) {
    return declare(name, VariableKind::wire, 1, initial ? 1 : 0);
}

VcdWriter::Id VcdWriter::add_vector(std::string_view name, int bits, std::uint64_t initial) {
    MOTIONRACK_ASSERT(bits >= 1 && bits <= 64);
    return declare(name, VariableKind::vector, bits, cut(initial, bits));
}

VcdWriter::Id VcdWriter::add_real(std::string_view name, double initial) {
    return declare(name, VariableKind::real, 64, std::bit_cast<std::uint64_t>(std::isfinite(initial) ? initial : 0.0));
}

VcdWriter::Id VcdWriter::declare(std::string_view name, VariableKind kind, int bits, std::uint64_t value) {
    MOTIONRACK_ASSERT(declaring_);
    const auto id = static_cast<Id>(variables_.size());
    Variable variable{value, {}, 0, static_cast<std::uint8_t>(bits), kind};
    std::size_t rest = id;
    do {  // codes use the printable characters '!' .. '~'
        variable.code[variable.code_length++] = static_cast<char>('!' + rest % 94);
        rest /= 94;
    } while (rest-- > 0);
    const std::string_view code(variable.code, variable.code_length);
    std::string full;
    for (std::size_t i = 0; full_names_ && i < scopes_.size(); ++i) full += scopes_[i] + '_';
    const std::string unique = unique_name(full.append(name));
    const char* type = kind == VariableKind::real ? "real" : "wire";
    put(kind == VariableKind::vector && bits > 1
            ? fmt::format("$var {} {} {} {} [{}:0] $end\n", type, bits, code, unique, bits - 1)
            : fmt::format("$var {} {} {} {} $end\n", type, bits, code, unique));
    variables_.push_back(variable);
    return id;
}

void VcdWriter::end_declarations() {
    declaring_ = false;
    for (std::size_t open = names_.size(); open > 1; --open) put("$upscope $end\n");
    names_.clear();
    scopes_.clear();
    put("$enddefinitions $end\n#0\n$dumpvars\n");
    for (const Variable& variable : variables_) {
        reserve(max_change_bytes);
        put_value(variable);
    }
    put("$end\n");
    unit_ = 0;
    unit_end_ = Duration{timescale_};
}

void VcdWriter::change(Id id, std::uint64_t value, Instant at) {
    if (declaring_) end_declarations();
    MOTIONRACK_ASSERT(id < variables_.size() && at >= now_);
    Variable& variable = variables_[id];
    MOTIONRACK_ASSERT(variable.kind != VariableKind::real);
    value = cut(value, variable.bits);
    now_ = at;
    if (value == variable.value) return;
    variable.value = value;
    reserve(max_change_bytes);
    advance(at);
    put_value(variable);
}

void VcdWriter::change_real(Id id, double value, Instant at) {
    if (declaring_) end_declarations();
    MOTIONRACK_ASSERT(id < variables_.size() && at >= now_);
    Variable& variable = variables_[id];
    MOTIONRACK_ASSERT(variable.kind == VariableKind::real);
    now_ = at;
    if (!std::isfinite(value) || value == std::bit_cast<double>(variable.value)) return;
    variable.value = std::bit_cast<std::uint64_t>(value);
    reserve(max_change_bytes);
    advance(at);
    put_value(variable);
}

Result<void> VcdWriter::close(Instant end) {
    if (file_ && !gave_up_) {
        if (declaring_) end_declarations();
        reserve(max_change_bytes);
        if (end >= now_ && end > Instant{0}) advance(end);
        write_out();
        (void)file_.commit();
    }
    return file_.reported("VCD");
}

void VcdWriter::put(std::string_view text) {
    while (!text.empty()) {
        reserve(1);
        const std::size_t part = std::min(text.size(), buffer_.size() - used_);
        std::memcpy(buffer_.data() + used_, text.data(), part);
        used_ += part;
        text.remove_prefix(part);
    }
}

/// Writes the value; requires buffer space.
void VcdWriter::put_value(const Variable& variable) {
    char* at = buffer_.data() + used_;
    if (variable.kind == VariableKind::wire) {
        *at++ = static_cast<char>('0' + variable.value);
    } else if (variable.kind == VariableKind::vector) {
        *at++ = 'b';
        for (int bit = std::max(1, static_cast<int>(std::bit_width(variable.value))); bit-- > 0;) {
            *at++ = static_cast<char>('0' + (variable.value >> bit & 1U));
        }
        *at++ = ' ';
    } else {
        *at++ = 'r';
        at = fmt::format_to(at, "{}", std::bit_cast<double>(variable.value));
        *at++ = ' ';
    }
    for (std::uint8_t i = 0; i < variable.code_length; ++i) *at++ = variable.code[i];
    *at++ = '\n';
    used_ = static_cast<std::size_t>(at - buffer_.data());
}

void VcdWriter::reserve(std::size_t bytes) {
    if (buffer_.size() - used_ < bytes) flush();
}

/// Unwritten data stays in the buffer.
void VcdWriter::write_out() {
    if (!gave_up_) file_.try_again();
    const std::uint64_t before = file_.written();
    (void)file_.write({buffer_.data(), used_});
    const auto done = static_cast<std::size_t>(file_.written() - before);
    used_ -= done;
    std::memmove(buffer_.data(), buffer_.data() + done, used_);
}

/// Empties the buffer in any case.
void VcdWriter::flush() {
    write_out();
    gave_up_ = gave_up_ || used_ > 0;
    used_ = 0;
}

/// Writes the time of `at` unless already written; requires buffer space.
void VcdWriter::advance(Instant at) {
    if (at < unit_end_) return;
    unit_ = timescale_ == 1 ? at.count() : at.count() / timescale_;
    unit_end_ = unit_ > (never.count() / timescale_) - 1 ? never : Instant{(unit_ + 1) * timescale_};
    put_time(unit_);
}

void VcdWriter::put_time(std::int64_t units) {
    const std::int64_t high = units / low_base;
    const auto low = static_cast<std::uint32_t>(units % low_base);
    char* at = buffer_.data() + used_;
    *at++ = '#';
    if (high == 0) {
        char digits[8];
        put_eight(digits, low);
        std::size_t zeros = 0;
        while (zeros < 7 && digits[zeros] == '0') ++zeros;
        std::memcpy(at, digits + zeros, 8 - zeros);
        at += 8 - zeros;
    } else {
        if (high != high_) {
            high_ = high;
            high_length_ = static_cast<std::size_t>(fmt::format_to(high_text_, "{}", high) - high_text_);
        }
        std::memcpy(at, high_text_, sizeof high_text_);
        at += high_length_;
        put_eight(at, low);
        at += 8;
    }
    *at++ = '\n';
    used_ = static_cast<std::size_t>(at - buffer_.data());
}

}  // namespace motionrack::trace
