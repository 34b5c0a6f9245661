// Calls, and their common parts.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/driver/home_series.hpp>
#include <motionrack/cards/mcx314/driver/own_names.hpp>
#include <motionrack/cards/mcx314/library/calls.hpp>
#include <vector>

namespace motionrack::mcx314 {

namespace {

std::vector<functions::FunctionRow> all_rows() {
    const auto first = functions::function_rows(), more = functions::own_rows();
    std::vector<functions::FunctionRow> out(first.begin(), first.end());
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

const std::vector<functions::FunctionRow>& rows() {
    static const std::vector<functions::FunctionRow> all = all_rows();
    return all;
}

std::vector<FunctionInfo> all_infos() {
    std::vector<FunctionInfo> out;
    for (const functions::FunctionRow& row : rows()) out.push_back(row.info);
    return out;
}

}  // namespace

std::span<const FunctionInfo> library_functions() {
    static const std::vector<FunctionInfo> all = all_infos();
    return all;
}

void QuickStops::stop() {
    port_.write(reg::WR0, static_cast<std::uint16_t>(xyzu << 8 | cmd::QUICK_STOP));
}

// ---- the library

std::span<const FunctionInfo> Library::functions() const {
    return library_functions();
}

Result<void> Library::begin() {
    chip_.driver.RESET();
    return chip_.driver.SetPulseMode(xyzu, 1);
}

Result<CallAnswer> Library::call(std::size_t function, std::span<const std::int64_t> values) {
    const functions::FunctionRow& row = rows().at(function);
    MOTIONRACK_ASSERT(values.size() == row.info.arguments.size());
    MOTIONRACK_TRY(CallAnswer answer, row.call(chip_, values).map_error([](Error error) {
        error.message = with_own_names(error.message, "");
        return error;
    }));
    if (answer.value && answer.text.empty()) answer.text = fmt::format("{} {}", *answer.value, row.info.returns);
    return answer;
}

// ---- calls

namespace functions {

FourAxes four(Values v) {
    return {v[0], v[1], v[2], v[3]};
}

CallAnswer written() {
    return {{}, "Written."};
}

CallAnswer begun(LibraryChip& chip, unsigned mask) {
    return {{}, fmt::format("{} {}.", axes_text(mask), chip.driver.moving(mask) ? "drives" : "has driven already")};
}

Result<CallAnswer> line(LibraryChip& chip, LineFunction function, const LINEDATA& speeds, Values ends) {
    LINEDATA data = speeds;
    data.P = four(ends);
    MOTIONRACK_CHECK((chip.driver.*function)(data, axes_of(ends[4])));
    return begun(chip, axes_of(ends[4]));
}

Result<CallAnswer> arc(LibraryChip& chip, ArcFunction function, const CIRCLEDATA& speeds, Values places) {
    CIRCLEDATA data = speeds;
    data.P = four(places);
    data.C = four(places.subspan(4));
    MOTIONRACK_CHECK((chip.driver.*function)(data, axes_of(places[8])));
    return begun(chip, axes_of(places[8]));
}

namespace {

/// The sentence of a homing, its findings, and the duration of each of its states.
std::string diagnosis(const HomeReport& report) {
    std::string out = report.sentence;
    for (const std::string& note : report.notes) out += ' ' + note;
    out += fmt::format(" At home LP was {} and EP {}; the switch bounced {} times.", report.zero_lp, report.zero_ep,
                       report.bounces);
    if (const auto way = report.switch_to_index()) out += fmt::format(" From the switch to Z: {} pulses.", *way);
    for (const ChipHomingStateVisit& stay : report.stays)
        if (stay.took > Duration{0}) out += fmt::format(" {} {:.3f} s.", stay.state, to_seconds(stay.took));
    return out;
}

}  // namespace

Result<CallAnswer> home(LibraryChip& chip, int type, Values v) {
    using HomeFunction =
        Result<std::vector<HomeReport>> (*)(Driver&, unsigned, unsigned, std::int64_t, std::int64_t, std::int64_t);
    static constexpr HomeFunction types[] = {HomeType1, HomeType2, HomeType3, HomeType4};
    MOTIONRACK_TRY(const std::vector<HomeReport> reports,
                   types[type - 1](chip.driver, chip.home_axes, static_cast<unsigned>(v[0]), v[1], v[2], v[3]));
    CallAnswer out;
    for (const HomeReport& report : reports)
        out.text += fmt::format("{}{}", out.text.empty() ? "" : "\n", diagnosis(report));
    return out;
}

}  // namespace functions

}  // namespace motionrack::mcx314
