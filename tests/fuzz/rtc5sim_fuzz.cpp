// libFuzzer: any bytes as calls of rtc5sim.h, list commands and control commands in any order, on two cards of a rack
// or on a stand-alone card. A rejected call has a sentence that begins with its name, passes it to the handler once,
// sets its error bits and appends nothing to a list. The output stays within the field, and at the end the card
// executes a position command.
#include <rtc5sim.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>
#include <string_view>
#include <tests/fuzz/rtc5sim_functions.hpp>
#include <tests/fuzz/scratch_file.hpp>
#include <vector>

namespace {

using motionrack::fuzz::Bytes;
using motionrack::fuzz::require;
using motionrack::fuzz::rtc5sim_functions;
using motionrack::fuzz::ScratchFile;

constexpr const char* rack_text = R"([card.a]
type = "rtc5"
list_memory = 2000
[card.b]
type = "rtc5"
list_memory = 2000
[belt.line]
card = "a"
velocity_mm_s = 1
counts_per_mm = 100
[scanner.head]
card = "a"
conveyor = "line"
)";

constexpr std::int32_t field = 524'288;

class Arguments {
  public:
    explicit Arguments(Bytes& bytes) : bytes_(bytes) {}

    std::uint32_t below(std::uint32_t n) { return bytes_.below(n); }
    UINT draw(std::type_identity<UINT>) {
        switch (below(8)) {
            case 0:
                return wide();
            case 1:
                return bytes_.word();
            case 2:
                return below(100);
            default:
                return below(5);
        }
    }
    long draw(std::type_identity<long>) {
        if (below(32) == 0) return below(2) == 0 ? std::numeric_limits<long>::min() : std::numeric_limits<long>::max();
        if (below(8) == 0) return static_cast<std::int32_t>(wide());
        const long value = static_cast<long>(bytes_.word()) - 32'768;
        return below(2) == 0 ? value : 16 * value;
    }
    double draw(std::type_identity<double>) {
        static constexpr std::array<double, 10> some = {0,
                                                        1,
                                                        0.5,
                                                        -1,
                                                        1e9,
                                                        -1e300,
                                                        360,
                                                        std::numeric_limits<double>::quiet_NaN(),
                                                        std::numeric_limits<double>::infinity(),
                                                        5e-324};
        return below(2) == 0 ? bytes_.word() / 16.0 - 100 : some[below(some.size())];
    }
    const char* draw(std::type_identity<const char*>) {
        static const ScratchFile table("table.txt");
        static const std::string nowhere = table.beside("nowhere.ct5"), folder = table.beside("");
        if (table.bytes().empty()) table.write("[Fly2DTable1]\n0 0 0 0\n10 0 1 1\n0 10 2 2\n10 10 3 3\n");
        switch (below(4)) {
            case 0:
                return table.path().c_str();
            case 1:
                return nowhere.c_str();
            case 2:
                return folder.c_str();
            default:
                return nullptr;
        }
    }
    UINT* draw(std::type_identity<UINT*>) { return or_null(&words_[next_++ % words_.size()]); }
    long* draw(std::type_identity<long*>) { return or_null(&longs_[next_++ % longs_.size()]); }
    /// Address of a sufficiently large array.
    ULONG_PTR draw(std::type_identity<ULONG_PTR>) {
        static std::vector<std::int32_t> numbers(1 << 21, 7);
        for (std::size_t i = 0; i < 8; ++i) numbers[i] = static_cast<std::int32_t>(below(48));
        return below(16) == 0 ? 0 : reinterpret_cast<ULONG_PTR>(numbers.data());
    }

  private:
    /// Draws 32 bits, the high word first with every compiler.
    UINT wide() {
        const UINT high = bytes_.word();
        return high << 16 | bytes_.word();
    }
    template <class Pointer>
    Pointer or_null(Pointer pointer) {
        return below(30) == 0 ? nullptr : pointer;
    }

    Bytes& bytes_;
    std::array<UINT, 4> words_{};
    std::array<long, 4> longs_{};
    std::size_t next_ = 0;
};

