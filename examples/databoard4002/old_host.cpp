#include <array>
#include <cstdio>
#include <fstream>

#include "bench.hpp"

namespace howto {

Result<std::string> old_host(const std::string& csv) {
    std::ifstream file(csv);
    std::vector<double> seconds;
    std::vector<float> counts, speed;
    for (std::string line; std::getline(file, line);) {
        std::array<double, 3> row{};
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &row[0], &row[1], &row[2]) != 3)
            return fail(ErrorKind::invalid_input,
                        csv + " has the line '" + line + "', which is not: seconds, counts, counts a second.");
        seconds.push_back(row[0]);
        counts.push_back(static_cast<float>(row[1] / 1'000));
        speed.push_back(static_cast<float>(row[2] / 1'000));
    }
    if (seconds.empty()) return fail(ErrorKind::io, csv + " could not be read, or is empty. No picture was created.");
    std::array<trace::SvgChart, 2> charts;
    charts[0].title = "position, thousands of counts; A is 0";
    charts[0].series = {{"", "z", seconds, counts}};
    charts[0].limits = {{128, "B"}, {256, "C"}};
    charts[1].title = "speed, thousands of counts a second";
    charts[1].series = {{"", "y", seconds, speed}};
    return trace::svg_timeline("The maker's demonstration, one round", charts, {},
                               {.width = 720, .height = 420, .standalone = true});
}

}  // namespace howto
