// Random jobs for the card and its twin: list commands, and actions between ticks.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <motionrack/cards/rtc5/map.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace motionrack::rtc5 {

struct Act {
    enum Kind {
        run,
        load,
        execute,
        change,
        loop,
        quit_loop,
        stop,
        pause,
        restart,
        alone,
        start,
        word,
        count,
        simulate,
        tracking,
        control,
        start_delay,
        matrix,
        offset,
        angle,
        scale,
        hi,
        cor,
        delays,
        mcbsp_in,
        multi,
        online,
        apply,
        init_2d,
        read_info,
        reset_2d,
        watch,
        laser,
        kinds
    };
    Kind kind = run;
    std::int64_t a = 0, b = 0;
    double v[4] = {};
};

struct Job {
    std::vector<Command> list1, list2;
    std::vector<std::vector<Command>> subroutines;  ///< commands of each subroutine, without list_return
    std::vector<Act> acts;
    bool inputs = false;  ///< encoder counts and McBSP words are functions of the tick
    bool steady = false;  ///< drawn at random; no test reads it
    double rate[2] = {};  ///< encoder counts per tick
    std::int64_t word_every = 1;
};

/// Returns the parts of a job that a shrinking test may leave out.
inline auto steps_of(Job& job) {
    return std::tie(job.acts, job.list1, job.list2);
}

// For messages of failed tests.
std::string listing_of(const Job& job);
void PrintTo(const Act& act, std::ostream* out);
void PrintTo(const Command& command, std::ostream* out);

class JobMaker {
  public:
    explicit JobMaker(std::uint64_t seed) : random_(seed) {}
    Job make();

  private:
    std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(n)); }
    bool one_of(std::int64_t n) { return below(n) == 0; }
    double real(double min, double max) { return min + (max - min) * (static_cast<double>(random_() >> 11) * 0x1p-53); }
    double coordinate();
    double count_scale();
    double value_of(Op op, const ParamInfo& param);
    Command command();
    void fill(std::vector<Command>& list);
    Act act();

    std::mt19937_64 random_;
    bool calm_ = false;  ///< generates mostly commands of the path and few settings
};

}  // namespace motionrack::rtc5
