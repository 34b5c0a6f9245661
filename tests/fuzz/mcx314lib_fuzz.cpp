// libFuzzer: any bytes as calls of mcx314lib.h with valid and invalid arguments. A rejected call has a sentence that
// begins with its name, passes it to the handler once, returns -1 and writes no register. An accepted call has no
// sentence.
#include <mcx314lib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>
#include <string_view>
#include <tests/fuzz/drawn_call.hpp>
#include <tests/fuzz/require.hpp>
#include <vector>

namespace {

using motionrack::fuzz::Bytes;
using motionrack::fuzz::call_with_drawn;
using motionrack::fuzz::require;

constexpr const char* rack_text = R"([card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
initial_position_mm = 5
switches.home_mm = 1
switches.limit_plus_mm = 301
[axis.Y]
card = "c1"
channel = "y"
initial_position_mm = 5
switches.home_mm = 1
[axis.Z]
card = "c1"
channel = "z"
initial_position_mm = 5
switches.home_mm = 1
[axis.A]
card = "c1"
channel = "u"
initial_position_deg = 5
switches.home_deg = 1
[card.c2]
type = "mcx314"
)";

constexpr int max_waits = 6;  ///< waiting calls per input: each waits up to a minute of simulated time

/// Arguments of a caller: numbers in and out of range, structures, null pointers.
class Arguments {
  public:
    explicit Arguments(Bytes& bytes) : bytes_(bytes) {}

