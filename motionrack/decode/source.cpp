// Files are read in pieces, so a capture may be larger than the memory.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <motionrack/decode/source.hpp>
#include <system_error>

namespace motionrack::decode {

namespace {

class FileSource final : public Source {
  public:
    FileSource(std::FILE* file, std::string path) : file_(file), path_(std::move(path)) {
        if (file_ == stdin || std::fseek(file_, 0, SEEK_END) != 0) return;
        if (const long size = std::ftell(file_); size > 0 && size < std::numeric_limits<long>::max())
            total_ = static_cast<std::uint64_t>(size);
        std::rewind(file_);
    }
    ~FileSource() override {
        if (file_ != stdin) std::fclose(file_);
    }
    FileSource(const FileSource&) = delete;
    FileSource& operator=(const FileSource&) = delete;

    Result<std::size_t> read(char* to, std::size_t size) override {
        const std::size_t got = std::fread(to, 1, size, file_);
        if (got == 0 && std::ferror(file_) != 0)
            return fail(
                ErrorKind::io,
                fmt::format("The capture cannot be read: {}. {}", std::generic_category().message(errno),
                            errno == EISDIR ? "A capture is a file, not a folder." : "Nothing more was decoded."),
                {}, path_);
        return got;
    }
    std::uint64_t total() const override { return total_; }

  private:
    std::FILE* file_;
    std::string path_;
    std::uint64_t total_ = 0;
};

class MemorySource final : public Source {
  public:
    explicit MemorySource(std::string_view text) : text_(text) {}
    Result<std::size_t> read(char* to, std::size_t size) override {
        const std::size_t got = std::min(size, text_.size() - at_);
        if (got > 0) std::memcpy(to, text_.data() + at_, got);
        at_ += got;
        return got;
    }
    std::uint64_t total() const override { return text_.size(); }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

bool is_white(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

Result<std::unique_ptr<Source>> open_file(const std::string& path) {
    std::FILE* file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
    if (!file)
        return fail(ErrorKind::io,
                    fmt::format("{} cannot be read: {}. Nothing was decoded; check the name and the permissions.", path,
                                std::generic_category().message(errno)));
    return std::make_unique<FileSource>(file, path);
}

std::unique_ptr<Source> from_memory(std::string_view text) {
    return std::make_unique<MemorySource>(text);
}

/// Reads more data after the unread part. Returns false at the end of the file and after an error.
bool TextReader::more() {
    if (over_ || error_) return false;
    if (at_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
        line_start_ -= at_, end_ -= at_, at_ = 0;
    }
    if (end_ >= max_line_bytes) {
        error_ = Error{ErrorKind::invalid_input,
                       fmt::format("A line or word has more than {} bytes: this is not a text file. Nothing more was "
                                   "decoded; add --format raw if it is binary.",
                                   max_line_bytes),
                       {},
                       {static_cast<int>(std::min<std::int64_t>(next_line_, std::numeric_limits<int>::max())), 1}};
        return false;
    }
    if (buffer_.size() - end_ < first_size / 2) buffer_.resize(buffer_.size() * 2);
    const Result<std::size_t> got = source_.read(buffer_.data() + end_, buffer_.size() - end_);
    if (!got) {
        error_ = got.error();
        return false;
    }
    over_ = *got == 0;
    end_ += *got, bytes_ += *got;
    return !over_;
}

bool TextReader::line(std::string_view& out) {
    std::size_t looked = 0;
    const char* found = nullptr;
    for (;;) {
        found = static_cast<const char*>(std::memchr(buffer_.data() + at_ + looked, '\n', end_ - at_ - looked));
        if (found) break;
        looked = end_ - at_;
        if (!more()) break;
    }
    if (error_ || (!found && at_ == end_)) return false;
    const std::size_t size = found ? static_cast<std::size_t>(found - buffer_.data()) - at_ : end_ - at_;
    out = {buffer_.data() + at_, size};
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    cut_ = !found;
    line_ = next_line_++;
    column_ = 1;
    at_ += size + (found ? 1 : 0);
    return true;
}

bool TextReader::skip_white() {
    for (;;) {
        for (; at_ < end_ && is_white(buffer_[at_]); ++at_)
            if (buffer_[at_] == '\n') ++next_line_, line_start_ = at_ + 1;
        if (at_ < end_) return true;
        if (!more()) return false;
    }
}

char TextReader::peek() {
    return skip_white() ? buffer_[at_] : '\0';
}

bool TextReader::word(std::string_view& out) {
    if (!skip_white()) return false;
    std::size_t size = 1;
    for (;;) {
        while (at_ + size < end_ && !is_white(buffer_[at_ + size])) ++size;
        if (at_ + size < end_ || !more()) break;
    }
    if (error_) return false;
    cut_ = at_ + size == end_;
    line_ = next_line_;
    column_ = static_cast<int>(std::min<std::size_t>(at_ - line_start_ + 1, std::numeric_limits<int>::max()));
    out = {buffer_.data() + at_, size};
    at_ += size;
    return true;
}

}  // namespace motionrack::decode
