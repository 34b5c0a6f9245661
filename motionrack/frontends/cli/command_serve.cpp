// serve: runs a rack that users operate in a browser.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <motionrack/auth/private_files.hpp>
#include <motionrack/auth/secrets.hpp>
#include <motionrack/disk/outputs.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/console_output.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/share_folder.hpp>
#include <motionrack/frontends/cli/system_service.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/frontends/server/served_rack.hpp>
#include <motionrack/journal/file_watch.hpp>
#include <motionrack/operate/journal_writer.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <optional>

namespace motionrack::cli {

namespace {

namespace fs = std::filesystem;

struct ServeOptions {
    std::string rack, address = "127.0.0.1", certificate, key, page, users, journal;
    std::uint16_t port = 8080;
    std::optional<std::uint16_t> grbl_port;
    std::string grbl_terminal;
    int grbl_axes = 3;
    std::int64_t journal_megabytes = 1000;
    bool grbl_resets_stop_all = false;
    std::vector<std::string> hosts, origins, live;
    double time_scale = 1;
    bool free = false, paused = false, no_pairing = false;
};

Result<server::Page> load_page(const std::string& folder) {
    if (!folder.empty()) return server::Page::read(folder);
    const fs::path beside = share_folder() / "page";
    return has_index(beside) ? server::Page::read(beside) : server::Page();
}

/// A rack, its clock, its journal and its clients; the members are in the order of their dependencies.
class Serving {
  public:
    explicit Serving(const ServeOptions& options) : options_(options) {}

    int run() {
        int code = exit_done;
        const auto config = load_rack(options_.rack, code, BuiltInRack::demonstration);
        if (!config) return code;
        stop_on_signals();
        if (const Result<void> begun = begin(*config); !begun) return report(begun.error());
        greet(*config);
        notify_service_manager("READY=1");
        served_->run();
        return end();
    }

  private:
    Result<void> begin(const rack::RackConfig& config) {
        allow_many_files();
        if (options_.certificate.empty() != options_.key.empty())
            return fail(ErrorKind::invalid_input, "TLS needs both --tls-cert and --tls-key. Nothing was started.");
        server::ServedSettings settings;
        settings.clock = options_.paused ? operate::ClockMode::paused
                         : options_.free ? operate::ClockMode::unthrottled
                                         : operate::ClockMode::real;
        settings.factor = options_.time_scale;
        settings.meanwhile = [this] { stop_if_asked(); };
        settings.version = MOTIONRACK_VERSION;
        settings.boot = auth::random_token().substr(0, 8);
        settings.door = door_settings();
        // A journal is written in place, never replaced, so it may lie behind a link.
        const std::string journal = journal::file_behind(options_.journal);
        MOTIONRACK_CHECK(disk::may_write({options_.rack, options_.certificate, options_.key}, {users_file_, journal}));
        for (const std::string& text : options_.live) {
            MOTIONRACK_TRY(operate::LivePlace place, operate::read_live_place(text));
            settings.machine.live.push_back(std::move(place));
        }
        settings.server = server_settings();
        settings.grbl = grbl_settings();
        MOTIONRACK_TRY(settings.page, load_page(options_.page));
        settings.page.mount("/docs", docs_for_panel());
        MOTIONRACK_TRY(settings.panel.rack_text, options_.rack.empty() ? Result<std::string>(demonstration_rack())
                                                                       : read_text(options_.rack, read_limits::toml));
        if (!journal.empty()) MOTIONRACK_CHECK(open_journal(journal, config, settings.machine));
        settings.journal = journal_.get();
        MOTIONRACK_TRY(served_, server::ServedRack::open(config, std::move(settings)));
        if (!journal_) return {};
        // Last: a start that fails must not look like a run that was interrupted.
        Result<void> begun = journal_->begin();
        if (!begun) served_->stop();
        return begun;
    }

    Result<void> open_journal(const std::string& file, const rack::RackConfig& config,
                              operate::MachineSettings& settings) {
        MOTIONRACK_CHECK(auth::check_writers(file, "The journal"));
        journal::JournalSettings book;
        book.max_bytes = options_.journal_megabytes * 1'000'000;
        book.on_quota = [this](const std::string& sentence) { write_line(sentence); };
        MOTIONRACK_TRY(journal_, journal::Journal::prepare(file, std::move(book)));
        if (!journal_->before()) return {};
        operate::LastKnownPositions last = operate::read_last(*journal_->before(), config);
        if (!last.sentence.empty()) print_warning(last.sentence);
        settings.initial_axes = std::move(last.axes);
        settings.alarm = std::move(last.sentence);
        return {};
    }

