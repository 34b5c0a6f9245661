// Functions that run marking jobs given as text.
#pragma once

#include <gtest/gtest.h>

#include <motionrack/mark/render.hpp>
#include <string>

namespace motionrack::mark {

inline constexpr const char* square_svg =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm" viewBox="0 0 10 10">)"
    R"(<path d="M0 10 H10 V0 H0 Z"/></svg>)";

inline Load one_file(const std::string& text) {
    return [text](const std::string&) -> Result<std::string> { return text; };
}

inline MarkingJob job_of(const std::string& text) {
    JobRead read = read_job(text, "job.toml");
    for (const Error& error : read.errors) ADD_FAILURE() << error.text();
    return read.job.value_or(MarkingJob{});
}

/// Returns all errors of a job, one per line.
inline std::string errors_of(const std::string& text) {
    std::string out;
    for (const Error& error : read_job(text, "j.toml").errors) out += error.text() + "\n";
    return out;
}

inline MarkingOutcome run(const MarkingJob& job, const std::string& svg = square_svg) {
    const Result<Prepared> prepared = prepare(job, one_file(svg));
    if (!prepared) return ADD_FAILURE() << prepared.error().text(), MarkingOutcome{};
    Result<MarkingOutcome> out = run_job(job, *prepared);
    if (!out) return ADD_FAILURE() << out.error().text(), MarkingOutcome{};
    return *out;
}

/// Returns the message with which prepare() or run_job() refuses the job; "" if it runs.
inline std::string refusal(const MarkingJob& job, const std::string& svg = square_svg) {
    const Result<Prepared> prepared = prepare(job, one_file(svg));
    if (!prepared) return prepared.error().text();
    const Result<MarkingOutcome> out = run_job(job, *prepared);
    return out ? "" : out.error().text();
}

}  // namespace motionrack::mark
