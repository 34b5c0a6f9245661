// Parses TOML text into the tree of nodes. toml++ handles the syntax; a scanner before it rejects inputs that version
// 3.3 cannot handle:
//   - very long dotted keys, which nest tables until their destruction overruns the stack;
//   - a header without a key ("[{"), where it asserts, or assumes for the optimiser, that a key exists;
//   - brackets that do not match ("[}"), another assumption of the same kind;
//   - quotes within a number or word ("1\"a"), which end it for the scanner but not for the parser;
//   - a date and half a time after a blank ("1979-05-27 7"), one more such assumption;
//   - characters beyond ASCII where it tests for blanks (its table of blanks runs into "unreachable").
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>

namespace motionrack::rack {
namespace {

/// Reads only strings, comments, brackets and dots of a TOML text, by the grammar.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;  // a byte order mark
    }

    /// Returns an error for an input that the parser must not receive, or nothing.
    std::optional<Error> find() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                if (!text_may_begin()) {
                    return error("This is not TOML: a quote in the middle of a word. Nothing was read.");
                }
                if (auto bad = skip_string(c)) return bad;
                continue;
            }
            if (not_ascii(at_)) {
                return error(
                    "Letters other than a-z and A-Z are allowed only in quotes and comments. Nothing was read.");
            }
            if (c == ' ' && digit(at_ + 1) && after_word()) {
                return error(
                    "Two values with only a blank between them; a rack file has one value for a key, and no dates. "
                    "Nothing was read.");
            }
            if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
                continue;
            }
            if (c == '[' && open_.empty() && !value_ && !key_follows()) {
                return error("This is not TOML: after '[' a section needs a name, such as [axis.X]. Nothing was read.");
            }
            if (c == '[' || c == '{') open_ += c;
            if ((c == '.' && ++dots_ > max_toml_depth) || open_.size() > max_toml_depth) {
                return error(fmt::format(
                    "More than {} levels of dotted keys or brackets; a rack file needs 3. Nothing was read.",
                    max_toml_depth));
            }
            if (c == ']' || c == '}') {
                if (open_.empty() || open_.back() != (c == ']' ? '[' : '{')) {
                    return error(fmt::format(
                        "This is not TOML: '{}' closes a bracket that was not opened. Nothing was read.", c));
                }
                open_.pop_back();
            }
            if (c == '=' || c == ',' || c == '\n' || c == '[' || c == '{') dots_ = 0;
            if (c == '=' || c == '}') value_ = true;
            if (c == '{' || (c == ',' && !open_.empty() && open_.back() == '{')) value_ = false;
            if (c == '\n') next_line();
            ++at_;
        }
        return {};
    }

  private:
    void next_line() {
        ++line_;
        line_start_ = at_ + 1;
        if (open_.empty()) value_ = false;
    }

    Error error(std::string what) const {
        const std::string_view before = text_.substr(line_start_, at_ - line_start_);
        const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
        const auto bytes_more = std::count_if(before.begin(), before.end(), continues);
        const int column = static_cast<int>(before.size()) - static_cast<int>(bytes_more) + 1;
        return {ErrorKind::invalid_input, std::move(what), {}, {line_, column}};
    }

    /// Returns true if a quote at this position begins a text or a quoted key.
    bool text_may_begin() const { return !after_word() || (text_[at_ - 1] == '.' && !value_); }

    /// Returns true if a key follows a header's '[' or '[[' and blanks. A closing bracket also counts; the parser
    /// itself rejects it.
    bool key_follows() const {
        const auto past_blanks = [&](std::size_t from) {
            return std::min(text_.find_first_not_of(" \t", from), text_.size());
        };
        std::size_t next = past_blanks(at_ + 1);
        if (next < text_.size() && text_[next] == '[') next = past_blanks(next + 1);
        if (next == text_.size()) return true;
        const char c = text_[next];
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-\"']").find(c) != std::string_view::npos;
    }

    bool triple(char quote) const {
        return at_ + 2 < text_.size() && text_[at_] == quote && text_[at_ + 1] == quote && text_[at_ + 2] == quote;
    }

    bool not_ascii(std::size_t at) const { return at < text_.size() && static_cast<unsigned char>(text_[at]) >= 0x80; }

    bool after_word() const {
        return at_ > line_start_ && std::string_view("\t =,[{").find(text_[at_ - 1]) == std::string_view::npos;
    }

    bool digit(std::size_t at) const { return at < text_.size() && text_[at] >= '0' && text_[at] <= '9'; }

    std::optional<Error> skip_string(char quote) {
        const bool many_lines = triple(quote);
        at_ += many_lines ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!many_lines) return {};  // a syntax error, which the parser reports
                next_line();
            }
            if (c == '\\' && quote == '"') {
                if (auto bad = skip_escape(many_lines)) return bad;
                continue;
            }
            if (c == quote && (!many_lines || triple(quote))) {
                at_ += many_lines ? 3 : 1;
                // Up to two quotes may stand before the closing three.
                for (int more = 0; many_lines && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
                return {};
            }
            ++at_;
        }
        return {};
    }

    /// Skips a backslash and its escape: one character, or blanks and line ends up to the text's next character.
    std::optional<Error> skip_escape(bool many_lines) {
        const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
        ++at_;
        if (many_lines && at_ < text_.size() && blank(text_[at_])) {
            for (; at_ < text_.size() && blank(text_[at_]); ++at_) {
                if (text_[at_] == '\n') next_line();
            }
        } else if (at_ < text_.size() && text_[at_] != '\n' && !not_ascii(at_)) {
            ++at_;
            return {};
        }
        if (!not_ascii(at_)) return {};
        return error(
            "After a backslash only letters a-z and A-Z can be read; write this text on one line. Nothing was read.");
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_start_ = 0;
    int line_ = 1;
    int dots_ = 0;
    bool value_ = false;  ///< after '=', up to the end of the line or of the entry
    std::string open_;    ///< open brackets, outermost first
};

