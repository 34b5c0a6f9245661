// Commands of rtc5sim.h that return values, read files or check parameters.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::ErrorKind;
using motionrack::fail;
using motionrack::Result;
namespace rtc5 = motionrack::rtc5;

namespace {

/// Return values of the functions that load a file.
enum FileAnswer : UINT { loaded = 0, damaged = 1, not_read = 3, wrong_parameter = 10, no_such_card = 11 };

constexpr std::size_t max_table_bytes = 64u << 20;

/// Reads at most `limit` bytes, and one more if the file is longer.
Result<std::string> bytes_of(const char* name, std::size_t limit) {
    std::ifstream file(name, std::ios::binary);
    std::string out;
    std::array<char, 65536> piece;
    while (file && out.size() <= limit) {
        file.read(piece.data(), static_cast<std::streamsize>(std::min(piece.size(), limit + 1 - out.size())));
        out.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (file.eof() || out.size() > limit) return out;
    return fail(ErrorKind::io, fmt::format("{} cannot be read. Nothing was loaded; is the name right?", name));
}

Result<void> check_range(std::string_view what, UINT value, UINT min, UINT max) {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::refused,
                fmt::format("{} is {}; it must be {} to {}; nothing was done", what, value, min, max));
}

Result<void> load_correction(Card& card, const char* name, UINT number, UINT dim, UINT& answer) {
    answer = wrong_parameter;
    MOTIONRACK_CHECK(check_range("No", number, 1, rtc5::table_count));
    MOTIONRACK_CHECK(check_range("Dim", dim, 2, 3));
    std::shared_ptr<const rtc5::Table> table;
    if (name != nullptr) {
        answer = not_read;
        MOTIONRACK_TRY(const std::string bytes, bytes_of(name, rtc5::ct5_bytes));
        answer = damaged;
        const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
        MOTIONRACK_TRY(const rtc5::CorrectionFile file, rtc5::read_ct5({begin, bytes.size()}, name));
        table = rtc5::table_of(file);
    }
    MOTIONRACK_CHECK(card.engine.parts().heads.load_table(std::move(table), small(number)));
    answer = loaded;
    return {};
}

Result<void> load_fly_table(Card& card, const char* name, UINT number, UINT& answer) {
    if (name == nullptr) {
        card.engine.parts().fly.load_table(nullptr);
    } else {
        answer = not_read;
        MOTIONRACK_TRY(const std::string text, bytes_of(name, max_table_bytes));
        answer = damaged;
        MOTIONRACK_TRY(rtc5::FlyTable table, rtc5::FlyTable::read(text, number, name));
        card.engine.parts().fly.load_table(std::make_shared<const rtc5::FlyTable>(std::move(table)));
    }
    answer = loaded;
    return {};
}

/// Returns word `para` of the head of table `number`; 0 for a 1:1 table.
Result<double> header_word(const Card& card, std::int64_t number, UINT para) {
    MOTIONRACK_CHECK(check_range("ParaNo", para, 0, 15));
    const rtc5::Table* const table = card.engine.parts().heads.table(number);
    return table == nullptr ? 0.0 : table->header[para];
}

/// Answers a query with two values.
template <class Number, class Call>
void ask_two(std::string_view who, UINT number, Number* a, Number* b, Call call) noexcept {
    question(who, number, false, [&](Card& card) -> Result<bool> {
        MOTIONRACK_CHECK(check_pointer(a, "The first address of the answer"));
        MOTIONRACK_CHECK(check_pointer(b, "The second address of the answer"));
        call(card);
        return true;
    });
}

}  // namespace

// ---- Cards

UINT init_rtc5_dll() {
    return with_bench(__func__, UINT{RTC5_NO_CARD}, [](CardTable& bench) -> Result<UINT> {
        MOTIONRACK_CHECK(bench.count());
        return 0u;
    });
}
UINT rtc5_count_cards() {
    return with_bench(__func__, 0u, [](CardTable& bench) { return bench.count(); });
}
UINT select_rtc(UINT CardNo) {
    return with_bench(__func__, 0u, [&](CardTable& bench) -> Result<UINT> {
        MOTIONRACK_CHECK(bench.select(CardNo));
        return CardNo;
    });
}
void free_rtc5_dll() {
    with_bench(__func__, false, [](CardTable& bench) -> Result<bool> {
        bench.close();
        return true;
    });
}