void advance(Arguments& arguments) {
    switch (arguments.below(4)) {
        case 0:
            rtc5sim_run(10 * arguments.below(2'000));
            break;
        case 1:
            rtc5sim_question_us(10 * arguments.below(30));
            break;
        case 2: {
            const UINT card = 1 + arguments.below(2);
            rtc5sim_receive(card, arguments.draw(std::type_identity<UINT>{}));
            break;
        }
        default:
            rtc5sim_advance_us(10 * arguments.below(2'000));
    }
}

// ---- output

std::int64_t next_tick[2] = {-1, -1};

void look(void*, UINT card, std::int64_t first, const std::int32_t* x, const std::int32_t* y, const std::uint8_t* laser,
          std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        require(x[i] >= -field && x[i] < field && y[i] >= -field && y[i] < field, "samples are within the field");
        require(laser[i] <= 20, "the laser is on for no more than a tick");
    }
    std::int64_t& next = next_tick[(card - 1) % 2];
    require(next < 0 || first == next, "ticks come one after the other");
    next = first + static_cast<std::int64_t>(n);
}

void check_output() {
    for (UINT card = 1; card <= rtc5_count_cards(); ++card) {
        std::int32_t x = 0, y = 0;
        int laser = 0;
        require(rtc5sim_output(card, &x, &y, &laser) == 0, "a card has an output", rtc5sim_last_error());
        require(x >= -field && x < field && y >= -field && y < field, "a card's output is within the field");
        require(laser == 0 || laser == 1, "the laser is on or off");
    }
}

// ---- calls

class Caller {
  public:
    explicit Caller(Bytes& bytes) : arguments_(bytes) {
        free_rtc5_dll();
        rtc5sim_on_error(nullptr, nullptr);
        rtc5sim_question_us(10);
        if (arguments_.below(8) != 0) require(rtc5sim_open(rack_text) == 0, "the rack is opened", rtc5sim_last_error());
        next_tick[0] = next_tick[1] = -1;
        if (arguments_.below(2) == 0) rtc5sim_on_samples(look, nullptr);
    }
    ~Caller() {
        rtc5sim_on_samples(nullptr, nullptr);
        free_rtc5_dll();
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    void call() {
        if (arguments_.below(12) == 0) return advance(arguments_);
        if (arguments_.below(24) == 0) select_rtc(arguments_.below(4));
        const auto& function = rtc5sim_functions<Arguments>[arguments_.below(rtc5sim_functions<Arguments>.size())];
        const UINT pointer = get_input_pointer(), space = get_list_space();
        reported_.clear();
        rtc5sim_clear_error();
        rtc5sim_on_error(
            [](const char* sentence, void* to) { static_cast<std::vector<std::string>*>(to)->push_back(sentence); },
            &reported_);
        function.call(arguments_);
        rtc5sim_on_error(nullptr, nullptr);
        const std::string error = rtc5sim_last_error();
        const UINT bits = get_last_error();
        if (error.empty())
            return require(reported_.empty() && bits == 0, "a call that is taken tells no error", function.name);
        require(reported_.size() == 1 && reported_[0] == error, "an error is told to the handler once", error);
        require(error.starts_with(std::string(function.name) + ": ") && error.size() > 20,
                "a sentence begins with the function's name", error);
        require(bits != 0 && (get_error() & bits) == bits, "an error has its bits", error);
        require(get_input_pointer() == pointer && get_list_space() == space, "what is refused is not put into a list",
                error);
    }
    void end() {
        check_output();
        rtc5sim_on_samples(nullptr, nullptr);
        for (UINT card = rtc5_count_cards(); card >= 1; --card) {
            require(select_rtc(card) == card, "a card is selected", rtc5sim_last_error());
            load_program_file(nullptr);
        }
        goto_xy(1234, -77);
        require(rtc5sim_run(100'000'000) == 1, "a card that was reset comes to rest", rtc5sim_last_error());
        std::int32_t x = 0, y = 0;
        rtc5sim_output(1, &x, &y, nullptr);
        require(x == 1234 && y == -77, "a card that was reset goes where it is told");
    }

  private:
    Arguments arguments_;
    std::vector<std::string> reported_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    Caller caller(bytes);
    for (int i = 0; i < 300 && !bytes.empty(); ++i) caller.call();
    caller.end();
    return 0;
}
