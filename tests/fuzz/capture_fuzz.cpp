// libFuzzer: any bytes as a capture of any format; it is rejected with a position or gives consistent counts.
#include <cmath>
#include <cstdint>
#include <motionrack/decode/analysis.hpp>
#include <motionrack/decode/report.hpp>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack::decode;
using motionrack::fuzz::require;

void check(const ChannelResult& channel, const Analysis& analysis) {
    require(channel.count == static_cast<std::int64_t>(channel.up - channel.down), "a count is ups less downs");
    require(channel.up + channel.down + channel.illegal <= analysis.samples, "a sample is one step at most");
    require(channel.first_illegal.size() <= channel.illegal && channel.first_indexes.size() <= channel.indexes,
            "no more events are listed than were counted");
    require(std::isfinite(channel.mean_per_s) && channel.seconds >= 0, "a mean velocity is a number");
    for (std::size_t i = 0; i < channel.first_indexes.size(); ++i) {
        require(channel.first_indexes[i].sample < analysis.samples, "an index is in the capture");
        require(i == 0 || channel.first_indexes[i].time_s >= channel.first_indexes[i - 1].time_s,
                "indexes are in the order of time");
    }
}

/// The first byte selects how the rest is read.
void decode(std::uint8_t choice, std::string_view text) {
    static constexpr Format formats[] = {Format::automatic, Format::vcd, Format::csv, Format::raw};
    CaptureSettings settings;
    settings.format = formats[choice & 3];
    settings.sample_rate_hz = (choice & 4) != 0 ? 1e6 : 0;
    settings.sample_bytes = 1 + (choice >> 5);
    auto capture = open_capture(from_memory(text), "fuzz", settings);
    if (!capture) return require(!capture.error().message.empty(), "a refusal has a sentence");
    const auto& signals = (*capture)->signals();
    auto channels = choose_channels(signals, {});
    if (!channels && signals.size() >= 2)
        channels = std::vector<ChannelSelection>{
            {"X", 0, 1, signals.size() > 2 ? std::optional<std::size_t>(2) : std::nullopt}};
    if (!channels) return;
    AnalysisSettings how;
    how.window_s = (choice & 8) != 0 ? 1e-3 : 1e-6;
    how.channel.index_low = (choice & 16) != 0;
    const auto analysis = analyse(**capture, *channels, how);
    if (!analysis) return require(!analysis.error().message.empty(), "a refusal has a sentence");
    for (const ChannelResult& channel : analysis->channels) check(channel, *analysis);
    require(!analysis_text(*analysis, "fuzz", 10).empty() && !analysis_json(*analysis, "fuzz").empty(),
            "an analysis can be told");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 0) decode(data[0], {reinterpret_cast<const char*>(data + 1), size - 1});
    return 0;
}
