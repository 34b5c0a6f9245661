// Reader of VCD files (IEEE 1364, clause 18), word by word.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <motionrack/decode/sampler.hpp>
#include <unordered_map>

namespace motionrack::decode {

namespace {

constexpr std::size_t max_signals = 100'000;
constexpr int widest = 4096;
constexpr std::size_t max_name = 1000;  ///< bytes, with its scopes: a long name is stored for each of its lines

/// A bit of a variable, and its chosen line.
struct Tap {
    int bit = 0;
    std::size_t line = 0;
};

struct Variable {
    int width = 1;
    std::vector<Tap> taps;
};

class VcdCapture final : public Capture {
  public:
    VcdCapture(std::unique_ptr<Source> source, const std::string& name)
        : Capture(std::move(source), name), text_(*source_) {
        format_ = Format::vcd;
        timed_ = true;
    }
    Result<void> read_head();
    void choose(const std::vector<std::size_t>& signals) override;
    Result<bool> next(SampleBlock& block) override;
    std::uint64_t bytes_read() const override { return text_.bytes(); }

  private:
    struct SignalAt {
        std::size_t variable;
        int bit;
    };

    Error ends_in(const char* what);
    Result<void> skip(const char* what);
    Result<void> words_until_end(std::vector<std::string>& words, const char* what);
    Result<void> declare(const std::vector<std::string>& words);
    Result<void> set_timescale(const std::vector<std::string>& words);
    Result<void> change(std::string_view word);
    Result<void> change_vector(std::string bits);
    Result<void> advance(std::string_view digits);
    Result<void> assign(std::string_view code, std::string_view bits);
    bool set_level(const Tap& tap, char level);
    void end();

