// A capture from its first to its last sample: what each encoder counted, how fast, and what was wrong.
#pragma once

#include <functional>
#include <motionrack/decode/capture.hpp>
#include <motionrack/decode/channel.hpp>
#include <motionrack/decode/channel_selection.hpp>
#include <optional>

namespace motionrack::decode {

struct AnalysisSettings {
    double window_s = 1e-3;  ///< the peak speed is that of a window of this length; > 0
    ChannelSettings channel;
    std::function<void(double part)> progress;  ///< after each block, 0 .. 1; -1 if the size is not known
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

struct Peak {
    double counts_per_s = 0;  ///< with its sign
    double time_s = 0;        ///< where its window begins
};

struct LineNote {
    std::string signal;
    std::uint64_t unknown = 0;     ///< how often the line was X or Z
    std::string first_unknown;     ///< where first
    std::optional<double> from_s;  ///< where its first level is, if that is not the first sample; NaN: nowhere
};

struct ChannelResult {
    std::string name, a, b, z;  ///< z: "" if there is none
    std::int64_t count = 0;
    std::uint64_t up = 0, down = 0, illegal = 0, indexes = 0;
    double seconds = 0;        ///< from the channel's first sample to the last
    double mean_per_s = 0;     ///< count / seconds; 0 if there is no time
    std::optional<Peak> peak;  ///< none if the capture is shorter than a window
    std::vector<IllegalAt> first_illegal;
    std::vector<IndexAt> first_indexes;
    std::vector<LineNote> notes;  ///< of lines that had no level somewhere
};

struct Analysis {
    Format format = Format::raw;
    std::uint64_t samples = 0;
    double first_s = 0, last_s = 0;  ///< times of the first and the last sample
    double tick_s = 0;
    bool timed = false;  ///< the times are the file's, not the sample rate's
    double window_s = 0;
    std::vector<ChannelResult> channels;
    std::optional<Error> cut;  ///< where the file is cut off
    bool stopped = false;
};

/// Reads the capture to its end. Errors: refused (window), invalid_input with its place, io.
Result<Analysis> analyse(Capture& capture, const std::vector<ChannelSelection>& choices,
                         const AnalysisSettings& settings);

}  // namespace motionrack::decode
