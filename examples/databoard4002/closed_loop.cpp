#include <array>
#include <cstdio>
#include <fstream>

#include "bench.hpp"

namespace howto {

Result<std::string> closed_loop(const std::string& csv) {
    std::ifstream file(csv);
    std::vector<double> seconds;
    std::array<std::vector<float>, 3> turns;
    for (std::string line; std::getline(file, line);) {
        std::array<double, 4> row{};
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &row[0], &row[1], &row[2], &row[3]) != 4)
            return fail(ErrorKind::invalid_input,
                        csv + " has the line '" + line + "', which is not: seconds, counts, counts, counts.");
        seconds.push_back(row[0]);
        for (std::size_t run = 0; run < turns.size(); ++run)
            turns[run].push_back(static_cast<float>(row[run + 1] / 4'000));
    }
    if (seconds.empty()) return fail(ErrorKind::io, csv + " could not be read, or is empty. No picture was created.");
    std::array<trace::SvgChart, 3> charts;
    const std::array<const char*, 3> titles = {"1 mV a count, the motor alone: turns",
                                               "10 mV a count, the motor alone: turns",
                                               "1 mV a count, a load of 30 times the motor's inertia: turns"};
    const std::array<const char*, 3> looks = {"x", "y", "z"};
    for (std::size_t run = 0; run < charts.size(); ++run) {
        charts[run].title = titles[run];
        charts[run].series = {{"", looks[run], seconds, turns[run]}};
        charts[run].limits = {{1, "target"}};
    }
    return trace::svg_timeline("One turn in a closed loop around the card", charts, {},
                               {.width = 720, .height = 600, .standalone = true});
}

}  // namespace howto
