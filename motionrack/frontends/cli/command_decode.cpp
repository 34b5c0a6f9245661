// decode: counts, velocities and faults of the encoders in a logic analyser capture.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <motionrack/decode/analysis.hpp>
#include <motionrack/decode/report.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/terminal.hpp>

namespace motionrack::cli {

namespace {

struct DecodeOptions {
    std::string file, format, sample_rate;
    std::vector<std::string> channels;
    decode::CaptureSettings capture;
    decode::AnalysisSettings analysis;
    double window_ms = 1;
    std::size_t list = 10;
    bool signals = false, json = false, quiet = false;
};

int print_signals(const decode::Capture& capture) {
    for (std::size_t i = 0; i < capture.signals().size(); ++i) fmt::print("{:>5}  {}\n", i, capture.signals()[i]);
    return exit_done;
}

int print_analysis(const decode::Analysis& analysis, const DecodeOptions& options) {
    if (options.json)
        fmt::print("{}\n", decode::analysis_json(analysis, options.file));
    else
        fmt::print("{}", decode::analysis_text(analysis, options.file, options.list));
    std::fflush(stdout);  // prints the tables before the messages
    for (const std::string& warning : decode::analysis_warnings(analysis)) print_warning(warning);
    if (analysis.cut) return report(*analysis.cut);
    if (!analysis.stopped) return exit_done;
    print_error("Stopped: only the part before that was decoded.");
    return exit_stopped;
}

int decode_file(DecodeOptions& options) {
    using decode::Format;
    if (!options.sample_rate.empty()) {
        const Result<double> rate = decode::read_rate(options.sample_rate);
        if (!rate) return report(rate.error());
        options.capture.sample_rate_hz = *rate;
    }
    if (!options.format.empty()) {
        static constexpr std::pair<std::string_view, Format> formats[] = {
            {"vcd", Format::vcd}, {"csv", Format::csv}, {"raw", Format::raw}};
        const auto known = std::find_if(std::begin(formats), std::end(formats),
                                        [&](const auto& each) { return each.first == options.format; });
        if (known == std::end(formats)) {
            print_error(fmt::format("Unknown format '{}'; the formats are vcd, csv and raw. Nothing was decoded.",
                                    options.format));
            return exit_usage;
        }
        options.capture.format = known->second;
    }
    if (!(options.window_ms > 0)) {
        print_error(fmt::format("The window is {} ms, but must be above 0. Nothing was decoded.", options.window_ms));
        return exit_usage;
    }
    auto source = decode::open_file(options.file);
    if (!source) return report(source.error());
    const auto capture = decode::open_capture(std::move(*source), options.file, options.capture);
    if (!capture) return report(capture.error());
    if (options.signals) return print_signals(**capture);
    const auto channels = decode::choose_channels((*capture)->signals(), options.channels);
    if (!channels) return report(channels.error());
    ProgressLine progress(options.quiet || options.json);
    options.analysis.window_s = options.window_ms * 1e-3;
    options.analysis.progress = [&](double part) {
        const double megabytes = static_cast<double>((*capture)->bytes_read()) * 1e-6;
        progress.show(part < 0 ? 0 : part, fmt::format("{:.0f} MB decoded", megabytes));
    };
    options.analysis.stop = [] { return stop_asked.load(); };
    stop_on_signals();
    const Result<decode::Analysis> analysis = decode::analyse(**capture, *channels, options.analysis);
    progress.clear();
    return analysis ? print_analysis(*analysis, options) : report(analysis.error());
}

}  // namespace

void add_decode(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<DecodeOptions>();
    CLI::App* command = app.add_subcommand(
        "decode", "Count the encoders in a logic analyser's capture: counts, velocities, illegal transitions, indexes");
    command->add_option("FILE", options->file, "VCD, CSV or raw binary capture, '-': standard input")->required();
    command
        ->add_option("--channel", options->channels,
                     "an encoder and its lines by name or number: X=A,B or X=A,B,Z; repeat for more (default: lines "
                     "named X.enc_a, X.enc_b, X.enc_z)")
        ->allow_extra_args(false);
    command->add_option("--format", options->format, "vcd, csv or raw (default: by the file's name and content)");
    command->add_option("--sample-rate", options->sample_rate,
                        "samples a second, such as 24M or 500k; for raw captures and CSV without times");
    command
        ->add_option("--sample-bytes", options->capture.sample_bytes,
                     "bytes a sample of a raw capture, the lowest first")
        ->check(CLI::Range(1, 8))
        ->option_text("1 .. 8 (1)");
    command->add_option("--window-ms", options->window_ms, "window of the peak velocity, ms")->capture_default_str();
    command->add_flag("--index-low", options->analysis.channel.index_low,
                      "the index line is active low: its falling edges count");
    command
        ->add_option("--list", options->list,
                     "how many illegal transitions and indexes are listed for each channel; 0: none")
        ->capture_default_str();
    command->add_flag("--signals", options->signals, "list the capture's lines with their numbers, decode nothing");
    command->add_flag("--json", options->json, "print everything as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
    command->footer(
        "Example: motionrack decode run.vcd\n"
        "Example: motionrack decode logic.csv --channel spindle=D0,D1,D2 --window-ms 10\n"
        "Example: motionrack decode scope.bin --sample-rate 24M --channel X=0,1 --channel Y=2,3\n"
        "A leads B counts up, four counts a line. Ctrl-C prints the result so far.");
    command->callback([options, &chosen] { chosen = [options] { return decode_file(*options); }; });
}

}  // namespace motionrack::cli
