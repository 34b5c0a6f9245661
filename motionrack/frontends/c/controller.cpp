// Implements the functions of motionrack/c.h for programs and homing.
#include <functional>
#include <motionrack/frontends/c/calls.hpp>
#include <motionrack/rack/homing.hpp>

namespace {

using namespace motionrack::c;
using motionrack::Error;
using motionrack::ErrorKind;
using motionrack::Result;
using motionrack::rack::HomingOutcome;
using motionrack::rack::JobProgress;
using motionrack::rack::ProgramReport;
using motionrack::rack::ProgramRequest;

constexpr const char* no_program = "The part program is a null pointer. Nothing was moved.";

/// Returns the error code of an operation that may have moved axes.
int code_of_end(const Result<void>& ended) {
    if (ended) return MR_OK;
    switch (ended.error().kind) {
        case ErrorKind::invalid_input:
            return MR_BAD_INPUT;
        case ErrorKind::machine:
            return MR_MACHINE;
        case ErrorKind::stopped:
            return MR_STOPPED;
        case ErrorKind::refused:
        case ErrorKind::io:
            break;
    }
    return code_of(ended.error().kind);
}

ProgramRequest order_of(const char* path_or_text, const mr_run_options* options) {
    ProgramRequest out;
    out.path_or_text = path_or_text;
    if (options == nullptr) return out;
    if (options->tools != nullptr) out.tools = options->tools;
    out.block_delete = options->block_delete != 0;
    if (options->progress != nullptr)
        out.progress = [progress = options->progress, user = options->user](const JobProgress& p) {
            return progress(user, p.seconds, p.line, p.lines) == 0;
        };
    return out;
}

/// Returns true inside a callback: the call must be rejected, so that the results of the outer call are kept.
bool is_refused_in_call_back(const mr_rack& rack) {
    return !rack.session->check_free().has_value();
}

/// Returns the code of a finished operation; stores the sentence of its error, or the report if that is empty.
int finished(mr_rack& rack, const Result<void>& ended, const std::string& sentence) {
    const int code = code_of_end(ended);
    return code == MR_OK ? code : failed(code, sentence.empty() ? rack.report : sentence);
}

}  // namespace

int mr_run_program(mr_rack* rack, const char* path_or_text, const mr_run_options* options, mr_run_result* result) {
    if (result != nullptr) *result = {0, 0, 0, 0, 0, 0, ""};
    int code = MR_OK;
    const int done = guarded({{rack, no_rack}, {path_or_text, no_program}}, [&]() -> Result<void> {
        if (is_refused_in_call_back(*rack)) return rack->session->check_free();
        ProgramReport report = rack->session->run_program(order_of(path_or_text, options));
        rack->sentence = std::move(report.sentence);
        rack->report = std::move(report.summary);
        code = finished(*rack, report.ended, rack->sentence);
        if (result != nullptr)
            *result = {code == MR_OK,          report.location.line,
                       report.location.column, motionrack::to_seconds(report.outcome.time),
                       report.outcome.path_mm, report.outcome.max_deviation.mm,
                       rack->sentence.c_str()};
        return {};
    });
    return done != MR_OK ? done : code;
}

int mr_home(mr_rack* rack, const char* axes) {
    int code = MR_OK;
    const int done = guarded({{rack, no_rack}}, [&]() -> Result<void> {
        if (is_refused_in_call_back(*rack)) return rack->session->check_free();
        const HomingOutcome outcome = rack->session->home(axes == nullptr ? "" : axes);
        rack->sentence.clear();
        rack->report = motionrack::rack::homing_text(outcome);
        code = finished(*rack, outcome.ended, outcome.ended ? "" : outcome.ended.error().text());
        return {};
    });
    return done != MR_OK ? done : code;
}

const char* mr_report(const mr_rack* rack) {
    if (rack != nullptr) return rack->report.c_str();
    failed(MR_BAD_CALL, no_rack);
    return "";
}
