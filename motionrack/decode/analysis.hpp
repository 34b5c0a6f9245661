// Analysis of a capture from first to last sample: counts, velocities and errors of each encoder.
#pragma once

#include <functional>
#include <motionrack/decode/capture.hpp>
#include <motionrack/decode/channel.hpp>
#include <motionrack/decode/channel_selection.hpp>
#include <optional>

namespace motionrack::decode {

struct AnalysisSettings {
    double window_s = 1e-3;  ///< length of the window for the peak velocity; > 0
    ChannelSettings channel;
    std::function<void(double part)> progress;  ///< after each block, 0 .. 1; -1 if the size is unknown
    std::function<bool()> stop;                 ///< true ends the analysis early
};

struct IllegalAt {
    std::uint64_t sample = 0;
    double time_s = 0;
};

struct IndexAt {
    std::uint64_t sample = 0;
    double time_s = 0;
    std::int64_t count = 0;
};

struct VelocityPeak {
    double counts_per_s = 0;  ///< signed
    double time_s = 0;        ///< start of its window
};

struct LineNote {
    std::string signal;
    std::uint64_t unknown = 0;     ///< number of changes to X or Z
    std::string first_unknown;     ///< place of the first one
    std::optional<double> from_s;  ///< time of its first level, if later than the first sample; NaN: none
};

struct ChannelResult {
    std::string name, a, b, z;  ///< z: "" if absent
    std::int64_t count = 0;
    std::uint64_t up = 0, down = 0, illegal = 0, indexes = 0;
    double seconds = 0;                ///< from the channel's first sample to the last
    double mean_per_s = 0;             ///< count / seconds; 0 for no duration
    std::optional<VelocityPeak> peak;  ///< absent if the capture is shorter than a window
    std::vector<IllegalAt> first_illegal;
    std::vector<IndexAt> first_indexes;
    std::vector<LineNote> notes;  ///< lines without a level at some time
};

struct Analysis {
    Format format = Format::raw;
    std::uint64_t samples = 0;
    double first_s = 0, last_s = 0;  ///< times of the first and the last sample
    double tick_s = 0;
    bool timed = false;  ///< the times come from the file, not from the sample rate
    double window_s = 0;
    std::vector<ChannelResult> channels;
    std::optional<Error> cut;  ///< place at which the file is truncated
    bool stopped = false;
};

/// Reads the capture to its end. Errors: refused (window), invalid_input with its place, io.
Result<Analysis> analyse(Capture& capture, const std::vector<ChannelSelection>& choices,
                         const AnalysisSettings& settings);

}  // namespace motionrack::decode