// ---- Files and tables

UINT n_load_program_file(UINT CardNo, const char*) {
    return with_card(__func__, CardNo, UINT{no_such_card}, [](Card& card) -> Result<UINT> {
        card.engine.load_program_file();
        return UINT{loaded};
    });
}

UINT n_load_correction_file(UINT CardNo, const char* Name, UINT No, UINT Dim) {
    UINT answer = no_such_card;
    command(__func__, CardNo, [&](Card& card) { return load_correction(card, Name, No, Dim, answer); });
    return answer;
}

long n_load_fly_2d_table(UINT CardNo, const char* Name, UINT No) {
    UINT answer = no_such_card;
    command(__func__, CardNo, [&](Card& card) { return load_fly_table(card, Name, No, answer); });
    return static_cast<long>(answer);
}

double n_get_table_para(UINT CardNo, UINT TableNo, UINT ParaNo) {
    return with_card(__func__, CardNo, 0.0, [&](Card& card) -> Result<double> {
        MOTIONRACK_CHECK(check_range("TableNo", TableNo, 1, rtc5::table_count));
        return header_word(card, TableNo, ParaNo);
    });
}

double n_get_head_para(UINT CardNo, UINT HeadNo, UINT ParaNo) {
    return with_card(__func__, CardNo, 0.0, [&](Card& card) -> Result<double> {
        MOTIONRACK_CHECK(check_range("HeadNo", HeadNo, 1, rtc5::head_count));
        return header_word(card, card.engine.state().transforms.heads[HeadNo - 1].table, ParaNo);
    });
}

// ---- Lists and settings

void n_get_status(UINT CardNo, UINT* Status, UINT* Pos) {
    ask_two(__func__, CardNo, Status, Pos, [&](Card& card) {
        *Status = card.engine.status();
        *Pos = static_cast<UINT>(card.engine.parts().execution.position());
    });
}

void n_set_delay_mode(UINT CardNo, UINT VarPoly, UINT, UINT EdgeLevel, UINT MinJumpDelay, UINT JumpLengthLimit) {
    command(__func__, CardNo, [&](Card& card) {
        rtc5::Delays delays = card.engine.state().path.delays;
        delays.variable_polygon = VarPoly != 0;
        delays.edge_level = EdgeLevel;
        delays.min_jump = MinJumpDelay;
        delays.jump_limit = JumpLengthLimit;
        return card.engine.parts().path.set_delays(delays);
    });
}

// ---- Encoders, starts, McBSP

void n_get_encoder(UINT CardNo, long* Encoder0, long* Encoder1) {
    ask_two(__func__, CardNo, Encoder0, Encoder1, [&](Card& card) {
        *Encoder0 = card.engine.encoder(0);
        *Encoder1 = card.engine.encoder(1);
    });
}

void n_read_encoder(UINT CardNo, long* Encoder0_1, long* Encoder1_1, long* Encoder0_2, long* Encoder1_2) {
    question(__func__, CardNo, false, [&](Card& card) -> Result<bool> {
        for (const long* place : {Encoder0_1, Encoder1_1, Encoder0_2, Encoder1_2})
            MOTIONRACK_CHECK(check_pointer(place, "An address of the answer"));
        const auto first = card.engine.parts().encoders.stored(0), second = card.engine.parts().encoders.stored(1);
        *Encoder0_1 = first[0], *Encoder1_1 = first[1];
        *Encoder0_2 = second[0], *Encoder1_2 = second[1];
        return true;
    });
}

void n_get_fly_2d_offset(UINT CardNo, long* OffsetX, long* OffsetY) {
    ask_two(__func__, CardNo, OffsetX, OffsetY, [&](Card& card) {
        *OffsetX = static_cast<long>(card.engine.state().fly.offset_2d.x);
        *OffsetY = static_cast<long>(card.engine.state().fly.offset_2d.y);
    });
}

