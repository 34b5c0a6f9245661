// Rows as messages: a head, then one "name value" line per cell.
#include <algorithm>
#include <motionrack/nats/distributed_sweep.hpp>

namespace motionrack::nats {

namespace {

constexpr std::string_view row_head = "motionrack row 1\n", trouble_head = "motionrack trouble 1\n";

}  // namespace

std::string text_of(const sweep::Row& row) {
    std::string out(row_head);
    for (const auto& [name, cell] : row) out += name + " " + cell + "\n";
    return out;
}

std::string text_of(const Error& error) {
    return std::string(trouble_head) + error.text();
}

Result<sweep::Row> read_answer(std::string_view text) {
    const auto damaged = [] {
        return fail(ErrorKind::invalid_input,
                    "A message of the server is not a row of a sweep, or damaged; it was ignored.");
    };
    if (text.starts_with(trouble_head)) return fail(ErrorKind::refused, std::string(text.substr(trouble_head.size())));
    if (!text.starts_with(row_head)) return damaged();
    text.remove_prefix(row_head.size());
    const auto columns = sweep::result_columns();
    sweep::Row out;
    while (!text.empty()) {
        const std::size_t end = text.find('\n'), blank = text.find(' ');
        if (end == std::string_view::npos || blank >= end) return damaged();
        const std::string_view name = text.substr(0, blank);
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const sweep::ResultColumn& column) { return column.name == name; }))
            return damaged();
        out.emplace_back(name, text.substr(blank + 1, end - blank - 1));
        text.remove_prefix(end + 1);
    }
    if (sweep::cell_of(out, "ended").empty()) return damaged();
    return out;
}

std::string name_of(const sweep::Sweep& sweep) {
    std::string keys;
    for (std::int64_t i = 0; i < sweep.points(); ++i) keys += sweep.key(i);
    return sweep::key_of(keys);
}

}  // namespace motionrack::nats
