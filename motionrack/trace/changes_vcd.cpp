// Reads changes from a VCD file (IEEE 1364, clause 18).
#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/file_bytes.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t max_word = 1 << 16, max_signals = 1'000'000, max_depth = 1000;
constexpr std::size_t max_name = 1000;  ///< bytes including scopes; limits memory per signal

class VcdChanges final : public ChangeSource {
  public:
    VcdChanges(FileBytes bytes, SignalNames& names) : bytes_(std::move(bytes)), names_(names) {}

    Result<void> read_head();
    Result<bool> next(SignalChange& change) override;
    double part() const override { return bytes_.part(); }
    bool cut() const override { return cut_; }

  private:
    /// Reads the next word into word_; false at the end.
    bool word();
    Result<void> skip_to_end();
    Result<void> timescale();
    Result<void> variable(const std::string& scope);
    Result<void> time();
    Result<bool> changed(const std::string& code, std::string value, SignalChange& change);
    tl::unexpected<Error> refuse(const std::string& message) const {
        return fail(ErrorKind::invalid_input, message, {line_, 0}, bytes_.path());
    }

    FileBytes bytes_;
    SignalNames& names_;
    std::unordered_map<std::string, std::size_t> codes_;
    std::string word_;
    int line_ = 1;
    std::int64_t scale_ps_ = 0, at_ps_ = 0;
    bool cut_ = false;
};

bool VcdChanges::word() {
    word_.clear();
    int c = bytes_.get();
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        line_ += c == '\n';
        c = bytes_.get();
    }
    for (; c >= 0 && c != ' ' && c != '\t' && c != '\r' && c != '\n'; c = bytes_.get())
        if (word_.size() < max_word) word_ += static_cast<char>(c);
    line_ += c == '\n';
    cut_ = c < 0 && !word_.empty();
    return !word_.empty();
}

Result<void> VcdChanges::skip_to_end() {
    while (word())
        if (word_ == "$end") return {};
    return refuse("The file ends in its header.");
}

/// Reads the timescale: "100ps" or "100 ps".
Result<void> VcdChanges::timescale() {
    std::string text;
    while (word() && word_ != "$end") text += word_;
    struct Unit {
        std::string_view name;
        std::int64_t ps;
    };
    for (const Unit unit : {Unit{"ps", 1}, Unit{"ns", 1'000}, Unit{"us", 1'000'000}, Unit{"ms", 1'000'000'000},
                            Unit{"s", 1'000'000'000'000}}) {
        if (text == fmt::format("1{}", unit.name)) scale_ps_ = unit.ps;
        if (text == fmt::format("10{}", unit.name)) scale_ps_ = 10 * unit.ps;
        if (text == fmt::format("100{}", unit.name)) scale_ps_ = 100 * unit.ps;
    }
    return scale_ps_ > 0
               ? Result<void>()
               : Result<void>(refuse(fmt::format(
                     "'{}' is not a supported timescale: 1, 10 or 100 of ps, ns, us, ms or s.", text.substr(0, 40))));
}

/// Reads a declaration: $var wire 1 ! x_step $end
Result<void> VcdChanges::variable(const std::string& scope) {
    std::vector<std::string> words;
    while (word() && word_ != "$end" && words.size() < 8) words.push_back(word_);
    if (words.size() < 4 || codes_.size() >= max_signals)
        return refuse("A variable is declared by its type, width, code and name.");
    if (scope.size() + words[3].size() > max_name)
        return refuse(fmt::format("The name of a signal has more than {} bytes, its scopes included.", max_name));
    const std::size_t number = names_.number(scope + words[3]);
    codes_[words[2]] = number;
    declared_.push_back(number);
    return {};
}

