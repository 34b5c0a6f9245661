#include "terminal.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace old_host {

namespace {

void must(int code) {
    if (code != MR_OK) throw Failure(mr_last_error());
}

double seconds(std::uint64_t ns) {
    return static_cast<double>(ns) * 1e-9;
}

/// A time of the command line, 0 .. 1e6 s.
std::uint64_t ns_of(const std::string& word, const std::string& usage) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != 0 || !(value >= 0 && value <= 1e6))
        throw Failure("The time '" + word + "' must be 0 to 1000000 s. Nothing was run.\n" + usage);
    return static_cast<std::uint64_t>(value * 1e9);
}

}  // namespace

// ---- the command line

Request request_of(const std::vector<std::string>& words, const std::string& usage) {
    if (words.empty() || words.size() == 3 || words.size() == 4 || words.size() > 5)
        throw Failure("The number of arguments is wrong. Nothing was run.\n" + usage);
    Request out;
    out.program = words[0];
    if (words.size() > 1) {
        out.rounds = std::atoi(words[1].c_str());
        if (out.rounds < 1 || out.rounds > 100)
            throw Failure("ROUNDS is '" + words[1] + "'; it must be 1 to 100. Nothing was run.\n" + usage);
    }
    if (words.size() == 5) {
        out.press = Press{words[2], ns_of(words[3], usage), ns_of(words[4], usage)};
        if (out.press->until_ns <= out.press->from_ns)
            throw Failure("The switch is released at " + words[4] + " s, which must be after " + words[3] +
                          " s. Nothing was run.");
    }
    return out;
}

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    if (!file || text.str().empty())
        throw Failure(path + " could not be read, or is empty. Nothing was run. Give the path of the listing.");
    return text.str();
}

// ---- the machine

Machine::Machine(std::uint64_t bus_access_ns, std::optional<Press> press) : press_(std::move(press)) {
    const std::string rack =
        "[card.c1]\ntype = \"databoard4002\"\nbus_access_ns = " + std::to_string(bus_access_ns) + "\n";
    must(mr_rack_open(rack.c_str(), &rack_));
    double level = 0;
    if (press_ && mr_wire_get(rack_, press_->wire.c_str(), &level) != MR_OK) {
        const std::string why = mr_last_error();
        mr_rack_close(rack_);
        throw Failure(why);
    }
}

std::uint8_t Machine::in(std::uint32_t port) {
    std::uint8_t value = 0;
    must(mr_read8(rack_, "c1", port, &value));
    return value;
}

void Machine::out(std::uint32_t port, std::uint8_t value) {
    must(mr_write8(rack_, "c1", port, value));
}

double Machine::counts() const {
    double value = 0;
    must(mr_part_get(rack_, "c1.position_counts", &value));
    return value;
}

void Machine::set_wire(double level) {
    must(mr_wire_set(rack_, press_->wire.c_str(), level));
    std::printf("%11.3f s         %s is %s\n", seconds(now_ns()), press_->wire.c_str(),
                level > 0 ? "pressed" : "released");
}

void Machine::pass_to(std::uint64_t ns) {
    if (ns > max_wait_ns_)
        throw Failure("The program has put nothing on its screen for 1000 s. It was ended after " +
                      std::to_string(max_wait_ns_ / 1'000'000'000) + " s; check the card's STAT.");
    while (press_ && press_->from_ns <= ns) {
        if (press_->from_ns > now_ns()) must(mr_advance_ns(rack_, press_->from_ns - now_ns()));
        set_wire(press_->until_ns > press_->from_ns ? 1 : 0);
        if (press_->from_ns == press_->until_ns)
            press_.reset();
        else
            press_->from_ns = press_->until_ns;
    }
    const std::uint64_t now = now_ns();
    if (ns > now) must(mr_advance_ns(rack_, ns - now));
}

// ---- the terminal

void Terminal::list(const std::string& what) {
    std::printf("%11.3f s  %s\n", seconds(machine_.now_ns()), what.c_str());
    machine_.seen();
}

void Terminal::put(std::uint8_t byte) {
    if (escape_ > 0) {
        if (escape_ == 2) row_ = byte - 32;
        if (escape_ == 1) column_ = byte - 32;
        --escape_;
        return;
    }
    if (byte >= 32 && byte < 127) {
        if (text_.empty()) text_column_ = column_;
        text_ += static_cast<char>(byte);
        ++column_;
        return;
    }
    if (byte == 7) {
        bell_ = true;
        return;
    }
    end_text();
    if (byte == 27) escape_ = 3;
    if (byte == 10) ++row_;
    if (byte == 13) column_ = 0;
    if (byte == 26) {
        row_ = column_ = 0;
        list("       the screen is cleared");
    }
}

void Terminal::end_text() {
    if (text_.find_first_not_of(' ') != std::string::npos) {
        char line[200];
        std::snprintf(line, sizeof line, "%2d,%2d  %-34s%8.0f counts%s", row_, text_column_, text_.c_str(),
                      machine_.counts(), bell_ ? "  (bell)" : "");
        list(line);
    }
    text_.clear();
    bell_ = false;
}

bool Terminal::key() {
    stood_.push_back(machine_.counts());
    machine_.seen();
    machine_.pass(3'000'000'000);
    if (stood_.size() == 3) {
        std::printf("Round %d: the axis stood at %.0f, %.0f and %.0f counts.\n", round_, stood_[0], stood_[1],
                    stood_[2]);
        stood_.clear();
        over_ = ++round_ > rounds_;
    }
    return !over_;
}

}  // namespace old_host
