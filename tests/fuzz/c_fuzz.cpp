// libFuzzer: any bytes as calls of motionrack/c.h and motionrack/flex2pos.h with valid and invalid arguments, including
// null pointers. Each call returns one of its codes. A failed call has a sentence and changes nothing: the state hash
// and the output value stay. The exception is a program or a homing that the machine stopped after motion. Read-only
// calls change nothing either; a copy of a rack equals the rack; callbacks do not advance time.
#include <motionrack/c.h>
#include <motionrack/flex2pos.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>
#include <tests/fuzz/c_arguments.hpp>
#include <tests/fuzz/scratch_file.hpp>

namespace {

using motionrack::fuzz::Bytes;
using motionrack::fuzz::require;
using motionrack::fuzz::ScratchFile;

using namespace motionrack::fuzz;

class Caller {
  public:
    explicit Caller(Bytes& bytes) : bytes_(bytes) {
        require(mr_rack_open(rack_text, &rack_) == MR_OK && rack_ != nullptr, "the rack is opened", mr_last_error());
        hash_ = mr_state_hash(rack_);
    }
    ~Caller() {
        flex2pos_close(flex_);
        mr_rack_close(rack_);
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    void call() {
        const std::uint64_t before = hash_, now = mr_now_ns(rack_);
        looks_ = drives_ = false;
        const int code = one();
        // A machine that cannot start them, because of an emergency stop, is accessed over the bus.
        const bool moved = drives_ && (code == MR_MACHINE || code == MR_STOPPED || code == MR_REFUSED);
        require(code == MR_OK || code == MR_BAD_CALL || code == MR_REFUSED || (code == MR_IO && is_file_) || moved ||
                    (code == MR_BAD_INPUT && drives_),
                "a call gives one of its codes", mr_last_error());
        require(mr_now_ns(rack_) >= now, "time does not go back");
        if (code != MR_OK) require(std::strlen(mr_last_error()) > 20, "an error has a sentence", mr_last_error());
        hash_ = mr_state_hash(rack_);
        if ((code == MR_OK && !looks_) || moved) return;
        require(hash_ == before, "a call that fails, or looks, changes nothing", mr_last_error());
        require(mr_now_ns(rack_) == now, "a call that fails, or looks, takes no time", mr_last_error());
    }

  private:
    // ---- arguments
    std::uint32_t below(std::uint32_t n) { return bytes_.below(n); }
    /// Returns the pointer, occasionally null.
    template <class Pointer>
    Pointer or_null(Pointer pointer) {
        return below(40) == 0 ? nullptr : pointer;
    }
    mr_rack* rack() { return or_null(rack_); }
    const char* card() { return or_null(cards[below(16) % cards.size()]); }
    double number() { return below(4) == 0 ? bytes_.word() / 16.0 - 1000 : numbers[below(numbers.size())]; }
    std::uint32_t offset() {
        switch (below(8)) {
            case 0:
                return bytes_.word() * 0x10001;
            case 1:
                return 0x2300 + below(0x40);
            case 2:
                return below(32);
            default:
                return 2 * below(8);
        }
    }
    /// A name, unchanged or with one letter replaced.
    const char* name() {
        std::string& text = texts_[next_++ % texts_.size()];
        text = names[below(names.size())];
        if (below(8) == 0) text[below(static_cast<std::uint32_t>(text.size()))] = static_cast<char>(1 + below(255));
        if (below(16) == 0) text.resize(below(static_cast<std::uint32_t>(text.size() + 1)));
        return or_null(text.c_str());
    }
    const char* path() {
        static const ScratchFile file("fuzz.vcd");
        static const std::string csv = file.beside("fuzz.csv"), nowhere = file.beside("no/such.vcd"),
                                 text = file.beside("fuzz.txt"), folder = file.beside("");
        static const std::string h5 = file.beside("fuzz.h5");
        const std::array<const char*, 9> all = {file.path().c_str(), csv.c_str(), nowhere.c_str(), text.c_str(),
                                                folder.c_str(),      "",          ".h5",           ".csv",
                                                h5.c_str()};
        return or_null(all[below(all.size())]);
    }

    // ---- calls
    // Draws arguments in sequence, because the order of evaluation inside a call depends on the compiler.
    int one() {
        is_file_ = false;
        mr_rack* const on = rack();
        const std::uint32_t what = below(18);
        if (what == 16) return control(on);
        if (what == 17) return list(on);
        if (what >= 12) return write(on);
        if (what == 11) return read(on);
        if (what == 10) return use_flex2pos(on);
        if (what == 9) return record(on);
        if (what == 8) return copy(on);
        if (what == 7) return peek(on);
        if (what < 2) return mr_advance_ns(on, below(8) == 0 ? max_ns + bytes_.word() : 30 * bytes_.word());
        const char* const of = name();
        if (what == 6) return look(&mr_part_get, on, of);
        if (what == 5) return look(&mr_wire_get, on, of);
        if (what == 4) return mr_fault(on, of, name());
        return what == 3 ? mr_part_set(on, of, number()) : mr_wire_set(on, of, number());
    }
    /// A callback during a run may read but must not advance time.
    static int progress(void* user, double seconds, std::int64_t, std::int64_t) {
        auto& own = *static_cast<Caller*>(user);
        require(seconds >= 0, "a program's time begins at 0");
        own.refused();
        return own.stops_;
    }
    static void happened(void* user, std::uint64_t number, std::int64_t, const char* card, int, const char* sentence) {
        auto& own = *static_cast<Caller*>(user);
        require(number > own.reported_, "conditions come in order, once");
        require(std::strlen(card) > 0 && std::strlen(sentence) > 0, "a condition has a sentence");
        own.reported_ = number;
        own.refused();
    }
    void refused() {
        mr_rack* copy = nullptr;
        require(mr_advance_ns(rack_, 1) == MR_REFUSED && mr_snapshot(rack_, &copy) == MR_REFUSED,
                "a call-back lets no time pass");
        mr_rack_close(rack_);  // no effect
    }
    int control(mr_rack* on) {
        if (motions_ == max_motions || below(2) == 0) {
            looks_ = true;
            return below(3) == 0 ? mr_on_condition(on, nullptr, nullptr) : mr_on_condition(on, &happened, this);
        }
        drives_ = is_file_ = true;
        ++motions_;
        if (below(3) == 0) return mr_home(on, or_null(homed[below(homed.size())]));
        std::string& text = texts_[next_++ % texts_.size()];
        text = programs[below(programs.size())];
        if (below(8) == 0 && !text.empty())
            text[below(static_cast<std::uint32_t>(text.size()))] = "XGM0;[#\n"[below(8)];
        mr_run_options options{below(8) == 0 ? "no/such.tbl" : nullptr, static_cast<int>(below(2)), &progress, this};
        stops_ = below(8) == 0 ? 1 : 0;
        mr_run_result result{};
        mr_run_options* const how = or_null(&options);
        const int code = mr_run_program(on, or_null(text.c_str()), how, or_null(&result));
        require(std::strlen(mr_report(rack_)) < 100'000, "what came of a program is a text");
        return code;
    }
    template <class One>
    static void counts(void* user, const One* one) {
        require(one->min <= one->max && one->meaning[0] != '\0', "what is listed has a range and a meaning");
        ++*static_cast<int*>(user);
    }
    int list(mr_rack* on) {
        looks_ = true;
        int lines = 0, code = MR_OK;
        const bool none = below(8) == 0;
        if (below(2) == 0)
            code = mr_quantities(on, none ? nullptr : &counts<mr_quantity>, &lines);
        else
            code = mr_faults(on, none ? nullptr : &counts<mr_fault_info>, &lines);
        require((code == MR_OK) == (lines > 0), "what a rack has is listed");
        return code;
    }
    int look(int (*function)(mr_rack*, const char*, double*), mr_rack* on, const char* of) {
        looks_ = true;
        double value = 123;
        const int code = function(on, of, or_null(&value));
        if (code != MR_OK) require(value == 123, "a call that fails leaves the value alone", mr_last_error());
        return code;
    }
    int peek(mr_rack* on) {
        looks_ = true;
        std::uint64_t value = 123;
        const char* const of = card();
        const char* const what = name();
        const int code = mr_peek(on, of, what, or_null(&value));
        if (code != MR_OK) require(value == 123, "a call that fails leaves the value alone", mr_last_error());
        return code;
    }
    template <class Word>
    int read_word(int (*function)(mr_rack*, const char*, std::uint32_t, Word*), mr_rack* on) {
        Word value = 123;
        const char* const of = card();
        const std::uint32_t at = offset();
        const int code = function(on, of, at, or_null(&value));
        if (code != MR_OK) require(value == 123, "a call that fails leaves the value alone", mr_last_error());
        return code;
    }
    int read(mr_rack* on) {
        const std::uint32_t width = below(4);
        if (width == 0) return read_word(&mr_read8, on);
        return width == 1 ? read_word(&mr_read32, on) : read_word(&mr_read16, on);
    }
    int write(mr_rack* on) {
        const std::uint32_t width = below(8);
        const char* const of = card();
        const std::uint32_t at = offset(), value = bytes_.word();
        if (width == 0) return mr_write32(on, of, at, value);
        return width < 4 ? mr_write8(on, of, at, static_cast<std::uint8_t>(value))
                         : mr_write16(on, of, at, static_cast<std::uint16_t>(value));
    }
    int copy(mr_rack* on) {
        looks_ = true;
        mr_rack* copy = rack_;
        const int code = mr_snapshot(on, or_null(&copy));
        if (code != MR_OK) {
            require(copy == nullptr || copy == rack_, "a copy that failed is none");
            return code;
        }
        require(mr_state_hash(copy) == mr_state_hash(rack_), "a copy is the same rack");
        require(mr_trace_stop(copy) == MR_REFUSED, "a recording stays with the first");
        if (!records_ && below(4) == 0) {
            const std::uint64_t ns = 20 * bytes_.word();
            require(mr_advance_ns(copy, ns) == MR_OK && mr_advance_ns(rack_, ns) == MR_OK, "time passes in both");
            require(mr_state_hash(copy) == mr_state_hash(rack_), "a copy goes the same way");
            looks_ = false;
        }
        mr_rack_close(copy);
        return code;
    }
    int record(mr_rack* on) {
        is_file_ = true;
        if (records_ && below(2) == 0) {
            const int code = mr_trace_stop(on);
            records_ = records_ && code != MR_OK;
            return code;
        }
        const char* signals = below(4) == 0 ? nullptr : patterns[below(patterns.size())];
        const int code = mr_trace_start(on, path(), signals);
        if (code == MR_OK) require(!records_, "one recording runs at a time");
        records_ = records_ || code == MR_OK;
        return code;
    }
    /// Makes an image, possibly damages it, checks and loads it.
    void use_image(flex2pos* flex) {
        std::array<std::uint8_t, 100> image{};
        std::size_t size = below(4) == 0 ? below(40) : image.size();
        const char* project = below(4) == 0 ? "stepper" : nullptr;
        const int code = flex2pos_image_make(project, static_cast<std::uint8_t>(below(3) == 0 ? bytes_.word() : 0x25),
                                             nullptr, 0, or_null(image.data()), or_null(&size));
        if (code != MR_OK) size = below(image.size());
        if (below(3) == 0) image[below(image.size())] ^= static_cast<std::uint8_t>(bytes_.word());
        const std::uint8_t* const given = or_null(image.data());
        const int expected = flex2pos_image_check(given, size), outcome = flex2pos_Configure(flex, given, size);
        require(given == nullptr || outcome == expected || outcome == Flex_ErrDevice,
                "a check of an image says what Configure comes to");
    }
    int use_flex2pos(mr_rack* on) {
        if (flex_ == nullptr) {
            looks_ = true;
            return flex2pos_open(on, or_null(&flex_));
        }
        flex2pos* const flex = or_null(flex_);
        const auto number = [&] { return static_cast<int>(below(8)) - 2; };
        std::int32_t time = 0, at[4] = {};
        int states[4] = {};
        switch (below(11)) {
            case 0:
                flex2pos_Init(flex, static_cast<std::uint16_t>(below(4) == 0 ? bytes_.word() : 0x2300));
                break;
            case 1:
                flex2pos_ReadPosition(flex, number());
                break;
            case 2: {
                std::int32_t* const to = or_null(&time);
                flex2pos_ReadTimeClrPosition(flex, to, below(4) == 0 ? nullptr : at);
                break;
            }
            case 3:
                flex2pos_WriteOutL(flex, static_cast<std::uint8_t>(bytes_.word()));
                break;
            case 4: {
                const int first = number(), second = number(), third = number();
                flex2pos_WriteCmd(flex, first, second, third, number());
                break;
            }
            case 5:
                flex2pos_ReadSts(flex, below(4) == 0 ? nullptr : states);
                break;
            case 6:
                flex2pos_ReadInH(flex);
                break;
            case 8: {
                const int axis = number();
                flex2pos_WriteCmdAxis(flex, axis, number());
                break;
            }
            case 9:
                use_image(flex);
                break;
            case 10:
                flex2pos_set_base_address(flex, static_cast<std::uint16_t>(below(4) == 0 ? bytes_.word() : 0x2300));
                break;
            default:
                flex2pos_GetIdent(flex);
        }
        require(flex2pos_why(flex) != nullptr, "why a call failed is a text");
        return MR_OK;
    }

    Bytes& bytes_;
    mr_rack* rack_ = nullptr;
    std::uint64_t hash_ = 0;  ///< hash of the rack state
    flex2pos* flex_ = nullptr;
    std::array<std::string, 4> texts_;
    std::size_t next_ = 0;
    bool looks_ = false;                   ///< read-only call
    bool is_file_ = false;                 ///< creates or closes a file
    bool drives_ = false;                  ///< program or homing
    static constexpr int max_motions = 4;  ///< of an input: each may take seconds under a sanitizer
    int motions_ = 0;                      ///< homings and programs so far
    int stops_ = 0;                        ///< return value of progress
    std::uint64_t reported_ = 0;           ///< number of the last reported condition
    bool records_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes({data, size});
    Caller caller(bytes);
    for (int i = 0; i < 100 && !bytes.empty(); ++i) caller.call();
    return 0;
}