Result<void> VcdChanges::read_head() {
    std::vector<std::string> scopes;
    while (word()) {
        if (word_ == "$enddefinitions") {
            MOTIONRACK_CHECK(skip_to_end());
            return scale_ps_ > 0 ? Result<void>() : Result<void>(refuse("The file's header has no timescale."));
        }
        if (word_ == "$timescale") {
            MOTIONRACK_CHECK(timescale());
        } else if (word_ == "$scope") {
            if (!word() || !word() || scopes.size() >= max_depth) return refuse("A scope has a type and a name.");
            const std::size_t around = scopes.empty() ? 0 : scopes.back().size();
            if (around + word_.size() >= max_name)
                return refuse(
                    fmt::format("The name of a scope has more than {} bytes, those around it included.", max_name));
            scopes.push_back((scopes.empty() ? "" : scopes.back()) + word_ + '.');
            MOTIONRACK_CHECK(skip_to_end());
        } else if (word_ == "$upscope") {
            if (scopes.empty()) return refuse("$upscope without an open scope.");
            scopes.pop_back();
            MOTIONRACK_CHECK(skip_to_end());
        } else if (word_ == "$var") {
            MOTIONRACK_CHECK(variable(scopes.empty() ? std::string() : scopes.back()));
        } else if (word_[0] == '$') {
            MOTIONRACK_CHECK(skip_to_end());
        } else {
            return refuse(fmt::format("'{}' is where the header of a VCD file must be.", word_.substr(0, 40)));
        }
    }
    MOTIONRACK_CHECK(bytes_.check());
    return refuse("The file ends in its header.");
}

Result<void> VcdChanges::time() {
    std::int64_t units = 0;
    const auto [end, bad] = std::from_chars(word_.data() + 1, word_.data() + word_.size(), units);
    if (bad != std::errc() || end != word_.data() + word_.size() || units < 0 ||
        units > std::numeric_limits<std::int64_t>::max() / scale_ps_)
        return refuse(fmt::format("'{}' is not a time.", word_.substr(0, 40)));
    if (units * scale_ps_ < at_ps_)
        return refuse("The time is earlier than the previous one. Nothing was compared; times must not decrease.");
    at_ps_ = units * scale_ps_;
    return {};
}

Result<bool> VcdChanges::changed(const std::string& code, std::string value, SignalChange& change) {
    const auto found = codes_.find(code);
    if (found == codes_.end()) {
        if (cut_) return false;
        return refuse(fmt::format("No variable has the code '{}'.", code.substr(0, 40)));
    }
    change.at_ps = at_ps_;
    change.signal = found->second;
    change.value = std::move(value);
    return true;
}

Result<bool> VcdChanges::next(SignalChange& change) {
    while (word()) {
        const char first = word_[0];
        if (first == '#') {
            if (cut_) return false;
            MOTIONRACK_CHECK(time());
        } else if (first == 'b' || first == 'B' || first == 'r' || first == 'R' || first == 's') {
            std::string value = word_.substr(1);
            if (first == 'b' || first == 'B')
                value.erase(0, std::min(value.find_first_not_of('0'), value.size() - (value.empty() ? 0 : 1)));
            if (!word()) return false;  // truncated between value and code
            return changed(word_, std::move(value), change);
        } else if (first == '$') {
            if (word_ == "$comment") MOTIONRACK_CHECK(skip_to_end());  // $dumpvars ... $end contains changes
        } else if (first == '0' || first == '1' || first == 'x' || first == 'X' || first == 'z' || first == 'Z') {
            return changed(word_.substr(1), std::string(1, first), change);
        } else {
            return refuse(fmt::format("'{}' is neither a time nor a change.", word_.substr(0, 40)));
        }
    }
    MOTIONRACK_CHECK(bytes_.check());
    return false;
}

}  // namespace

Result<std::unique_ptr<ChangeSource>> open_vcd_changes(const std::string& path, SignalNames& names) {
    MOTIONRACK_TRY(FileBytes bytes, FileBytes::open(path));
    auto out = std::make_unique<VcdChanges>(std::move(bytes), names);
    MOTIONRACK_CHECK(out->read_head());
    return out;
}

}  // namespace motionrack::trace