TextPosition to_place(const toml::source_position& position) {
    return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

void convert(const toml::node& from, TomlNode& to);

void convert_table(const toml::table& table, TomlNode& to) {
    to.type = TomlType::table;
    for (const auto& [key, value] : table) {
        TomlNode child;
        child.key = std::string(key.str());
        child.key_location = to_place(key.source().begin);
        child.value_location = to_place(value.source().begin);
        convert(value, child);
        to.children.push_back(std::move(child));
    }
    std::stable_sort(to.children.begin(), to.children.end(), [](const TomlNode& a, const TomlNode& b) {
        const TextPosition &p = a.key_location, &q = b.key_location;
        return p.line != q.line ? p.line < q.line : p.column < q.column;
    });
}

void convert_array(const toml::array& array, TomlNode& to) {
    to.type = TomlType::array;
    for (const toml::node& value : array) {
        TomlNode child;
        child.key_location = child.value_location = to_place(value.source().begin);
        convert(value, child);
        to.children.push_back(std::move(child));
    }
}

void convert(const toml::node& from, TomlNode& to) {
    if (const auto* table = from.as_table()) return convert_table(*table, to);
    if (const auto* array = from.as_array()) return convert_array(*array, to);
    if (const auto* text = from.as_string()) {
        to.type = TomlType::text;
        to.text = text->get();
    } else if (const auto* integer = from.as_integer()) {
        to.type = TomlType::integer;
        to.integer = integer->get();
    } else if (const auto* number = from.as_floating_point()) {
        to.type = TomlType::number;
        to.number = number->get();
    } else if (const auto* flag = from.as_boolean()) {
        to.type = TomlType::flag;
        to.flag = flag->get();
    } else {
        to.type = TomlType::date;
    }
}

/// toml++ reads numbers through a stream, which reports a lack of memory as an invalid number. A rejected text is
/// therefore parsed once more.
toml::table parse_twice(std::string_view text) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error&) {
        return toml::parse(text);
    }
}

}  // namespace

Result<TomlNode> parse_toml(std::string_view text, std::string_view file) {
    if (text.size() > max_toml_bytes) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("The text has {} bytes; a rack file has at most {}. Nothing was read.", text.size(),
                                max_toml_bytes),
                    {}, std::string(file));
    }
    if (auto error = Scanner(text).find()) {
        error->file = file;
        return tl::unexpected<Error>(std::move(*error));
    }
    try {
        const toml::table table = parse_twice(text);
        TomlNode root;
        root.key_location = root.value_location = {1, 1};
        convert_table(table, root);
        return root;
    } catch (const toml::parse_error& error) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("This is not TOML: {}. Nothing was read.", printable(error.description(), 300)),
                    to_place(error.source().begin), std::string(file));
    }
}

}  // namespace motionrack::rack