    TextReader text_;
    std::vector<std::string> scopes_;
    std::unordered_map<std::string, std::size_t> codes_;
    std::vector<Variable> variables_;
    std::vector<SignalAt> places_;
    Sampler sampler_;
    std::int64_t now_ = 0;
    bool head_read_ = false;
    bool begun_ = false;    ///< a time has been read
    bool changed_ = false;  ///< since the last sample
    bool any_ = false;      ///< a sample has been taken
    bool ended_ = false;
    bool over_ = false;  ///< the file ended where more data were required
    std::string word_;   ///< stored between words
};

Error VcdCapture::ends_in(const char* what) {
    if (text_.error()) return in_file(*text_.error());
    over_ = true;
    return {ErrorKind::invalid_input,
            fmt::format("The file ends inside {}: it is cut off.{}", what, head_read_ ? "" : " Nothing was decoded."),
            name_, text_.location()};
}

Result<void> VcdCapture::words_until_end(std::vector<std::string>& words, const char* what) {
    words.clear();
    for (std::string_view word; text_.word(word);) {
        if (word == "$end") return {};
        if (words.size() < 64) words.emplace_back(word);
    }
    return tl::unexpected(ends_in(what));
}

Result<void> VcdCapture::skip(const char* what) {
    for (std::string_view word; text_.word(word);)
        if (word == "$end") return {};
    return tl::unexpected(ends_in(what));
}

Result<void> VcdCapture::read_head() {
    std::vector<std::string> words;
    for (std::string_view word; text_.word(word);) {
        const TextPosition location = text_.location();
        const std::string keyword(word);
        if (keyword.empty() || keyword[0] != '$')
            return refuse(
                fmt::format("'{}' in place of the declarations of a VCD file: this is not a VCD file. Nothing "
                            "was decoded; name its format with --format.",
                            keyword.substr(0, 40)),
                location);
        if (keyword == "$comment" || keyword == "$date" || keyword == "$version") {
            MOTIONRACK_CHECK(skip("its header"));
            continue;
        }
        MOTIONRACK_CHECK(words_until_end(words, "its header"));
        if (keyword == "$enddefinitions") {
            if (tick_s_ == 0)
                return refuse("The file has no $timescale, so its times have no unit. Nothing was decoded.", location);
            head_read_ = true;
            return {};
        }
        if (keyword == "$timescale") MOTIONRACK_CHECK(set_timescale(words));
        if (keyword == "$scope") scopes_.push_back(words.size() > 1 ? words[1] : "");
        if (keyword == "$upscope" && !scopes_.empty()) scopes_.pop_back();
        if (keyword == "$var") MOTIONRACK_CHECK(declare(words));
    }
    return tl::unexpected(ends_in("its header"));
}

Result<void> VcdCapture::set_timescale(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += word;
    static constexpr std::array<std::pair<std::string_view, double>, 6> units = {
        {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"ps", 1e-12}, {"fs", 1e-15}}};
    for (const auto& [multiple, factor] : {std::pair{"100", 100.0}, std::pair{"10", 10.0}, std::pair{"1", 1.0}})
        for (const auto& [unit, seconds] : units)
            if (text == std::string(multiple).append(unit)) {
                tick_s_ = factor * seconds;
                return {};
            }
    return refuse(
        fmt::format("The timescale is '{}': it must be 1, 10 or 100 of s, ms, us, ns, ps or fs. Nothing was decoded.",
                    text.substr(0, 40)),
        text_.location());
}

/// Reads a declaration: $var TYPE WIDTH CODE NAME [RANGE] $end
Result<void> VcdCapture::declare(const std::vector<std::string>& words) {
    if (words.size() < 4)
        return refuse(
            fmt::format("A $var needs type, width, code and name; this one has {} words. Nothing was decoded.",
                        words.size()),
            text_.location());
    int width = 0;
    const auto [end, bad] = std::from_chars(words[1].data(), words[1].data() + words[1].size(), width);
    if (bad != std::errc() || *end != '\0' || width < 0)
        return refuse(fmt::format("A $var has the width '{}'. Nothing was decoded.", words[1].substr(0, 40)),
                      text_.location());
    const auto [at, fresh] = codes_.try_emplace(words[2], variables_.size());
    if (fresh) variables_.push_back({width, {}});
    if (words[0] == "real" || words[0] == "string" || words[0] == "event" || words[0] == "parameter" || width < 1 ||
        width > widest)
        return {};
    std::string name;
    for (std::size_t i = 0; i < scopes_.size() && name.size() <= max_name; ++i) name += scopes_[i] + '.';
    name += words[3];
    int high = width - 1, low = 0;
    const std::string range = words.size() > 4 ? words[4] : "";
    if (name.size() + range.size() > max_name)
        return refuse(
            fmt::format("The name of a line has more than {} bytes, its scopes included. Nothing was decoded.",
                        max_name),
            text_.location());
    if (width == 1) {
        signals_.push_back(name + (range.find(':') == std::string::npos ? range : ""));
        places_.push_back({at->second, 0});
    } else {
        if (std::sscanf(range.c_str(), "[%6d:%6d]", &high, &low) != 2) high = width - 1, low = 0;
        for (int bit = width; bit-- > 0;) {
            signals_.push_back(fmt::format("{}[{}]", name, high >= low ? low + bit : low - bit));
            places_.push_back({at->second, bit});
        }
    }
    if (signals_.size() > max_signals)
        return refuse(fmt::format("The file declares more than {} lines. Nothing was decoded.", max_signals),
                      text_.location());
    return {};
}

void VcdCapture::choose(const std::vector<std::size_t>& signals) {
    Capture::choose(signals);
    for (std::size_t line = 0; line < signals.size(); ++line) {
        const SignalAt& at = places_[signals[line]];
        variables_[at.variable].taps.push_back({at.bit, line});
    }
    sampler_.begin(signals.size());
}

bool VcdCapture::set_level(const Tap& tap, char level) {
    LineFacts& facts = facts_[tap.line];
    if (level == '0' || level == '1') return sampler_.set(tap.line, level == '1', facts);
    if (sampler_.lose(tap.line, facts) && facts.unknown == 1)
        facts.first_unknown = fmt::format("line {}", text_.location().line);
    return false;
}

/// `bits`: 0, 1, x, z, the highest first; missing bits are 0, or equal to the highest one if that is x or z.
Result<void> VcdCapture::assign(std::string_view code, std::string_view bits) {
    word_.assign(code);
    const auto found = codes_.find(word_);
    if (found == codes_.end())
        return refuse(
            fmt::format("A value for '{}', which no $var declares. Nothing more was decoded.", word_.substr(0, 40)),
            text_.location());
    for (const Tap& tap : variables_[found->second].taps) {
        const auto bit = static_cast<std::size_t>(tap.bit);
        const char fill = bits.front() == '1' ? '0' : bits.front();
        changed_ |= set_level(tap, bit < bits.size() ? bits[bits.size() - 1 - bit] : fill);
    }
    return {};
}

Result<void> VcdCapture::advance(std::string_view digits) {
    std::int64_t time = 0;
    const auto [end, bad] = std::from_chars(digits.data(), digits.data() + digits.size(), time);
    if (bad != std::errc() || end != digits.data() + digits.size() || time < 0 || time > std::int64_t{1} << 61)
        return refuse(fmt::format("'#{}' is not a time. Nothing more was decoded.", digits.substr(0, 40)),
                      text_.location());
    if (begun_ && time < now_)
        return refuse(
            fmt::format(
                "Time goes backwards, from #{} to #{}. Nothing more was decoded; the file is damaged or is two files.",
                now_, time),
            text_.location());
    if (begun_ && time > now_ && (changed_ || !any_)) {
        sampler_.take(now_);
        any_ = true, changed_ = false;
    }
    now_ = time;
    begun_ = true;
    return {};
}

Result<void> VcdCapture::change_vector(std::string bits) {
    const bool vector = bits[0] == 'b' || bits[0] == 'B';
    bits.erase(0, 1);
    if (vector && (bits.empty() || bits.find_first_not_of("01xXzZuUwWlLhH-") != std::string::npos))
        return refuse(fmt::format("'b{}' is not a value of a vector. Nothing more was decoded.", bits.substr(0, 40)),
                      text_.location());
    std::string_view code;
    if (!text_.word(code)) return tl::unexpected(ends_in("a value"));
    return vector ? assign(code, bits) : Result<void>{};
}

Result<void> VcdCapture::change(std::string_view word) {
    switch (word[0]) {
        case '#':
            return advance(word.substr(1));
        case '0':
        case '1':
        case 'x':
        case 'X':
        case 'z':
        case 'Z':
            if (word.size() < 2)
                return refuse("A value without the code of its signal. Nothing more was decoded.", text_.location());
            return assign(word.substr(1), word.substr(0, 1));
        case 'b':
        case 'B':
        case 'r':
        case 'R':
        case 's':
        case 'S':
            return change_vector(std::string(word));
        case '$':
            if (word == "$end" || word.substr(0, 5) == "$dump") return {};
            return skip("a comment");
        default:
            return refuse(
                fmt::format("'{}' is neither a time nor a value. Nothing more was decoded.", word.substr(0, 40)),
                text_.location());
    }
}

/// Adds a sample at the last time, changed or not, to keep the length of the capture.
void VcdCapture::end() {
    ended_ = true;
    if (begun_ || changed_) sampler_.take(now_);
}

Result<bool> VcdCapture::next(SampleBlock& block) {
    std::string_view word;
    while (!ended_ && !sampler_.full()) {
        if (!text_.word(word)) {
            if (text_.error()) return tl::unexpected(ends_in("the values"));
            end();
            break;
        }
        const Result<void> done = change(word);
        if (done) continue;
        // An error in or after the very last word means that the file is truncated.
        if (text_.error() || !(text_.cut() || over_)) return tl::unexpected(done.error());
        cut_ = Error{ErrorKind::invalid_input,
                     "The file ends inside a value or time: it is cut off. The part before that was decoded.", name_,
                     text_.location()};
        end();
    }
    if (sampler_.waiting() == 0) return false;
    sampler_.hand_over(block, true);
    return true;
}

}  // namespace

Result<std::unique_ptr<Capture>> open_vcd(std::unique_ptr<Source> source, const std::string& name) {
    auto capture = std::make_unique<VcdCapture>(std::move(source), name);
    MOTIONRACK_CHECK(capture->read_head());
    return capture;
}

}  // namespace motionrack::decode
