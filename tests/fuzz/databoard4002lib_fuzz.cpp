// libFuzzer: any bytes as calls of databoard4002lib.h with valid and invalid arguments, on two cards of one bus. A
// rejected call has a sentence that begins with its name, returns -1 and stores no answer; where the sentence says that
// nothing was done, no time passes and neither card changes. An accepted call has no sentence. While a stop holds, no
// command is accepted and its card does not move.
#include <databoard4002lib.h>

#include <array>
#include <cstdint>
#include <limits>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>
#include <string_view>
#include <tests/fuzz/drawn_call.hpp>
#include <tests/fuzz/require.hpp>
#include <utility>

namespace {

using motionrack::fuzz::Bytes;
using motionrack::fuzz::call_with_drawn;
using motionrack::fuzz::require;

constexpr const char* rack_text = R"([card.c1]
type = "databoard4002"
[card.c2]
type = "databoard4002"
card_number = 7
)";
constexpr std::array card_numbers = {13, 7};
constexpr std::size_t no_card = card_numbers.size();  ///< index of a handle that is not open

constexpr int max_waits = 12;            ///< waiting calls per input
constexpr int not_stored = 0x5EED;       ///< value of an output argument before a call
constexpr std::int64_t stop_us = 1'000;  ///< until the card has executed Q

/// Arguments of a caller: the handle of a card, numbers in and out of range, null pointers.
class Arguments {
  public:
    explicit Arguments(Bytes& bytes) : bytes_(bytes) {}

    std::uint32_t below(std::uint32_t n) { return bytes_.below(n); }
    /// Begins a call, whose first number is the handle of a card.
    void begin(const std::array<int, card_numbers.size()>& handles) {
        handles_ = handles;
        card_ = no_card;
        handle_is_next_ = true;
        number_ = not_stored;
        value_ = not_stored;
    }
    /// Index of the card whose handle was drawn, or no_card.
    std::size_t card() const { return card_; }
    bool has_stored() const { return number_ != not_stored || value_ != not_stored; }

