// Parses requests and writes answers.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/frontends/server/http.hpp>

namespace motionrack::server {

namespace {

constexpr int max_nesting = 16;

/// Returns the position of byte `at` of the text.
TextPosition location_of(std::string_view text, std::size_t at) {
    TextPosition location{1, 1};
    for (const char c : text.substr(0, at)) {
        ++location.column;
        if (c == '\n') ++location.line, location.column = 1;
    }
    return location;
}

/// Returns the index of the first bracket that is nested too deeply; npos: none. Deep values would use stack wherever
/// they are copied.
std::size_t too_deep(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                quoted = false;
        } else if (c == '"')
            quoted = true;
        else if ((c == '[' || c == '{') && ++depth > max_nesting)
            return i;
        else if (c == ']' || c == '}')
            --depth;
    }
    return std::string_view::npos;
}

int hexadecimal(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

Result<std::string> decoded(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '+')
            out += ' ';
        else if (text[i] != '%')
            out += text[i];
        else {
            const int high = i + 2 < text.size() ? hexadecimal(text[i + 1]) : -1,
                      low = i + 2 < text.size() ? hexadecimal(text[i + 2]) : -1;
            if (high < 0 || low < 0)
                return fail(ErrorKind::invalid_input,
                            "A % in the address must be followed by two hexadecimal digits. Nothing was done.");
            out += static_cast<char>(high * 16 + low);
            i += 2;
        }
    }
    return out;
}

}  // namespace

HttpAnswer http_answer(const panel::Answer& answer) {
    HttpAnswer out;
    out.status = answer.status;
    out.body = std::make_shared<const std::string>(panel::text_of(answer.body) + "\n");
    if (answer.status == 401) out.more.emplace_back("WWW-Authenticate", "Bearer");
    if (answer.status == 429 || answer.status == 503) out.more.emplace_back("Retry-After", "1");
    return out;
}

HttpAnswer http_error(int status, std::string_view trouble, std::string sentence) {
    return http_answer(panel::refused_answer(status, trouble, std::move(sentence)));
}

Result<nlohmann::json> read_object(std::string_view text, std::string_view what) {
    if (const std::size_t at = too_deep(text); at != std::string_view::npos)
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} is nested deeper than {}. Nothing was done.", what, max_nesting),
                    location_of(text, at));
    try {
        nlohmann::json value = nlohmann::json::parse(text);
        if (!value.is_object())
            return fail(ErrorKind::invalid_input,
                        fmt::format("{} is not a JSON object, {{\"name\":value, ..}}. Nothing was done.", what),
                        {1, 1});
        return value;
    } catch (const nlohmann::json::parse_error& error) {
        const TextPosition location = location_of(text, std::min(text.size(), error.byte > 0 ? error.byte - 1 : 0));
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} is not valid JSON: see line {}, column {}. Nothing was done.", what, location.line,
                                location.column),
                    location);
    } catch (const nlohmann::json::exception&) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} has a number that is too large. Nothing was done.", what));
    }
}

Result<RequestTarget> read_target(std::string_view target) {
    RequestTarget out;
    const std::size_t question = target.find('?');
    out.path = target.substr(0, question);
    if (question == std::string_view::npos) return out;
    std::string_view rest = target.substr(question + 1);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('&'), rest.size());
        const std::string_view one = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (one.empty()) continue;
        const std::size_t equals = std::min(one.find('='), one.size());
        MOTIONRACK_TRY(std::string name, decoded(one.substr(0, equals)));
        MOTIONRACK_TRY(std::string value, decoded(one.substr(std::min(equals + 1, one.size()))));
        out.texts.emplace_back(std::move(name), std::move(value));
    }
    return out;
}

}  // namespace motionrack::server