    auth::AuthSettings door_settings() {
        auth::AuthSettings settings;
        const fs::path folder = options_.users.empty() ? state_folder() : fs::path();
        settings.users_file = !options_.users.empty() ? fs::path(options_.users)
                              : folder.empty()        ? fs::path()
                                                      : folder / "users.json";
        users_file_ = settings.users_file.string();
        if (!options_.no_pairing)
            settings.on_start_code = [this](const std::string& code) {
                if (greeted_) write_line(fmt::format("A code was used. The next one is {}", code));
            };
        return settings;
    }

    server::ServerSettings server_settings() const {
        server::ServerSettings settings;
        settings.address = options_.address;
        settings.port = options_.port;
        if (!options_.certificate.empty()) settings.tls = server::TlsFiles{options_.certificate, options_.key};
        settings.hosts = options_.hosts;
        settings.origins = options_.origins;
        if (options_.no_pairing) settings.loopback_role = auth::Role::maintain;
        return settings;
    }

    std::optional<server::GrblPortSettings> grbl_settings() const {
        if (!options_.grbl_port && options_.grbl_terminal.empty()) return std::nullopt;
        server::GrblPortSettings settings;
        settings.port = options_.grbl_port;
        settings.link = options_.grbl_terminal;
        settings.axes = options_.grbl_axes;
        settings.resets_stop_all = options_.grbl_resets_stop_all;
        return settings;
    }

    void write_line(std::string line) { output_.write_line(std::move(line)); }

    /// Stops the axes after a signal; called repeatedly on the motion thread.
    void stop_if_asked() {
        warn_of_lost_records();
        if (!stop_asked || stopping_) return;
        stopping_ = true;
        write_line("Stopping the axes.");
        notify_service_manager("STOPPING=1");
        // With a paused clock the axes would never reach standstill.
        operate::ClockPacer& pacer = served_->pacer();
        if (pacer.mode() != operate::ClockMode::unthrottled)
            (void)pacer.set(operate::ClockMode::real, std::max(1.0, pacer.factor()));
        served_->machine().quit();
    }

    /// Warns once in the service log if the journal cannot be written; the page shows an alarm.
    void warn_of_lost_records() {
        if (!journal_ || warned_ || journal_->failure().empty()) return;
        warned_ = true;
        write_line(journal_->failure() + " The machine holds, and nothing is started.");
    }

    void greet(const rack::RackConfig& config) {
        const std::string code = served_->door().start_code();
        const auto live = served_->machine().service().live_places();
        write_line(fmt::format(
            "{} runs ({}, {}; simulated{}).", config.name, rack::count_noun(config.axes.size(), "axis", "axes"),
            rack::count_noun(config.cards.size(), "card"), live.empty() ? "" : ", except for the real cards below"));
        for (const operate::LivePlace& one : live)
            write_line(fmt::format("  real     {} at {}: its axes move in service; provide a wired emergency stop",
                                   one.card, one.place));
        write_line(fmt::format("  page     {}{}", served_->server().url(), code.empty() ? "" : "#pair=" + code));
        if (!code.empty())
            write_line(
                fmt::format("  code     {}   (valid once, for the role maintain; the next one is printed here)", code));
        if (options_.no_pairing) write_line("  pairing  none: every user of this computer has all rights");
        write_line(fmt::format("  users    {}", users_file_.empty() ? "kept in memory only" : users_file_));
        write_line(fmt::format("  journal  {}",
                               options_.journal.empty() ? "none; --journal FILE keeps one" : options_.journal));
        if (options_.grbl_port)
            write_line(fmt::format("  senders  127.0.0.1:{} (Grbl 1.1 over TCP)", served_->grbl()->port()));
        if (!options_.grbl_terminal.empty())
            write_line(fmt::format("  senders  {} (Grbl 1.1, a serial line)", options_.grbl_terminal));
        write_line(
            "Open the page in a browser, take control there, enable the machine. Ctrl-C stops the axes and ends.");
        greeted_ = true;
    }