    int draw(std::type_identity<int>) {
        if (std::exchange(handle_is_next_, false)) return draw_handle();
        static constexpr std::array<int, 10> some = {1, 2, 4, 6, 100, 1000, 10'000, 15'984, 16'383, 0};
        static constexpr std::array<int, 8> far = {std::numeric_limits<int>::min(),
                                                   std::numeric_limits<int>::max(),
                                                   8'388'607,
                                                   8'388'608,
                                                   -8'388'608,
                                                   -8'388'609,
                                                   16'384,
                                                   -1};
        switch (below(4)) {
            case 0:
                return far[below(far.size())];
            case 1:
                return static_cast<int>(bytes_.word()) - 32'768;
            default:
                return some[below(some.size())];
        }
    }
    /// Draws a timeout of a call: short, or out of range.
    int milliseconds() {
        static constexpr std::array<int, 4> far = {0, -1, 600'001, std::numeric_limits<int>::min()};
        return below(8) == 0 ? far[below(far.size())] : 1 + static_cast<int>(below(60));
    }
    double draw(std::type_identity<double>) {
        static constexpr std::array<double, 5> some = {0, 1, 0.5, -1, std::numeric_limits<double>::quiet_NaN()};
        return some[below(some.size())];
    }
    const char* draw(std::type_identity<const char*>) {
        static constexpr std::array some = {"POSITION", "RATE",   "STAT",   "SELECT",  "NONE",    "",
                                            "c1.esr",   "c1.esl", "c1.ems", "c1.zero", "c2.ref",  "c2.ems",
                                            "c2.esr",   "c1.o1",  "c1.o2",  "c1.vout", "c1.none", "estop"};
        return or_null(some[below(some.size())]);
    }
    int* draw(std::type_identity<int*>) { return or_null(&number_); }
    std::int64_t* draw(std::type_identity<std::int64_t*>) { return or_null(&value_); }

  private:
    template <class Pointer>
    Pointer or_null(Pointer pointer) {
        return below(30) == 0 ? nullptr : pointer;
    }
    int draw_handle() {
        if (below(32) == 0) return static_cast<int>(below(3)) - 2;  // the handles begin with 1
        card_ = below(card_numbers.size());
        return handles_[card_];
    }

    Bytes& bytes_;
    std::array<int, card_numbers.size()> handles_{};
    std::size_t card_ = no_card;
    bool handle_is_next_ = false;
    int number_ = not_stored;
    std::int64_t value_ = not_stored;
};

enum class Kind {
    command,     ///< refused while a stop holds
    waits,       ///< a command that waits for the end of a move
    any,         ///< also while a stop holds
    time,        ///< advances the time
    stop,        ///< begins a stop
    reset_stop,  ///< ends it
    now,         ///< returns the time
};

struct Function {
    const char* name;
    Kind kind;
    std::int64_t (*call)(Arguments&);
};

template <auto function>
constexpr Function named(const char* name, Kind kind = Kind::command) {
    return {name, kind, [](Arguments& arguments) { return call_with_drawn(function, arguments); }};
}

int draw_number(Arguments& arguments) {
    return arguments.draw(std::type_identity<int>{});
}
std::int64_t move_to(Arguments& arguments) {
    const int card = draw_number(arguments), counts = draw_number(arguments);
    return databoard4002_move_to(card, counts, arguments.milliseconds());
}
std::int64_t move_by(Arguments& arguments) {
    const int card = draw_number(arguments), counts = draw_number(arguments);
    return databoard4002_move_by(card, counts, arguments.milliseconds());
}
std::int64_t find_zero(Arguments& arguments) {
    const int card = draw_number(arguments), marks = draw_number(arguments);
    const int last = draw_number(arguments), rate = draw_number(arguments);
    return databoard4002_find_zero(card, marks, last, rate, arguments.milliseconds());
}
std::int64_t advance(Arguments& arguments) {
    const int card = draw_number(arguments);
    return databoard4002_advance_ms(card, arguments.milliseconds());
}

constexpr std::array functions = {
    named<databoard4002_athome>("athome"),
    named<databoard4002_set_deviation>("set_deviation"),
    named<databoard4002_deviation>("deviation", Kind::any),
    named<databoard4002_go>("go"),
    named<databoard4002_initialise>("initialise"),
    named<databoard4002_lock>("lock"),
    named<databoard4002_manual>("manual"),
    named<databoard4002_set_number>("set_number"),
    named<databoard4002_on_regulation>("on_regulation"),
    named<databoard4002_set_target>("set_target"),
    named<databoard4002_position>("position", Kind::any),
    named<databoard4002_quit>("quit", Kind::any),
    named<databoard4002_set_rate>("set_rate"),
    named<databoard4002_rate>("rate", Kind::any),
    named<databoard4002_version>("version", Kind::any),
    named<databoard4002_clear_watch_out>("clear_watch_out"),
    named<databoard4002_status>("status", Kind::any),
    named<databoard4002_enable_events>("enable_events", Kind::any),
    named<databoard4002_disable_events>("disable_events", Kind::any),
    named<databoard4002_reset>("reset"),
    named<databoard4002_design_slope>("design_slope"),
    named<databoard4002_stop>("stop", Kind::stop),
    named<databoard4002_reset_stop>("reset_stop", Kind::reset_stop),
    named<databoard4002_now_us>("now_us", Kind::now),
    named<databoard4002_peek>("peek", Kind::any),
    named<databoard4002_set_wire>("set_wire", Kind::any),
    Function{"move_to", Kind::waits, move_to},
    Function{"move_by", Kind::waits, move_by},
    Function{"find_zero", Kind::waits, find_zero},
    Function{"advance_ms", Kind::time, advance},
};

std::int64_t peek(int handle, const char* name) {
    std::int64_t value = 0;
    require(databoard4002_peek(handle, name, &value) == 0, "a value of a card can be read", databoard4002_last_error());
    return value;
}

class Caller {
  public:
    explicit Caller(Bytes& bytes) : arguments_(bytes) {
        open(0, rack_text);
        open(1, nullptr);
    }
    ~Caller() {
        for (const int handle : handles_) databoard4002_close(handle);
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    void call() {
        if (arguments_.below(32) == 0) return reopen(arguments_.below(card_numbers.size()));
        const Function& function = functions[arguments_.below(functions.size())];
        const bool waits = function.kind == Kind::waits || function.kind == Kind::time;
        if (waits && ++waits_ > max_waits) return;
        const std::string before = cards();
        databoard4002_clear_error();
        arguments_.begin(handles_);
        const std::int64_t answer = function.call(arguments_);
        const std::string error = databoard4002_last_error();
        check(function, answer, error);
        if (error.find("Nothing was done.") != std::string::npos)
            require(cards() == before, "a call that does nothing changes neither card", error);
        note_stop(function.kind, answer);
        check_stops();
    }

  private:
    /// A stop of databoard4002_stop.
    struct Stop {
        bool holds = false;
        bool sent = false;  ///< the card has taken Q
        std::int64_t at_us = 0;
    };

    void open(std::size_t card, const char* place) {
        handles_[card] = databoard4002_open(place, card_numbers[card]);
        require(handles_[card] > 0, "a card that is not open can be opened", databoard4002_last_error());
        stops_[card] = {};
    }
    /// Closes a card and opens it again; the other card keeps the bus open, and the stop ends with the old handle.
    void reopen(std::size_t card) {
        const int old = handles_[card];
        require(databoard4002_open(nullptr, card_numbers[card]) == -1, "a card is not opened twice");
        require(databoard4002_close(old) == 0, "an open card can be closed", databoard4002_last_error());
        require(databoard4002_close(old) == -1, "a card is not closed twice");
        open(card, nullptr);
        require(handles_[card] != old, "a handle is not used again");
    }

    /// Returns the time and the readable state of both cards, which a rejected call must not change.
    std::string cards() const {
        std::string out = std::to_string(databoard4002_now_us(handles_[0]));
        for (const int handle : handles_)
            for (const char* name : {"POSITION", "RATE", "MOVING", "LOCKED", "EVENT", "STAT"})
                out += ' ' + std::to_string(peek(handle, name));
        return out;
    }

    void check(const Function& function, std::int64_t answer, const std::string& error) const {
        const bool stopped = arguments_.card() != no_card && stops_[arguments_.card()].holds;
        const bool is_command = function.kind == Kind::command || function.kind == Kind::waits;
        if (stopped && is_command) require(answer == -1, "a stop that holds refuses commands", function.name);
        if (error.empty()) {
            require(function.kind == Kind::now ? answer >= 0 : answer == 0, "a call that is taken answers no error",
                    function.name);
            require(arguments_.card() != no_card, "a handle that is not open is refused", function.name);
            return;
        }
        const std::string start = std::string("databoard4002_") + function.name + ": ";
        require(error.starts_with(start) && error.size() > start.size() + 20,
                "a sentence begins with the function's name", error);
        require(answer == -1, "a call that is refused answers -1", error);
        require(!arguments_.has_stored(), "a call that is refused stores no answer", error);
    }

    void note_stop(Kind kind, std::int64_t answer) {
        const std::size_t card = arguments_.card();
        if (card == no_card) return;
        if (kind == Kind::stop) stops_[card] = {true, answer == 0, databoard4002_now_us(handles_[card])};
        if (kind == Kind::reset_stop) stops_[card] = {};
    }
    void check_stops() const {
        for (std::size_t card = 0; card < card_numbers.size(); ++card) {
            const Stop& stop = stops_[card];
            if (!stop.holds || !stop.sent || databoard4002_now_us(handles_[card]) < stop.at_us + stop_us) continue;
            require(peek(handles_[card], "MOVING") == 0, "a card does not move while its stop holds");
            require(peek(handles_[card], "LOCKED") == 0, "a stop ends the lock");
        }
    }

    Arguments arguments_;
    std::array<int, card_numbers.size()> handles_{};
    std::array<Stop, card_numbers.size()> stops_{};
    int waits_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    Caller caller(bytes);
    for (int i = 0; i < 200 && !bytes.empty(); ++i) caller.call();
    return 0;
}
