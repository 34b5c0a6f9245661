// libFuzzer: any bytes as calls of rtc5sim.h, list commands and control commands in any order, on two cards of a rack
// or one by itself. A call that is refused has a sentence that begins with its name, tells it to the handler once, has
// its bits and puts nothing into a list; what comes out is within the field, and at the end the card goes where it is
// told.
#include <rtc5sim.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>
#include <string_view>
#include <tests/fuzz/drawn_call.hpp>
#include <tests/fuzz/scratch_file.hpp>
#include <vector>

namespace {

using motionrack::fuzz::Bytes;
using motionrack::fuzz::call_with_drawn;
using motionrack::fuzz::require;
using motionrack::fuzz::ScratchFile;

constexpr const char* rack_text = R"([card.a]
type = "rtc5"
list_memory = 2000
[card.b]
type = "rtc5"
list_memory = 2000
[belt.line]
card = "a"
speed_mm_s = 1
counts_per_mm = 100
[scanner.head]
card = "a"
part_on = "line"
)";

constexpr std::int32_t field = 524'288;

class Arguments {
  public:
    explicit Arguments(Bytes& bytes) : bytes_(bytes) {}

    std::uint32_t below(std::uint32_t n) { return bytes_.below(n); }
    UINT draw(std::type_identity<UINT>) {
        switch (below(8)) {
            case 0:
                return bytes_.word() << 16 | bytes_.word();
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
        if (below(8) == 0) return static_cast<std::int32_t>(bytes_.word() << 16 | bytes_.word());
        return static_cast<long>(bytes_.word()) * (below(2) == 0 ? 1 : 16) - 32'768;
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
    /// The address of enough numbers.
    ULONG_PTR draw(std::type_identity<ULONG_PTR>) {
        static std::vector<std::int32_t> numbers(1 << 21, 7);
        for (std::size_t i = 0; i < 8; ++i) numbers[i] = static_cast<std::int32_t>(below(48));
        return below(16) == 0 ? 0 : reinterpret_cast<ULONG_PTR>(numbers.data());
    }

  private:
    template <class Pointer>
    Pointer or_null(Pointer pointer) {
        return below(30) == 0 ? nullptr : pointer;
    }

    Bytes& bytes_;
    std::array<UINT, 4> words_{};
    std::array<long, 4> longs_{};
    std::size_t next_ = 0;
};

struct Function {
    const char* name;
    std::int64_t (*call)(Arguments&);
};

template <auto function>
constexpr Function named(const char* name) {
    return {name, [](Arguments& arguments) { return call_with_drawn(function, arguments); }};
}

/// On the selected card.
constexpr std::array functions = {named<load_program_file>("load_program_file"),
                                  named<load_correction_file>("load_correction_file"),
                                  named<select_cor_table>("select_cor_table"),
                                  named<get_table_para>("get_table_para"),
                                  named<get_head_para>("get_head_para"),
                                  named<load_fly_2d_table>("load_fly_2d_table"),
                                  named<config_list>("config_list"),
                                  named<set_start_list>("set_start_list"),
                                  named<set_start_list_1>("set_start_list_1"),
                                  named<set_start_list_2>("set_start_list_2"),
                                  named<set_start_list_pos>("set_start_list_pos"),
                                  named<load_list>("load_list"),
                                  named<load_sub>("load_sub"),
                                  named<get_input_pointer>("get_input_pointer"),
                                  named<get_list_space>("get_list_space"),
                                  named<execute_list>("execute_list"),
                                  named<execute_list_1>("execute_list_1"),
                                  named<execute_list_2>("execute_list_2"),
                                  named<execute_list_pos>("execute_list_pos"),
                                  named<execute_at_pointer>("execute_at_pointer"),
                                  named<auto_change>("auto_change"),
                                  named<start_loop>("start_loop"),
                                  named<quit_loop>("quit_loop"),
                                  named<pause_list>("pause_list"),
                                  named<restart_list>("restart_list"),
                                  named<stop_execution>("stop_execution"),
                                  named<get_status>("get_status"),
                                  named<read_status>("read_status"),
                                  named<goto_xy>("goto_xy"),
                                  named<set_jump_speed_ctrl>("set_jump_speed_ctrl"),
                                  named<set_mark_speed_ctrl>("set_mark_speed_ctrl"),
                                  named<set_delay_mode>("set_delay_mode"),
                                  named<set_matrix>("set_matrix"),
                                  named<set_offset>("set_offset"),
                                  named<set_angle>("set_angle"),
                                  named<set_scale>("set_scale"),
                                  named<set_hi>("set_hi"),
                                  named<set_control_mode>("set_control_mode"),
                                  named<write_io_port>("write_io_port"),
                                  named<get_io_status>("get_io_status"),
                                  named<simulate_encoder>("simulate_encoder"),
                                  named<get_encoder>("get_encoder"),
                                  named<read_encoder>("read_encoder"),
                                  named<set_rot_center>("set_rot_center"),
                                  named<set_fly_tracking_error>("set_fly_tracking_error"),
                                  named<init_fly_2d>("init_fly_2d"),
                                  named<get_fly_2d_offset>("get_fly_2d_offset"),
                                  named<set_encoder_speed_ctrl>("set_encoder_speed_ctrl"),
                                  named<set_ext_start_delay>("set_ext_start_delay"),
                                  named<set_extstartpos>("set_extstartpos"),
                                  named<simulate_ext_start_ctrl>("simulate_ext_start_ctrl"),
                                  named<simulate_ext_stop>("simulate_ext_stop"),
                                  named<get_marking_info>("get_marking_info"),
                                  named<get_startstop_info>("get_startstop_info"),
                                  named<mcbsp_init>("mcbsp_init"),
                                  named<mcbsp_init_spi>("mcbsp_init_spi"),
                                  named<set_mcbsp_freq>("set_mcbsp_freq"),
                                  named<get_mcbsp>("get_mcbsp"),
                                  named<read_mcbsp>("read_mcbsp"),
                                  named<read_multi_mcbsp>("read_multi_mcbsp"),
                                  named<set_mcbsp_in>("set_mcbsp_in"),
                                  named<set_multi_mcbsp_in>("set_multi_mcbsp_in"),
                                  named<set_mcbsp_x>("set_mcbsp_x"),
                                  named<set_mcbsp_y>("set_mcbsp_y"),
                                  named<set_mcbsp_rot>("set_mcbsp_rot"),
                                  named<set_mcbsp_matrix>("set_mcbsp_matrix"),
                                  named<apply_mcbsp>("apply_mcbsp"),
                                  named<set_mcbsp_out>("set_mcbsp_out"),
                                  named<set_mcbsp_out_ptr>("set_mcbsp_out_ptr"),
                                  named<get_value>("get_value"),
                                  named<measurement_status>("measurement_status"),
                                  named<get_waveform>("get_waveform"),
                                  named<stop_trigger>("stop_trigger"),
                                  named<enable_laser>("enable_laser"),
                                  named<disable_laser>("disable_laser"),
                                  named<set_laser_mode>("set_laser_mode"),
                                  named<set_laser_control>("set_laser_control"),
                                  named<set_standby>("set_standby"),
                                  named<set_laser_pulses_ctrl>("set_laser_pulses_ctrl"),
                                  named<set_firstpulse_killer>("set_firstpulse_killer"),
                                  named<set_qswitch_delay>("set_qswitch_delay"),
                                  named<set_laser_pulses>("set_laser_pulses"),
                                  named<set_laser_timing>("set_laser_timing"),
                                  named<set_firstpulse_killer_list>("set_firstpulse_killer_list"),
                                  named<set_qswitch_delay_list>("set_qswitch_delay_list"),
                                  named<jump_abs>("jump_abs"),
                                  named<jump_rel>("jump_rel"),
                                  named<mark_abs>("mark_abs"),
                                  named<mark_rel>("mark_rel"),
                                  named<arc_abs>("arc_abs"),
                                  named<arc_rel>("arc_rel"),
                                  named<timed_jump_abs>("timed_jump_abs"),
                                  named<timed_jump_rel>("timed_jump_rel"),
                                  named<timed_mark_abs>("timed_mark_abs"),
                                  named<timed_mark_rel>("timed_mark_rel"),
                                  named<micro_vector_abs>("micro_vector_abs"),
                                  named<micro_vector_rel>("micro_vector_rel"),
                                  named<set_end_of_list>("set_end_of_list"),
                                  named<list_nop>("list_nop"),
                                  named<long_delay>("long_delay"),
                                  named<set_jump_speed>("set_jump_speed"),
                                  named<set_mark_speed>("set_mark_speed"),
                                  named<set_scanner_delays>("set_scanner_delays"),
                                  named<set_laser_delays>("set_laser_delays"),
                                  named<laser_on_list>("laser_on_list"),
                                  named<laser_signal_on_list>("laser_signal_on_list"),
                                  named<laser_signal_off_list>("laser_signal_off_list"),
                                  named<write_io_port_list>("write_io_port_list"),
                                  named<set_wobbel>("set_wobbel"),
                                  named<list_call>("list_call"),
                                  named<sub_call>("sub_call"),
                                  named<list_return>("list_return"),
                                  named<set_fly_x>("set_fly_x"),
                                  named<set_fly_y>("set_fly_y"),
                                  named<set_fly_z>("set_fly_z"),
                                  named<set_fly_rot>("set_fly_rot"),
                                  named<set_fly_2d>("set_fly_2d"),
                                  named<activate_fly_xy>("activate_fly_xy"),
                                  named<activate_fly_2d>("activate_fly_2d"),
                                  named<set_fly_x_pos>("set_fly_x_pos"),
                                  named<set_fly_y_pos>("set_fly_y_pos"),
                                  named<set_fly_rot_pos>("set_fly_rot_pos"),
                                  named<fly_return>("fly_return"),
                                  named<fly_return_z>("fly_return_z"),
                                  named<set_rot_center_list>("set_rot_center_list"),
                                  named<park_position>("park_position"),
                                  named<park_return>("park_return"),
                                  named<set_mcbsp_in_list>("set_mcbsp_in_list"),
                                  named<set_multi_mcbsp_in_list>("set_multi_mcbsp_in_list"),
                                  named<store_encoder>("store_encoder"),
                                  named<wait_for_encoder>("wait_for_encoder"),
                                  named<wait_for_encoder_mode>("wait_for_encoder_mode"),
                                  named<wait_for_encoder_in_range>("wait_for_encoder_in_range"),
                                  named<wait_for_mcbsp>("wait_for_mcbsp"),
                                  named<set_fly_limits>("set_fly_limits"),
                                  named<set_fly_limits_z>("set_fly_limits_z"),
                                  named<if_fly_x_overflow>("if_fly_x_overflow"),
                                  named<if_fly_y_overflow>("if_fly_y_overflow"),
                                  named<if_fly_z_overflow>("if_fly_z_overflow"),
                                  named<if_not_fly_x_overflow>("if_not_fly_x_overflow"),
                                  named<if_not_fly_y_overflow>("if_not_fly_y_overflow"),
                                  named<if_not_fly_z_overflow>("if_not_fly_z_overflow"),
                                  named<clear_fly_overflow>("clear_fly_overflow"),
                                  named<set_ext_start_delay_list>("set_ext_start_delay_list"),
                                  named<simulate_ext_start>("simulate_ext_start"),
                                  named<set_control_mode_list>("set_control_mode_list"),
                                  named<set_encoder_speed>("set_encoder_speed"),
                                  named<get_mcbsp_list>("get_mcbsp_list"),
                                  named<set_mcbsp_x_list>("set_mcbsp_x_list"),
                                  named<set_mcbsp_y_list>("set_mcbsp_y_list"),
                                  named<set_mcbsp_rot_list>("set_mcbsp_rot_list"),
                                  named<set_mcbsp_matrix_list>("set_mcbsp_matrix_list"),
                                  named<apply_mcbsp_list>("apply_mcbsp_list"),
                                  named<set_trigger>("set_trigger"),
                                  named<set_trigger4>("set_trigger4"),
                                  named<set_matrix_list>("set_matrix_list"),
                                  named<set_offset_list>("set_offset_list"),
                                  named<set_angle_list>("set_angle_list"),
                                  named<set_scale_list>("set_scale_list")};

void advance(Arguments& arguments) {
    switch (arguments.below(4)) {
        case 0:
            rtc5sim_run(10 * arguments.below(2'000));
            break;
        case 1:
            rtc5sim_question_us(10 * arguments.below(30));
            break;
        case 2:
            rtc5sim_receive(1 + arguments.below(2), arguments.draw(std::type_identity<UINT>{}));
            break;
        default:
            rtc5sim_advance_us(10 * arguments.below(2'000));
    }
}

// ---- what comes out

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
        const Function& function = functions[arguments_.below(functions.size())];
        const UINT pointer = get_input_pointer(), space = get_list_space();
        told_.clear();
        rtc5sim_clear_error();
        rtc5sim_on_error(
            [](const char* sentence, void* to) { static_cast<std::vector<std::string>*>(to)->push_back(sentence); },
            &told_);
        function.call(arguments_);
        rtc5sim_on_error(nullptr, nullptr);
        const std::string error = rtc5sim_last_error();
        const UINT bits = get_last_error();
        if (error.empty())
            return require(told_.empty() && bits == 0, "a call that is taken tells no error", function.name);
        require(told_.size() == 1 && told_[0] == error, "an error is told to the handler once", error);
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
    std::vector<std::string> told_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    Caller caller(bytes);
    for (int i = 0; i < 300 && !bytes.empty(); ++i) caller.call();
    caller.end();
    return 0;
}