    std::uint32_t below(std::uint32_t n) { return bytes_.below(n); }
    int draw(std::type_identity<int>) {
        static constexpr std::array<int, 14> some = {1,    5,     100,   400,     1000,      4000, 8000,
                                                     8001, 16000, 65535, 800'000, 8'000'000, 0,    -1};
        static constexpr std::array<int, 6> far = {
            std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), 8'388'608, -268'435'456, 500, 65'536};
        switch (below(8)) {
            case 0:
                return far[below(far.size())];
            case 1:
                return static_cast<int>(bytes_.word()) - 32'768;
            case 2:
            case 3:
                return 1 << below(4);
            case 4:
                return static_cast<int>(below(16));
            default:
                return some[below(some.size())];
        }
    }
    unsigned draw(std::type_identity<unsigned>) { return static_cast<unsigned>(draw(std::type_identity<int>{})); }
    double draw(std::type_identity<double>) {
        static constexpr std::array<double, 5> some = {0, 1, 0.5, -1, std::numeric_limits<double>::quiet_NaN()};
        return some[below(some.size())];
    }
    const char* draw(std::type_identity<const char*>) {
        static constexpr std::array some = {"RR0",    "x.LP",    "y.WR2",   "LP",    "",       "c1.xlmtp",
                                            "X.home", "c1.xin1", "c1.emgn", "estop", "c1.xpp", "Z.enc_z"};
        return or_null(some[below(some.size())]);
    }
    std::int64_t* draw(std::type_identity<std::int64_t*>) { return or_null(&value_); }
    const int* draw(std::type_identity<const int*>) {
        std::array<int, 4>& point = points_[next_++ % points_.size()];
        for (int& value : point) value = place();
        return or_null(point.data());
    }
    LINEDATA* draw(std::type_identity<LINEDATA*>) {
        line_ = {speed(), speed(), speed(), speed(), speed(), {place(), place(), place(), place()}};
        return or_null(&line_);
    }
    CIRCLEDATA* draw(std::type_identity<CIRCLEDATA*>) {
        circle_ = {speed(), speed(), speed(), speed(), {place(), place(), place(), place()}, {place(), place(), 0, 0}};
        return or_null(&circle_);
    }
    const MCX314_CONTOUR* draw(std::type_identity<const MCX314_CONTOUR*>) {
        contour_ = {quick(), quick(), below(2) == 0 ? 0 : quick(), quick()};
        return or_null(&contour_);
    }
    const MCX314_PATTERN* draw(std::type_identity<const MCX314_PATTERN*>) {
        pattern_ = {quick(), quick(), below(2) == 0 ? 0 : quick(), place()};
        return or_null(&pattern_);
    }
    MCX314_PLAN* draw(std::type_identity<MCX314_PLAN*>) { return or_null(&plan_); }
    const MCX314_STEPS* draw(std::type_identity<const MCX314_STEPS*>) {
        for (unsigned& word : steps_.plus) word = bytes_.word() << (below(32) == 0 ? 4 : 0);
        for (unsigned& word : steps_.minus) word = bytes_.word();
        return or_null(&steps_);
    }

  private:
    template <class Pointer>
    Pointer or_null(Pointer pointer) {
        return below(30) == 0 ? nullptr : pointer;
    }
    int speed() { return below(16) == 0 ? draw(std::type_identity<int>{}) : 1 + static_cast<int>(below(4000)); }
    /// Draws a speed for calls that wait for the end of a move.
    int quick() { return 500 + static_cast<int>(below(8000)); }
    int place() { return below(32) == 0 ? draw(std::type_identity<int>{}) : static_cast<int>(below(2000)) - 1000; }

    Bytes& bytes_;
    std::int64_t value_ = 0;
    std::array<std::array<int, 4>, 4> points_{};
    std::size_t next_ = 0;
    LINEDATA line_{};
    CIRCLEDATA circle_{};
    MCX314_CONTOUR contour_{};
    MCX314_PATTERN pattern_{};
    MCX314_STEPS steps_{};
    MCX314_PLAN plan_{};
};

enum class Kind {
    source,  ///< name of the source: returns nothing
    reads,   ///< returns 0 if rejected
    own,     ///< returns -1
    waits,   ///< advances time, or continues by itself
};

struct Function {
    const char* name;
    Kind kind;
    std::int64_t (*call)(Arguments&);
};

template <auto function>
constexpr Function named(const char* name, Kind kind = Kind::source) {
    return {name, kind, [](Arguments& arguments) { return call_with_drawn(function, arguments); }};
}

/// Homing waits for its end and may take long: calls it with one invalid number, so that it is rejected.
template <void (*home)(int, int, int, int)>
constexpr Function homing(const char* name) {
    return {name, Kind::source, [](Arguments& arguments) -> std::int64_t {
                std::array<int, 4> numbers = {0x10, 100, 4000, 400};  // WR1, SV, V, A
                static constexpr std::array<int, 4> wrong = {0x10000, 0, -1, 8001};
                numbers[arguments.below(4)] = wrong[arguments.below(4)] | 0x10000;
                home(numbers[0], numbers[1], numbers[2], numbers[3]);
                return 0;
            }};
}

std::int64_t wait(Arguments& arguments) {
    const int axis = arguments.draw(std::type_identity<int>{});
    return mcx314_wait(axis, static_cast<int>(arguments.below(60)) - 5);
}
std::int64_t advance(Arguments& arguments) {
    return mcx314_advance_ms(static_cast<int>(arguments.below(60)) - 5);
}
constexpr std::array functions = {
    named<SetPulseMode>("SetPulseMode"),
    named<SetMultiple>("SetMultiple"),
    named<SetRange>("SetRange"),
    named<SetMaxSpeed>("SetMaxSpeed"),
    named<SetSV>("SetSV"),
    named<SetV>("SetV"),
    named<SetA>("SetA"),
    named<SetD>("SetD"),
    named<SetAA>("SetAA"),
    named<SetAO>("SetAO"),
    named<Pulse>("Pulse"),
    named<AutoDec>("AutoDec"),
    named<ManualDec>("ManualDec"),
    named<ManDec>("ManDec"),
    named<TCurve_F>("TCurve_F"),
    named<SCurve_F>("SCurve_F"),
    named<TCurve_C>("TCurve_C"),
    named<SCurve_C>("SCurve_C"),
    named<Line2D_C>("Line2D_C"),
    named<Line3D_C>("Line3D_C"),
    named<Line2D_T>("Line2D_T"),
    named<Line3D_T>("Line3D_T"),
    named<Line2D_S>("Line2D_S"),
    named<Line3D_S>("Line3D_S"),
    named<CircleCW_C>("CircleCW_C"),
    named<CircleCCW_C>("CircleCCW_C"),
    named<CircleCW_T>("CircleCW_T"),
    named<CircleCCW_T>("CircleCCW_T"),
    named<SetCP>("SetCP"),
    named<SetC>("SetC"),
    named<SetFP>("SetFP"),
    named<SetP>("SetP"),
    named<HLMTP>("HLMTP"),
    named<HLMTM>("HLMTM"),
    named<HLMTSig>("HLMTSig"),
    named<SLMTP>("SLMTP"),
    named<SLMTM>("SLMTM"),
    named<SLMTSig>("SLMTSig"),
    named<EncoderMode>("EncoderMode"),
    named<EncoderCWCCW>("EncoderCWCCW"),
    named<EnableALM>("EnableALM"),
    named<EnableInPos>("EnableInPos"),
    named<ALMSig>("ALMSig"),
    named<InPosSig>("InPosSig"),
    named<LPS>("LPS"),
    named<EPS>("EPS"),
    named<SetCompP>("SetCompP"),
    named<SetCompM>("SetCompM"),
    named<RESET>("RESET"),
    named<ReadLPS>("ReadLPS", Kind::reads),
    named<ReadEPS>("ReadEPS", Kind::reads),
    named<ReadCV>("ReadCV", Kind::reads),
    named<ReadCA>("ReadCA", Kind::reads),
    named<mcx314_plan>("mcx314_plan", Kind::own),
    named<mcx314_home_axes>("mcx314_home_axes", Kind::own),
    named<mcx314_moving>("mcx314_moving", Kind::own),
    named<mcx314_at_limit>("mcx314_at_limit", Kind::own),
    named<mcx314_report>("mcx314_report"),
    named<mcx314_stop>("mcx314_stop", Kind::own),
    named<mcx314_stop_now>("mcx314_stop_now", Kind::own),
    named<mcx314_asymmetric>("mcx314_asymmetric", Kind::own),
    named<mcx314_set_output>("mcx314_set_output", Kind::own),
    named<mcx314_enable_interrupt>("mcx314_enable_interrupt", Kind::own),
    named<mcx314_disable_interrupt>("mcx314_disable_interrupt", Kind::own),
    named<mcx314_read_interrupt>("mcx314_read_interrupt", Kind::own),
    named<mcx314_peek>("mcx314_peek", Kind::own),
    named<mcx314_set_wire>("mcx314_set_wire", Kind::own),
    named<mcx314_jog>("mcx314_jog", Kind::waits),
    named<mcx314_jog_step>("mcx314_jog_step", Kind::waits),
    named<mcx314_jog_home>("mcx314_jog_home", Kind::waits),
    named<mcx314_contour_begin>("mcx314_contour_begin", Kind::own),
    named<mcx314_contour_line>("mcx314_contour_line", Kind::waits),
    named<mcx314_contour_arc>("mcx314_contour_arc", Kind::waits),
    named<mcx314_contour_end>("mcx314_contour_end", Kind::waits),
    named<mcx314_pattern_begin>("mcx314_pattern_begin", Kind::own),
    named<mcx314_pattern_steps>("mcx314_pattern_steps", Kind::waits),
    named<mcx314_pattern_start>("mcx314_pattern_start", Kind::waits),
    named<mcx314_pattern_end>("mcx314_pattern_end", Kind::waits),
    homing<HomeType1>("HomeType1"),
    homing<HomeType2>("HomeType2"),
    homing<HomeType3>("HomeType3"),
    homing<HomeType4>("HomeType4"),
    Function{"mcx314_wait", Kind::waits, wait},
    Function{"mcx314_advance_ms", Kind::waits, advance},
};

/// Values of write-only registers; "" for a closed chip.
std::string registers() {
    std::string out;
    for (const char* axis : {"x.", "y.", "z.", "u."})
        for (const char* name :
             {"R", "SV", "V", "A", "D", "K", "P", "DP", "AO", "COMP_PLUS", "COMP_MINUS", "WR1", "WR2", "WR3"}) {
            std::int64_t value = 0;
            if (mcx314_peek((std::string(axis) + name).c_str(), &value) == 0) out += std::to_string(value) + ' ';
        }
    return out;
}

class Caller {
  public:
    explicit Caller(Bytes& bytes) : arguments_(bytes) {
        mcx314_on_error(nullptr, nullptr);
        chips_[0] = mcx314_open(rack_text, "c1");
        chips_[1] = mcx314_open(nullptr, "c2");
        require(chips_[0] > 0 && chips_[1] > 0, "two chips are opened", mcx314_last_error());
        select(0);
    }
    ~Caller() {
        mcx314_on_error(nullptr, nullptr);
        for (const int chip : chips_) mcx314_close(chip);
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    void call() {
        if (arguments_.below(16) == 0) select(arguments_.below(2));
        const Function& function = functions[arguments_.below(functions.size())];
        if (function.kind == Kind::waits && ++waits_ > max_waits) return;
        // An operation that continues by itself may write at any time.
        by_itself_ = by_itself_ || function.kind == Kind::waits;
        const std::string before = by_itself_ ? "" : registers();
        reported_.clear();
        mcx314_clear_error();
        mcx314_on_error(
            [](const char* sentence, void* to) { static_cast<std::vector<std::string>*>(to)->push_back(sentence); },
            &reported_);
        const std::int64_t answer = function.call(arguments_);
        const std::string error = mcx314_last_error();
        mcx314_on_error(nullptr, nullptr);
        check(function, answer, error);
        if (!error.empty() && !by_itself_)
            require(registers() == before, "a call that is refused writes no register", error);
    }

  private:
    void select(std::size_t chip) {
        require(mcx314_select(chips_[chip]) == 0, "a chip that is open can be selected", mcx314_last_error());
    }
    void check(const Function& function, std::int64_t answer, const std::string& error) const {
        if (error.empty()) {
            require(reported_.empty(), "a call that is taken tells no error", function.name);
            require(function.kind != Kind::own || answer >= 0, "a call that is taken answers no error", function.name);
            return;
        }
        require(reported_.size() == 1 && reported_[0] == error, "an error is told to the handler once", error);
        require(error.starts_with(std::string(function.name) + ": ") && error.size() > 30,
                "a sentence begins with the function's name", error);
        const bool is_own = std::string_view(function.name).starts_with("mcx314_");
        if (is_own && function.kind != Kind::source) require(answer == -1, "a call that is refused answers -1", error);
        if (function.kind == Kind::reads) require(answer == 0, "a position that is not read is 0", error);
    }

    Arguments arguments_;
    std::array<int, 2> chips_{};
    std::vector<std::string> reported_;
    int waits_ = 0;
    bool by_itself_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    Caller caller(bytes);
    for (int i = 0; i < 200 && !bytes.empty(); ++i) caller.call();
    return 0;
}