    int end() {
        served_->stop();
        std::string places;
        for (const operate::AxisStatus& axis : served_->machine().status().axes)
            places += fmt::format(" {}{:.3f}", axis.letter, axis.commanded);
        int code = exit_done;
        if (journal_)
            if (const Result<void> closed = journal_->close(); !closed) code = report(closed.error());
        for (const operate::Alarm& alarm : served_->machine().status().alarms) {
            if (!alarm.stays || alarm.source.rfind("card ", 0) != 0) continue;
            write_line(alarm.text);
            code = exit_machine;
        }
        write_line(fmt::format("Stopped at{}.", places));
        return code;
    }

    const ServeOptions& options_;
    ConsoleOutput output_;
    std::string users_file_;
    std::unique_ptr<journal::Journal> journal_;
    std::unique_ptr<server::ServedRack> served_;
    std::atomic<bool> greeted_{false};
    bool stopping_ = false, warned_ = false;
};

}  // namespace

void add_serve(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ServeOptions>();
    CLI::App* command = app.add_subcommand("serve", "Run a rack in real time, operated in a browser");
    command->add_option("RACK", options->rack,
                        "rack file (default: the built-in demonstration, which has most kinds of card)");
    command->add_option("--port", options->port, "TCP port; 0: any free one")->capture_default_str();
    command
        ->add_option("--address", options->address,
                     "address to serve; other than this computer's loopback only with TLS")
        ->capture_default_str();
    command->add_option("--time-scale", options->time_scale, "rack seconds per real second")
        ->check(CLI::Range(operate::ClockPacer::min_factor, operate::ClockPacer::max_factor))
        ->capture_default_str();
    command->add_flag("--unthrottled", options->free, "run without real-time pacing");
    command->add_flag("--paused", options->paused, "the rack's clock starts paused");
    command->add_option("--journal", options->journal,
                        "journal file (SQLite); the next start reads the axis positions from it");
    command
        ->add_option("--journal-quota", options->journal_megabytes,
                     "maximum size of the journal, MB; warns at 80 %, removes the oldest entries beyond")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}))
        ->capture_default_str();
    command->add_option("--users", options->users,
                        "file of the paired users (default: users.json in ~/.local/state/motionrack)");
    command->add_flag("--no-auth", options->no_pairing, "every user of this computer has all rights, without a code");
    command->add_option("--page", options->page, "folder of the page (default: the one that came with the program)");
    command
        ->add_option("--live", options->live,
                     "CARD=PLACE: a real card in place of one without axes, only in service; repeat for more. PLACE: " +
                         std::string(live::port_spec_form()))
        ->allow_extra_args(false);
    command->add_option("--tls-cert", options->certificate, "PEM file of the certificate, with its chain");
    command->add_option("--tls-key", options->key, "PEM file of its key");
    command->add_option("--allow-host", options->hosts, "a host name of this computer for browsers; repeat for more");
    command->add_option("--allow-origin", options->origins,
                        "an allowed page of another origin, such as http://localhost:5173; repeat for more");
    command->add_option("--grbl-port", options->grbl_port,
                        "TCP port of this computer for G-code senders (Grbl 1.1), e.g. 40123; 0: any free one");
    command->add_option("--grbl-pty", options->grbl_terminal,
                        "path of a link to a pseudo-terminal for G-code senders, as a serial line");
    command->add_option("--grbl-axes", options->grbl_axes, "axes that senders see: 3 (X Y Z), or 4 with A, as grblHAL")
        ->check(CLI::Range(3, 4))
        ->capture_default_str();
    command->add_flag("--grbl-resets-stop-all", options->grbl_resets_stop_all,
                      "a reset (^X) of any sender stops the machine, also while another client has control");
    command->footer(
        "Example: motionrack serve router.toml --journal router.journal\nA real MCX314 or DataBoard 4002 in place of "
        "the card bench: motionrack serve rack.toml --live bench=port:/dev/port,offset=0x300,width=8\nThe printed "
        "address has a code for the first user; see docs/howto/serve.md.\nCtrl-C stops the axes and ends with code 0.");
    command->callback([options, &chosen] { chosen = [options] { return Serving(*options).run(); }; });
}

}  // namespace motionrack::cli