void n_set_fly_tracking_error(UINT CardNo, UINT TrackingErrorX, UINT TrackingErrorY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_range("TrackingErrorX", TrackingErrorX, 0, 65535));
        MOTIONRACK_CHECK(check_range("TrackingErrorY", TrackingErrorY, 0, 65535));
        card.engine.parts().encoders.set_tracking_error(static_cast<std::uint16_t>(TrackingErrorX),
                                                        static_cast<std::uint16_t>(TrackingErrorY));
        return {};
    });
}

void n_set_extstartpos(UINT CardNo, UINT Pos) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_range("Pos", Pos, 0, static_cast<UINT>(card.engine.settings().list_memory - 1)));
        card.engine.parts().starts.set_position(Pos);
        return {};
    });
}

long n_read_mcbsp(UINT CardNo, UINT No) {
    return question(__func__, CardNo, 0L, [&](Card& card) -> Result<long> {
        MOTIONRACK_CHECK(check_range("No", No, 0, 3));
        return as(ErrorKind::stopped, card.engine.parts().mcbsp.read(small(No)));
    });
}

long n_read_multi_mcbsp(UINT CardNo, UINT No) {
    return question(__func__, CardNo, 0L, [&](Card& card) -> Result<long> {
        MOTIONRACK_CHECK(check_range("No", No, 0, 7));
        return card.engine.parts().mcbsp.typed(small(No));
    });
}

void n_mcbsp_init(UINT CardNo, UINT XDelay, UINT RDelay) {
    command(__func__, CardNo, [&](Card&) -> Result<void> {
        MOTIONRACK_CHECK(check_range("XDelay", XDelay, 0, 2));
        return check_range("RDelay", RDelay, 0, 2);
    });
}

void n_mcbsp_init_spi(UINT CardNo, UINT ClockLevel, UINT ClockDelay) {
    command(__func__, CardNo, [&](Card&) -> Result<void> {
        MOTIONRACK_CHECK(check_range("ClockLevel", ClockLevel, 0, 1));
        return check_range("ClockDelay", ClockDelay, 0, 1);
    });
}

UINT n_set_mcbsp_freq(UINT CardNo, UINT Freq) {
    return with_card(__func__, CardNo, UINT{}, [&](Card&) -> Result<UINT> {
        MOTIONRACK_CHECK(check_range("Freq", Freq, 1, 50'000'000));
        return Freq;
    });
}

void n_set_mcbsp_out(UINT CardNo, UINT Signal1, UINT Signal2) {
    call(__func__, CardNo, &rtc5::SignalRecorder::send, std::array<std::uint32_t, 2>{Signal1, Signal2});
}

void n_set_mcbsp_out_ptr(UINT CardNo, UINT Number, ULONG_PTR SignalPtr) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(check_range("Number", Number, 0, rtc5::sent_signals));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): the command takes an address as a number
        const auto* const signals = reinterpret_cast<const std::uint32_t*>(SignalPtr);
        if (Number > 0) MOTIONRACK_CHECK(check_pointer(signals, "SignalPtr"));
        return card.engine.parts().recorder.send({signals, Number});
    });
}

// ---- Recording

void n_measurement_status(UINT CardNo, UINT* Busy, UINT* Pos) {
    ask_two(__func__, CardNo, Busy, Pos, [&](Card& card) {
        const rtc5::Recording& r = card.engine.parts().recorder.recording();
        *Busy = r.period != 0;
        *Pos = static_cast<UINT>(r.count) - 1;  // 2^32 - 1: nothing recorded
    });
}

void n_get_waveform(UINT CardNo, UINT Channel, UINT Number, ULONG_PTR Ptr) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const rtc5::Recording& r = card.engine.parts().recorder.recording();
        if (r.count == 0)
            return fail(ErrorKind::refused,
                        "nothing was recorded. No samples were copied. Record signals with set_trigger first.");
        MOTIONRACK_CHECK(check_range("Channel", Channel, 1, static_cast<UINT>(r.channels)));
        MOTIONRACK_CHECK(check_range("Number", Number, 1, static_cast<UINT>(r.count)));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): the command takes an address as a number
        auto* const to = reinterpret_cast<std::int32_t*>(Ptr);
        MOTIONRACK_CHECK(check_pointer(to, "Ptr"));
        for (UINT i = 0; i < Number; ++i) to[i] = card.engine.parts().recorder.recorded(Channel - 1, i);
        return {};
    });
}
