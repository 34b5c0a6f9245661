// libFuzzer: any bytes to a Grbl port of a running machine. The first byte selects the machine; FFh advances 20 ms. The
// output is lines of ASCII; after a reset the machine stops, and an empty line is answered with ok.
#include <cstdint>
#include <memory>
#include <motionrack/grbl/grbl_session.hpp>
#include <string>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack;
using fuzz::require;

const rack::RackConfig& machine(bool homes) {
    const auto read = [](const std::string& switches) {
        std::string text = "[card.m]\ntype = \"mcx314\"\n";
        for (const std::string axis : {"X", "Y", "Z"})
            text += "[axis." + axis + "]\ncard = \"m\"\nchannel = \"" + static_cast<char>(axis[0] - 'A' + 'a') +
                    "\"\n" + (switches.empty() ? "" : "[axis." + axis + ".switches]\n" + switches);
        return *rack::read_rack_text(text).config;
    };
    static const rack::RackConfig plain = read(""), with_homes = read("home_mm = 1\nlimit_plus_mm = 302\n");
    return homes ? with_homes : plain;
}

class Played {
  public:
    Played(bool homes, std::string_view bytes) : bytes_(bytes) {
        operate::MachineSettings settings;
        settings.pace = [this](Instant now) { return play(now), true; };
        settings.on_status = [this](const operate::Status&) {
            if (session_) session_->tick();
        };
        machine_ = *operate::Machine::make(machine(homes), std::move(settings));
        session_ = std::make_unique<grbl::GrblSession>(*machine_, grbl::SessionSettings{});
    }
    void run() {
        machine_->run();
        require(stood_, "the machine stands after a reset");
        require(said_.ends_with("ok\r\n"), "an empty line is answered with ok", said_);
    }

  private:
    void play(Instant now) {
        if (!session_ || now < next_) return;
        if (!bytes_.empty()) {
            const std::size_t pause = bytes_.find('\xFF');
            session_->receive(bytes_.substr(0, pause));
            bytes_.remove_prefix(pause == std::string_view::npos ? bytes_.size() : pause + 1);
            next_ = now + milliseconds(20);
        } else {
            end(now);
        }
        said_ = session_->take_output().substr(0, 100'000);
        for (const char c : said_)
            require((c >= ' ' && c <= '~') || c == '\r' || c == '\n', "an answer is lines of ASCII", said_);
    }
    void end(Instant now) {
        switch (ending_++) {
            case 0:
                session_->receive("\x18");
                next_ = now + whole_seconds(3);
                break;
            case 1:
                place_ = machine_->status().axes[0].pulses;
                session_->receive("\x18\n");
                next_ = now + milliseconds(100);
                break;
            default:
                stood_ = machine_->status().axes[0].pulses == place_;
                session_->receive("\n");
                machine_->quit();
                next_ = never;
        }
    }

    std::string_view bytes_;
    std::unique_ptr<operate::Machine> machine_;
    std::unique_ptr<grbl::GrblSession> session_;
    std::string said_;
    Instant next_{};
    int ending_ = 0;
    std::int64_t place_ = 0;
    bool stood_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1 || size > 2000) return 0;
    Played((data[0] & 1) != 0, {reinterpret_cast<const char*>(data) + 1, size - 1}).run();
    return 0;
}
