// Selection of the reader for a capture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <motionrack/decode/capture.hpp>

namespace motionrack::decode {

namespace {

constexpr std::array<std::pair<Format, const char*>, 4> names = {
    {{Format::automatic, "automatic"}, {Format::vcd, "VCD"}, {Format::csv, "CSV"}, {Format::raw, "raw"}}};

bool ends_in(const std::string& name, std::string_view ending) {
    if (name.size() < ending.size()) return false;
    for (std::size_t i = 0; i < ending.size(); ++i)
        if ((name[name.size() - ending.size() + i] | 0x20) != (ending[i] | 0x20)) return false;
    return true;
}

/// A source with look-ahead to its first bytes.
class Looked final : public Source {
  public:
    explicit Looked(std::unique_ptr<Source> source) : source_(std::move(source)) {}
    /// The first bytes, up to 512.
    Result<std::string_view> peek() {
        while (size_ < head_.size()) {
            MOTIONRACK_TRY(const std::size_t got, source_->read(head_.data() + size_, head_.size() - size_));
            if (got == 0) break;
            size_ += got;
        }
        return std::string_view(head_.data(), size_);
    }
    /// Skips the first bytes (of the look-ahead).
    void skip(std::size_t size) { at_ = size; }
    Result<std::size_t> read(char* to, std::size_t size) override {
        if (at_ == size_) return source_->read(to, size);
        const std::size_t got = std::min(size, size_ - at_);
        std::memcpy(to, head_.data() + at_, got);
        at_ += got;
        return got;
    }
    std::uint64_t total() const override { return source_->total(); }

  private:
    std::unique_ptr<Source> source_;
    std::array<char, 512> head_;
    std::size_t at_ = 0, size_ = 0;
};

constexpr std::string_view sigrok_begin = "META samplerate: ";

/// The line that sigrok-cli writes before binary samples, with its end; "" if absent.
std::string_view sigrok_line(std::string_view head) {
    const std::size_t end = head.substr(0, 64).find('\n');
    return head.starts_with(sigrok_begin) && end != std::string_view::npos ? head.substr(0, end + 1)
                                                                           : std::string_view();
}

Format guess(const std::string& name, std::string_view head) {
    if (ends_in(name, ".vcd")) return Format::vcd;
    if (ends_in(name, ".csv")) return Format::csv;
    if (ends_in(name, ".bin") || ends_in(name, ".raw")) return Format::raw;
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && head[first] == '$') return Format::vcd;
    for (const char c : head)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t') return Format::raw;
    return Format::csv;
}

}  // namespace

const char* name_of(Format format) {
    for (const auto& [known, name] : names)
        if (known == format) return name;
    return "";
}

Result<std::unique_ptr<Capture>> open_capture(std::unique_ptr<Source> source, const std::string& name,
                                              const CaptureSettings& settings) {
    auto looked = std::make_unique<Looked>(std::move(source));
    MOTIONRACK_TRY(const std::string_view head, looked->peek());
    if (head.empty()) return fail(ErrorKind::invalid_input, "The file is empty. Nothing was decoded.", {}, name);
    const Format format = settings.format == Format::automatic ? guess(name, head) : settings.format;
    if (settings.format != Format::raw && head.rfind("PK\3\4", 0) == 0)
        return fail(ErrorKind::invalid_input,
                    "This is a packed file (a session of sigrok or Saleae?). Nothing was decoded; make a VCD file of "
                    "it, for instance with "
                    "sigrok-cli -i in.sr -O vcd -o out.vcd.",
                    {}, name);
    if (format == Format::raw && !sigrok_line(head).empty()) {
        const std::string_view line = sigrok_line(head),
                               said = line.substr(sigrok_begin.size(), line.size() - sigrok_begin.size() - 1);
        CaptureSettings reported = settings;
        if (const auto rate = read_rate(said); rate && !(reported.sample_rate_hz > 0)) reported.sample_rate_hz = *rate;
        looked->skip(line.size());
        return open_raw(std::move(looked), name, reported);
    }
    switch (format) {
        case Format::vcd:
            return open_vcd(std::move(looked), name);
        case Format::raw:
            return open_raw(std::move(looked), name, settings);
        default:
            return open_csv(std::move(looked), name, settings);
    }
}

Result<double> read_rate(std::string_view text) {
    double number = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string unit;
    for (const char* at = end; bad == std::errc() && at < text.data() + text.size(); ++at)
        if (*at != ' ') unit += static_cast<char>(*at | 0x20);
    if (unit.size() >= 2 && unit.substr(unit.size() - 2) == "hz") unit.resize(unit.size() - 2);
    const double factor = unit.empty() ? 1 : unit == "k" ? 1e3 : unit == "m" ? 1e6 : unit == "g" ? 1e9 : 0;
    const double rate = number * factor;
    if (bad != std::errc() || !(rate >= 1e-3 && rate <= 1e12))
        return fail(ErrorKind::invalid_input, fmt::format("'{}' is not a sample rate. Write a number with k, M or G, "
                                                          "such as 24M or 500 kHz, from 0.001 to 1000 G.",
                                                          text.substr(0, 40)));
    return rate;
}

}  // namespace motionrack::decode
