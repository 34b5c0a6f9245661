// From TOML text to the tree of nodes: toml++ does the syntax; depth and size are checked before it sees the text,
// because a very long dotted key would nest its tables until their destruction overruns the stack.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {
namespace {

/// Reads strings, comments, brackets and dots of a TOML text as its grammar does, and nothing else.
class DepthScanner {
  public:
    explicit DepthScanner(std::string_view text) : text_(text) {}

    /// The place where the nesting becomes too deep, or line 0.
    Place too_deep() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skip_string(c);
                continue;
            }
            if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
                continue;
            }
            if (c == '.' && ++dots_ > max_toml_depth) return here();
            if ((c == '[' || c == '{') && ++brackets_ > max_toml_depth) return here();
            if (c == ']' || c == '}') brackets_ = std::max(0, brackets_ - 1);
            if (c == '=' || c == ',' || c == '\n' || c == '[' || c == '{') dots_ = 0;
            if (c == '\n') next_line();
            ++at_;
        }
        return {};
    }

  private:
    void next_line() {
        ++line_;
        line_start_ = at_ + 1;
    }

    Place here() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }

    bool triple(char quote) const {
        return at_ + 2 < text_.size() && text_[at_] == quote && text_[at_ + 1] == quote && text_[at_ + 2] == quote;
    }

    void skip_string(char quote) {
        const bool many_lines = triple(quote);
        at_ += many_lines ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!many_lines) return;  // a syntax error; toml++ tells it
                next_line();
            }
            if (c == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
                at_ += 2;
                continue;
            }
            if (c == quote && (!many_lines || triple(quote))) {
                at_ += many_lines ? 3 : 1;
                // Up to two quotes may stand before the closing three.
                for (int more = 0; many_lines && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
                return;
            }
            ++at_;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_start_ = 0;
    int line_ = 1;
    int dots_ = 0;
    int brackets_ = 0;
};

Place to_place(const toml::source_position& position) {
    return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

void convert(const toml::node& from, TomlNode& to);

void convert_table(const toml::table& table, TomlNode& to) {
    to.type = TomlType::table;
    for (const auto& [key, value] : table) {
        TomlNode child;
        child.key = std::string(key.str());
        child.key_place = to_place(key.source().begin);
        child.value_place = to_place(value.source().begin);
        convert(value, child);
        to.children.push_back(std::move(child));
    }
    std::stable_sort(to.children.begin(), to.children.end(), [](const TomlNode& a, const TomlNode& b) {
        const Place &p = a.key_place, &q = b.key_place;
        return p.line != q.line ? p.line < q.line : p.column < q.column;
    });
}

void convert(const toml::node& from, TomlNode& to) {
    if (const auto* table = from.as_table()) return convert_table(*table, to);
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
        to.type = from.is_array() ? TomlType::array : TomlType::date;
    }
}

}  // namespace

Result<TomlNode> parse_toml(std::string_view text, std::string_view file) {
    if (text.size() > max_toml_bytes) {
        return fail(Trouble::bad_input,
                    fmt::format("The text has {} bytes; a rack file has at most {}. Nothing was read.", text.size(),
                                max_toml_bytes),
                    {}, std::string(file));
    }
    if (const Place deep = DepthScanner(text).too_deep(); deep.line > 0) {
        return fail(
            Trouble::bad_input,
            fmt::format("More than {} levels of dotted keys or brackets; a rack file needs 3. Nothing was read.",
                        max_toml_depth),
            deep, std::string(file));
    }
    try {
        const toml::table table = toml::parse(text);
        TomlNode root;
        root.key_place = root.value_place = {1, 1};
        convert_table(table, root);
        return root;
    } catch (const toml::parse_error& error) {
        return fail(Trouble::bad_input,
                    fmt::format("This is not TOML: {}. Nothing was read.", printable(error.description(), 300)),
                    to_place(error.source().begin), std::string(file));
    }
}

}  // namespace motionrack::rack
