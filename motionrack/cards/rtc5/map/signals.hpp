// Signals that the RTC5 records (set_trigger), answers (get_value) and sends over McBSP (set_mcbsp_out), by number.
#pragma once

#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack::rtc5 {

/// Quantity of a tick that a signal gives.
enum class SignalSource : std::uint8_t { laser, corrected, z, table, output, transformed, io, count, mark_speed };

struct SignalInfo {
    std::string_view name;
    std::uint32_t number = 0;
    SignalSource source = SignalSource::laser;
    std::uint8_t head = 0;    ///< 0 A, 1 B; for counts: the encoder
    std::uint8_t axis = 0;    ///< 0 X, 1 Y
    bool laser_only = false;  ///< true: the value is -524288 while the laser is off
    std::string_view meaning;
};

namespace map {

inline constexpr SignalInfo signals[] = {
    {"LASERON", 0, SignalSource::laser, 0, 0, false, "1 while the laser is on, at the tick's end"},
    {"StatusAX", 1, SignalSource::output, 0, 0, false, "the mirror's position: heads answer with the output"},
    {"StatusAY", 2, SignalSource::output, 0, 1, false, "the same of Y"},
    {"StatusBX", 4, SignalSource::output, 1, 0, false, "the same of head B"},
    {"StatusBY", 5, SignalSource::output, 1, 1, false, "the same of head B, Y"},
    {"SampleX", 7, SignalSource::corrected, 0, 0, false, "X after wobbel and processing on the fly"},
    {"SampleY", 8, SignalSource::corrected, 0, 1, false, "Y after them"},
    {"SampleZ", 9, SignalSource::z, 0, 0, false, "Z after them"},
    {"SampleAX_Corr", 10, SignalSource::table, 0, 0, false, "X of head A behind its correction table"},
    {"SampleAY_Corr", 11, SignalSource::table, 0, 1, false, "Y"},
    {"SampleAZ_Corr", 12, SignalSource::z, 0, 0, false, "Z at the output"},
    {"SampleBX_Corr", 13, SignalSource::table, 1, 0, false, "X of head B behind its correction table"},
    {"SampleBY_Corr", 14, SignalSource::table, 1, 1, false, "Y"},
    {"SampleBZ_Corr", 15, SignalSource::z, 0, 0, false, "Z at the output"},
    {"StatusAX_LASERON", 16, SignalSource::output, 0, 0, true, "StatusAX while the laser is on, else -524288"},
    {"StatusAY_LASERON", 17, SignalSource::output, 0, 1, true, "StatusAY"},
    {"StatusBX_LASERON", 18, SignalSource::output, 1, 0, true, "StatusBX"},
    {"StatusBY_LASERON", 19, SignalSource::output, 1, 1, true, "StatusBY"},
    {"SampleAX_Out", 20, SignalSource::output, 0, 0, false, "X of head A at the output"},
    {"SampleAY_Out", 21, SignalSource::output, 0, 1, false, "Y"},
    {"SampleBX_Out", 22, SignalSource::output, 1, 0, false, "X of head B at the output"},
    {"SampleBY_Out", 23, SignalSource::output, 1, 1, false, "Y"},
    {"SampleAX_Trans", 25, SignalSource::transformed, 0, 0, false,
     "X of head A behind its matrix and offset, before the table"},
    {"SampleAY_Trans", 26, SignalSource::transformed, 0, 1, false, "Y"},
    {"SampleBX_Trans", 28, SignalSource::transformed, 1, 0, false,
     "X of head B behind its matrix and offset, before the table"},
    {"SampleBY_Trans", 29, SignalSource::transformed, 1, 1, false, "Y"},
    {"DigitalOut16", 35, SignalSource::io, 0, 0, false, "the 16 digital outputs"},
    {"Encoder0", 43, SignalSource::count, 0, 0, false, "counts"},
    {"Encoder1", 44, SignalSource::count, 1, 0, false, "counts"},
    {"MarkSpeed", 45, SignalSource::mark_speed, 0, 0, false, "the mark speed set, bits/ms, rounded"},
};

constexpr DeclarationError signals_flaw(std::span<const SignalInfo> all) {
    if (const DeclarationError flaw = names_flaw("the signals", "signal", all); !flaw.empty()) return flaw;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].number <= all[i - 1].number) return {"the signal ", all[i].name, " is not at its place"};
    return {};
}
static_assert(declared<signals_flaw(signals)>());

}  // namespace map

/// Finds a signal by its number; returns nullptr if the card has none.
constexpr const SignalInfo* signal_info(std::int64_t number) {
    for (const SignalInfo& signal : map::signals)
        if (signal.number == number) return &signal;
    return nullptr;
}

inline constexpr std::int64_t record_values = 1 << 21;  ///< values of a recording: 2 channels of 2^20, or 4 of 2^19
inline constexpr std::int64_t record_channels = 4, sent_signals = 8;

}  // namespace motionrack::rtc5
