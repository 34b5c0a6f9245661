// Splits rows into fields.
#include <fmt/format.h>

#include <motionrack/trace/csv_rows.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t max_field = 1 << 20, max_fields = 4096;

}  // namespace

Result<CsvRows> CsvRows::open(const std::string& path) {
    CsvRows out;
    MOTIONRACK_TRY(out.bytes_, FileBytes::open(path));
    // Spreadsheets write a byte order mark at the start of a file.
    for (const int mark : {0xEF, 0xBB, 0xBF})
        if (out.bytes_.peek() == mark) out.bytes_.get();
    MOTIONRACK_TRY(const bool any, out.read(out.head_));
    if (!any) return fail(ErrorKind::invalid_input, "The file is empty.", {}, path);
    return out;
}

tl::unexpected<Error> CsvRows::refuse(const std::string& message) const {
    return fail(ErrorKind::invalid_input, message, {line_, 0}, bytes_.path());
}

Result<bool> CsvRows::next(std::vector<std::string>& fields) {
    bool any = false;
    do {
        MOTIONRACK_TRY(any, read(fields));
    } while (any && is_blank(fields));
    if (any && fields.size() != head_.size()) {
        if (!cut_) return refuse(fmt::format("The row has {} fields, the header {}.", fields.size(), head_.size()));
        return false;
    }
    return any;
}

/// An empty line in a table of several columns; editors leave one at the end.
bool CsvRows::is_blank(const std::vector<std::string>& fields) const {
    return head_.size() > 1 && fields.size() == 1 && fields[0].empty();
}

Result<bool> CsvRows::read(std::vector<std::string>& fields) {
    line_ = next_line_;
    fields.clear();
    if (bytes_.peek() < 0) {
        MOTIONRACK_CHECK(bytes_.check());
        return false;
    }
    fields.emplace_back();
    bool quoted = false;
    while (true) {
        const int c = bytes_.get();
        if (c < 0) {
            cut_ = true;
            MOTIONRACK_CHECK(bytes_.check());
            return true;
        }
        next_line_ += c == '\n';
        if (quoted) {
            if (c != '"')
                fields.back() += static_cast<char>(c);
            else if (bytes_.peek() == '"')
                fields.back() += static_cast<char>(bytes_.get());
            else
                quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == ',') {
            fields.emplace_back();
        } else if (c == '\n') {
            if (!fields.back().empty() && fields.back().back() == '\r') fields.back().pop_back();
            return true;
        } else {
            fields.back() += static_cast<char>(c);
        }
        if (fields.back().size() > max_field || fields.size() > max_fields)
            return refuse("The row is longer than a row of a recording can be; is this a CSV file?");
    }
}

}  // namespace motionrack::trace
